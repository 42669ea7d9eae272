// SPDX-License-Identifier: Apache-2.0
// A whole connection: messages in lines, cut into fragments, with acknowledgements and frames
// between them. Queues stay bounded whatever a client does.
#include "fuzz_target.h"
#include "net/ws/session.h"

namespace {

constexpr std::size_t kMaxQueued = 100000;
constexpr std::size_t kMaxWaiting = 8;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace raybundle;
    ViewerLink link(1, kMaxQueued, {});
    Inbox inbox(kMaxWaiting);
    Gate gate(1);
    Session session(link, inbox, gate, {}, 1000.0);
    session.on_fragment(R"({"hello":{"protocol":"1.0"}})", true, true, false, 0.0);
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    double now_ms = 0.0;
    std::uint32_t frame = 0;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        const bool binary = line.size() % 5 == 0;
        const std::size_t cut = line.size() / 3;
        session.on_fragment(line.substr(0, cut), true, false, binary, now_ms);
        session.on_fragment(line.substr(cut), false, true, binary, now_ms);
        now_ms += static_cast<double>(line.size() % 7);
        if (link.advise({true, false, 1000.0}, now_ms).send) {
            v1::FrameHeader header;
            header.set_frame(++frame);
            link.send_frame(header, {1, 2, 3});
        }
        link.take(now_ms);
    }
    FUZZ_REQUIRE(inbox.drain().size() <= kMaxWaiting + 1);
    session.on_closed();
    FUZZ_REQUIRE(gate.present() == 0);
    FUZZ_REQUIRE(inbox.drain().size() <= 1);
    return 0;
}
