// SPDX-License-Identifier: Apache-2.0
// RFC 6455, 5.1: a server closes a connection on which an unmasked frame has come.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <array>
#include <memory>
#include <string>

#include "net/server.h"
#include "raw_client.h"
#include "test_certificate.h"

namespace raybundle {
namespace {

constexpr int kText = 0x81;
constexpr int kPing = 0x89;
constexpr int kPong = 10;
constexpr int kClose = 8;
constexpr int kProtocolError = 1002;
const std::string kUpgrade =
    "GET /ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";

/// A short frame, byte by byte.
std::string frame(int first_byte, const std::string& payload, bool masked) {
    constexpr std::string_view kMask = "\x11\x22\x33\x44";
    std::string bytes(1, static_cast<char>(first_byte));
    bytes += static_cast<char>((masked ? 0x80U : 0U) | payload.size());
    bytes += masked ? kMask : "";
    for (std::size_t i = 0; i < payload.size(); ++i) {
        bytes += static_cast<char>(payload[i] ^ (masked ? kMask[i % 4] : 0));
    }
    return bytes;
}

class MaskCheckTest : public testing::Test {
  protected:
    MaskCheckTest() { server_.start(); }

    static ServerSettings settings() {
        ServerSettings result;
        result.port = 0;
        return result;
    }

    /// Sends, and expects that the server closes with 1002 and says nothing else.
    void expect_refused(RawClient& client, const std::string& bytes) {
        client.send(bytes);
        const auto answer = client.read_frame();
        ASSERT_TRUE(answer.has_value());
        EXPECT_EQ(answer->opcode, kClose) << answer->payload;
        EXPECT_EQ(answer->close_code(), kProtocolError) << answer->payload;
        EXPECT_TRUE(client.closed());
    }

    Server server_{settings()};
};

TEST_F(MaskCheckTest, UnmaskedFramesEndTheConnection) {
    for (const std::string& bytes :
         {frame(kText, "{}", false), frame(kText, "", false), frame(kPing, "x", false),
          frame(0x88, "", false), frame(kText, R"({"id":7,"ping":{}})", false)}) {
        RawClient client(server_.port());
        ASSERT_TRUE(has(client.upgrade(), " 101 "));
        expect_refused(client, bytes);
    }
}

TEST_F(MaskCheckTest, BytesThatComeOneByOneAreJudgedAlike) {
    for (const bool masked : {true, false}) {
        RawClient client(server_.port());
        ASSERT_TRUE(has(client.upgrade(), " 101 "));
        const int at_once = 1;
        setsockopt(client.socket(), IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
        const std::string bytes = frame(kPing, "slow", masked);
        if (!masked) {
            client.send(bytes.substr(0, 1));
            expect_refused(client, bytes.substr(1));
            continue;
        }
        for (const char byte : bytes) {
            client.send(std::string(1, byte));
        }
        const auto pong = client.read_frame();
        ASSERT_TRUE(pong.has_value());
        EXPECT_EQ(pong->opcode, kPong);
        EXPECT_EQ(pong->payload, "slow");
    }
}

/// The first byte may be there when the server begins to look, the second not yet.
TEST_F(MaskCheckTest, OneByteAloneIsNotJudged) {
    const std::string bytes = frame(kPing, "slow", false);
    for (int i = 0; i < 300; ++i) {
        RawClient client(server_.port());
        ASSERT_TRUE(has(client.upgrade(), " 101 "));
        const int at_once = 1;
        setsockopt(client.socket(), IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
        client.send(bytes.substr(0, 1));
        expect_refused(client, bytes.substr(1));
    }
}

TEST_F(MaskCheckTest, NobodySendsBeforeTheHandshakeIsAnswered) {
    for (const bool masked : {true, false}) {
        RawClient client(server_.port());
        client.send(kUpgrade + frame(kText, "{}", masked));
        ASSERT_TRUE(has(client.read_until("\r\n\r\n"), " 101 "));
        expect_refused(client, "");
    }
}

TEST_F(MaskCheckTest, AClientThatLeavesBeforeItsFirstFrameHoldsNothing) {
    for (int i = 0; i < 20; ++i) {
        RawClient client(server_.port());
        ASSERT_TRUE(has(client.upgrade(), " 101 "));
        if (i % 2 == 0) {
            client.reset();
        } else {
            client.send(std::string(1, '\x81'));
        }
    }
    RawClient next(server_.port());
    ASSERT_TRUE(has(next.upgrade(), " 101 "));
    next.send(frame(kPing, "here", true));
    EXPECT_EQ(next.read_frame()->payload, "here");
}

struct TlsDeleter {
    void operator()(SSL* tls) const { SSL_free(tls); }
    void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
};

/// The answer to the upgrade and to a frame over TLS, as many bytes as the server sends.
std::string over_tls(std::uint16_t port, const std::string& bytes) {
    const std::unique_ptr<SSL_CTX, TlsDeleter> context(SSL_CTX_new(TLS_client_method()));
    const RawClient client(port);
    const std::unique_ptr<SSL, TlsDeleter> tls(SSL_new(context.get()));
    SSL_set_fd(tls.get(), client.socket());
    if (SSL_connect(tls.get()) != 1) {
        return "no TLS";
    }
    const auto send = [&](const std::string& text) {
        SSL_write(tls.get(), text.data(), static_cast<int>(text.size()));
    };
    const auto read = [&] {
        std::array<char, 4096> piece{};
        const int count = SSL_read(tls.get(), piece.data(), static_cast<int>(piece.size()));
        return std::string(piece.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    };
    send(kUpgrade);
    if (!has(read(), " 101 ")) {
        return "no upgrade";
    }
    send(bytes);
    return read();
}

TEST(MaskCheckTls, UnmaskedFramesEndTheConnection) {
    const TestCertificate certificate("first");
    ServerSettings settings;
    settings.port = 0;
    settings.tls_certificate = certificate.certificate();
    settings.tls_key = certificate.key();
    Server server(settings);
    server.start();
    EXPECT_EQ(over_tls(server.port(), frame(kPing, "safe", true)), "\x8a\x04safe");
    const std::string refused = over_tls(server.port(), frame(kPing, "open", false));
    ASSERT_GE(refused.size(), 4U);
    EXPECT_EQ(refused[0], '\x88');
    EXPECT_EQ(refused.substr(2, 2), "\x03\xea") << "1002";
}

}  // namespace
}  // namespace raybundle
