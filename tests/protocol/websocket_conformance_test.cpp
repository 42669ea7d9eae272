// SPDX-License-Identifier: Apache-2.0
// Cases of RFC 6455 over a raw socket: what must be understood, and what must end the connection.
// One rule is libwebsockets' to keep and 4.1 does not: of pings that come at once it answers the
// first, not the last (5.5.3). Frames without a mask are in mask_check_test.cpp.
#include <gtest/gtest.h>

#include <string>

#include "net/server.h"
#include "raw_client.h"

namespace raybundle {
namespace {

using namespace std::string_literals;

/// A frame byte by byte: first byte, masked payload. Lengths above 125 take 16 bits.
std::string frame(int first_byte, std::string payload) {
    constexpr std::string_view kMask = "\x11\x22\x33\x44";
    std::string bytes(1, static_cast<char>(first_byte));
    if (payload.size() < 126) {
        bytes += static_cast<char>(0x80U | payload.size());
    } else {
        bytes += static_cast<char>(0x80U | 126U);
        bytes += static_cast<char>(payload.size() >> 8U);
        bytes += static_cast<char>(payload.size() & 255U);
    }
    bytes += kMask;
    for (std::size_t i = 0; i < payload.size(); ++i) {
        payload[i] = static_cast<char>(payload[i] ^ kMask[i % 4]);
    }
    return bytes + payload;
}

const std::string kPing = R"({"id":7,"ping":{}})";
/// An answer without payload, which is not the same as no answer.
const std::string kEmpty = "(empty)";
const std::string kAccented = "{\"id\":7,\"ping\":{},\"x\":\"\xc3\xa9\xf0\x9f\x92\xa1\"}";

struct Case {
    const char* name;
    const char* section;
    std::string bytes;
    /// Text that comes back, or empty where the connection must end.
    std::string answer;
    int opcode = 1;      ///< of the answer
    int close_code = 0;  ///< where it must end: what may be told; 0: nothing need be
};

std::ostream& operator<<(std::ostream& out, const Case& test) {
    return out << test.name << " (RFC 6455, " << test.section << ")";
}

const Case kCases[] = {
    {"WholeText", "5.6", frame(0x81, kPing), "UNAUTHENTICATED"},
    {"EmptyText", "5.6", frame(0x81, ""), "INVALID_ARGUMENT"},
    {"EmptyBinary", "5.6", frame(0x82, ""), "INVALID_ARGUMENT"},
    {"Length126", "5.2", frame(0x81, kPing + std::string(200, ' ')), "UNAUTHENTICATED"},
    {"TwoFragments", "5.4", frame(0x01, kPing.substr(0, 5)) + frame(0x80, kPing.substr(5)),
     "UNAUTHENTICATED"},
    {"EmptyFragments", "5.4", frame(0x01, "") + frame(0x00, kPing) + frame(0x80, ""),
     "UNAUTHENTICATED"},
    {"CharacterAcrossFragments", "5.6",
     frame(0x01, kAccented.substr(0, 23)) + frame(0x80, kAccented.substr(23)), "UNAUTHENTICATED"},
    {"Ping", "5.5.2", frame(0x89, "hello"), "hello", 10},
    {"EmptyPing", "5.5.2", frame(0x89, ""), kEmpty, 10},
    {"LongestPing", "5.5", frame(0x89, std::string(125, 'p')), std::string(125, 'p'), 10},
    {"PingBetweenFragments", "5.4",
     frame(0x01, kPing.substr(0, 5)) + frame(0x89, "mid") + frame(0x80, kPing.substr(5)), "mid",
     10},
    {"UnaskedPongIsIgnored", "5.5.3", frame(0x8a, "x") + frame(0x81, kPing), "UNAUTHENTICATED"},
    {"Close", "5.5.1", frame(0x88, "\x03\xe8"s), "", 1, 1000},
    {"CloseWithoutCode", "5.5.1", frame(0x88, ""), ""},
    {"ReservedBit1", "5.2", frame(0xc1, kPing), "", 1, 1002},
    {"ReservedBit2", "5.2", frame(0xa1, kPing), "", 1, 1002},
    {"ReservedBit3", "5.2", frame(0x91, kPing), "", 1, 1002},
    {"ReservedDataOpcode", "5.2", frame(0x83, kPing), "", 1, 1002},
    {"ReservedControlOpcode", "5.2", frame(0x8b, ""), "", 1, 1002},
    {"FragmentedPing", "5.5", frame(0x09, "a") + frame(0x80, "b"), "", 1, 1002},
    {"OversizedPing", "5.5", frame(0x89, std::string(126, 'p')), "", 1, 1002},
    {"ContinuationOfNothing", "5.4", frame(0x80, kPing), "", 1, 1002},
    {"TextInsideAMessage", "5.4", frame(0x01, "{") + frame(0x81, kPing), "", 1, 1002},
    {"BadUtf8", "8.1", frame(0x81, "\"\xc3\x28\""), "", 1, 1007},
    {"OverlongUtf8", "8.1", frame(0x81, "\"\xc0\xaf\""), "", 1, 1007},
    {"SurrogateInUtf8", "8.1", frame(0x81, "\"\xed\xa0\x80\""), "", 1, 1007},
    {"CutUtf8", "8.1", frame(0x81, "\"\xc3"), "", 1, 1007},
};

class WebSocketConformance : public testing::TestWithParam<Case> {
  protected:
    WebSocketConformance() { server_.start(); }

    static ServerSettings settings() {
        ServerSettings result;
        result.port = 0;
        return result;
    }

    Server server_{settings()};
};

TEST_P(WebSocketConformance, Holds) {
    const Case& test = GetParam();
    RawClient client(server_.port());
    ASSERT_NE(client.upgrade().find(" 101 "), std::string::npos);
    client.send(test.bytes);
    auto received = client.read_frame();
    if (!test.answer.empty()) {
        ASSERT_TRUE(received.has_value());
        EXPECT_EQ(received->opcode, test.opcode);
        const std::string payload = received->payload.empty() ? kEmpty : received->payload;
        EXPECT_NE(payload.find(test.answer), std::string::npos) << payload;
        return;
    }
    if (received) {
        ASSERT_EQ(received->opcode, 8) << "instead of the end: " << received->payload;
        if (received->close_code() != 0) {
            EXPECT_EQ(received->close_code(), test.close_code);
        }
        client.send_frame(8, received->payload);  // 5.5.1: the answer, unless we began
    }
    EXPECT_TRUE(client.closed());
    // Nobody else is concerned.
    RawClient next(server_.port());
    EXPECT_NE(next.upgrade().find(" 101 "), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Rfc6455, WebSocketConformance, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace raybundle
