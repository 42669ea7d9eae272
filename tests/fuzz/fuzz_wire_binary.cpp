// SPDX-License-Identifier: Apache-2.0
// Binary messages: whatever comes is either a valid message or a refusal that can be sent.
#include "fuzz_target.h"
#include "net/ws/wire_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace raybundle;
    const ParsedMessage parsed = parse_binary_message({reinterpret_cast<const char*>(data), size});
    if (const auto* refusal = std::get_if<Refusal>(&parsed)) {
        FUZZ_REQUIRE(!refusal->text.empty() && refusal->text.size() < 1024);
        FUZZ_REQUIRE(!to_json(to_message(*refusal)).empty());
        return 0;
    }
    const auto& message = std::get<v1::ClientMessage>(parsed);
    const ParsedMessage again = parse_binary_message(message.SerializeAsString());
    FUZZ_REQUIRE(std::holds_alternative<v1::ClientMessage>(again));
    return 0;
}
