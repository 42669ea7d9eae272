// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "embedded_file.h"
#include "net/server.h"
#include "raw_client.h"

namespace raybundle {
namespace {

class ServerHttpTest : public testing::Test {
  protected:
    ServerHttpTest() { server_.start(); }

    [[nodiscard]] std::string request(const std::string& line) const {
        return http_exchange(server_.port(),
                             line + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n");
    }

    static ServerSettings settings() {
        ServerSettings result;
        result.port = 0;
        return result;
    }

    Server server_{settings()};
};

TEST_F(ServerHttpTest, ServesEveryClientFileWhole) {
    for (const EmbeddedFile& file : client_files()) {
        const std::string answer = request("GET /" + std::string(file.name));
        EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << file.name;
        ASSERT_GE(answer.size(), file.contents.size());
        EXPECT_TRUE(answer.ends_with(file.contents)) << file.name;
    }
    EXPECT_TRUE(has(request("GET /"), "text/html"));
}

TEST_F(ServerHttpTest, SendsSecurityHeaders) {
    const std::string answer = request("GET /?share=1");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
    EXPECT_TRUE(has(answer, "cache-control: no-cache\r\n")) << answer;
    EXPECT_TRUE(has(answer, "content-security-policy: default-src 'none'; script-src 'self'"));
    EXPECT_TRUE(has(answer, "x-content-type-options: nosniff\r\n"));
}

TEST_F(ServerHttpTest, ModulesAreCompressedAndAskedForOnce) {
    const std::string ask = "GET /main.js HTTP/1.1\r\nHost: 127.0.0.1\r\nAccept-Encoding: gzip\r\n";
    RawClient client(server_.port());
    client.send(ask + "\r\n");
    const std::string head = client.read_until("\r\n\r\n");
    EXPECT_TRUE(has(head, "content-encoding: gzip\r\n")) << head;
    EXPECT_TRUE(has(head, "vary: Accept-Encoding\r\n")) << head;
    const std::size_t at = head.find("etag: ") + 6;
    const std::string etag = head.substr(at, head.find('\r', at) - at);
    const std::string again = http_exchange(
        server_.port(), ask + "If-None-Match: " + etag + "\r\nConnection: close\r\n\r\n");
    EXPECT_TRUE(again.starts_with("HTTP/1.1 304")) << again;
    EXPECT_TRUE(has(again, "etag: " + etag)) << again;
    EXPECT_TRUE(again.ends_with("\r\n\r\n")) << "a body: " << again;
    // The connection serves the next request after a 304.
    RawClient kept(server_.port());
    for (int i = 0; i < 2; ++i) {
        kept.send(ask + "If-None-Match: " + etag + "\r\n\r\n");
        EXPECT_TRUE(kept.read_until("\r\n\r\n").starts_with("HTTP/1.1 304"));
    }
}

TEST_F(ServerHttpTest, CookiesOfASingleSignOnPassAndWhatIsBeyondGets431) {
    const auto with_cookie = [this](std::size_t bytes) {
        return http_exchange(server_.port(), "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nCookie: s=" +
                                                 std::string(bytes, 'c') +
                                                 "\r\nConnection: close\r\n\r\n");
    };
    EXPECT_TRUE(with_cookie(8192).starts_with("HTTP/1.1 200"));
    const std::string refused = with_cookie(30000);
    EXPECT_TRUE(refused.starts_with("HTTP/1.1 431")) << refused;
    EXPECT_TRUE(has(refused, "more than 16384 bytes")) << refused;
    const auto upgrade = [this](std::size_t bytes) {
        return RawClient(server_.port())
            .upgrade("/ws", "Cookie: s=" + std::string(bytes, 'c') + "\r\n");
    };
    EXPECT_TRUE(upgrade(8192).starts_with("HTTP/1.1 101"));
    EXPECT_TRUE(upgrade(30000).starts_with("HTTP/1.1 431"));
}

TEST_F(ServerHttpTest, HandshakesThatTheStandardForbidsAreRefused) {
    const auto answer = [this](const std::string& headers) {
        return http_exchange(server_.port(),
                             "GET /ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\n"
                             "Connection: Upgrade\r\n" +
                                 headers + "\r\n");
    };
    const std::string key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    const std::string version = "Sec-WebSocket-Version: 13\r\n";
    for (const char* wrong : {"", "Sec-WebSocket-Version: 12\r\n", "Sec-WebSocket-Version: 8\r\n",
                              "Sec-WebSocket-Version: 130\r\n"}) {
        const std::string said = answer(key + wrong);
        EXPECT_TRUE(said.starts_with("HTTP/1.1 426")) << wrong << said;
        EXPECT_TRUE(has(said, "sec-websocket-version: 13\r\n")) << said;
    }
    for (const char* wrong : {"", "Sec-WebSocket-Key: dGhl\r\n", "Sec-WebSocket-Key: x\r\n"}) {
        EXPECT_TRUE(answer(version + wrong).starts_with("HTTP/1.1 400")) << wrong;
    }
    const std::string unknown =
        answer(key + version + "Sec-WebSocket-Protocol: chat, raybundle.v9\r\n");
    EXPECT_TRUE(unknown.starts_with("HTTP/1.1 400")) << unknown;
    EXPECT_TRUE(has(unknown, "raybundle.v1")) << unknown;
    RawClient one_of_two(server_.port());
    EXPECT_TRUE(has(one_of_two.upgrade("/ws", "Sec-WebSocket-Protocol: chat, raybundle.v1\r\n"),
                    "raybundle.v1"));
}

TEST_F(ServerHttpTest, HeadHasNoBody) {
    const std::string answer = request("HEAD /");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200"));
    EXPECT_TRUE(answer.ends_with("\r\n\r\n"));
}

TEST_F(ServerHttpTest, RefusesWhatIsNotThere) {
    for (const char* path : {"/nothing", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
                             "/..%2f..%2fetc/passwd", "/a/../../etc/passwd", "//etc/passwd"}) {
        const std::string answer = request(std::string("GET ") + path);
        EXPECT_FALSE(has(answer, "root:")) << path;
        EXPECT_FALSE(answer.starts_with("HTTP/1.1 200")) << path << answer;
    }
    EXPECT_TRUE(request("GET /nothing").starts_with("HTTP/1.1 404"));
    EXPECT_TRUE(request("GET /ws").starts_with("HTTP/1.1 426"));
    EXPECT_TRUE(request("DELETE /").starts_with("HTTP/1.1 405"));
}

TEST_F(ServerHttpTest, HealthFollowsReady) {
    EXPECT_TRUE(request("GET /healthz").starts_with("HTTP/1.1 503"));
    server_.set_ready(true);
    EXPECT_TRUE(request("GET /healthz").starts_with("HTTP/1.1 200"));
}

TEST_F(ServerHttpTest, MetricsIncludeTheSource) {
    server_.set_metrics_source([] { return std::string("raybundle_epoch 7\n"); });
    const std::string answer = request("GET /metrics");
    EXPECT_TRUE(has(answer, "raybundle_viewers 0\n"));
    EXPECT_TRUE(answer.ends_with("raybundle_epoch 7\n"));
}

TEST_F(ServerHttpTest, ConnectionsAreKeptForTheNextRequest) {
    RawClient client(server_.port());
    for (int i = 0; i < 3; ++i) {
        client.send("GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
        EXPECT_TRUE(client.read_until("starting\n").starts_with("HTTP/1.1 503"));
    }
}

TEST_F(ServerHttpTest, SurvivesNonsense) {
    http_exchange(server_.port(), "\r\n\r\n");
    http_exchange(server_.port(), std::string("\x16\x03\x01\x00\x00 \r\n\r\n", 10));
    RawClient endless(server_.port());
    endless.send("GET /" + std::string(100000, 'a'));
    EXPECT_TRUE(endless.closed());
    EXPECT_TRUE(request("GET /healthz").starts_with("HTTP/1.1 503"));
}

TEST(ServerAddress, SaysWhyItCannotListen) {
    ServerSettings settings;
    settings.port = 0;
    Server first(settings);
    first.start();
    settings.port = first.port();
    Server second(settings);
    try {
        second.start();
        FAIL() << "listens twice";
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        EXPECT_TRUE(has(text, "127.0.0.1:" + std::to_string(first.port()))) << text;
        EXPECT_TRUE(has(text, "in use")) << text;
    }
    settings.host = "no-such-host.invalid";
    EXPECT_THROW(Server(settings).start(), std::runtime_error);
    settings.host = "192.0.2.1";  // documentation range, no interface has it
    EXPECT_THROW(Server(settings).start(), std::runtime_error);
}

TEST(ServerAddress, NamesItself) {
    ServerSettings settings;
    settings.port = 0;
    settings.host = "localhost";
    Server server(settings);
    server.start();
    EXPECT_EQ(server.address(), "http://localhost:" + std::to_string(server.port()));
}

TEST(ServerAddress, BadCertificateIsAnError) {
    ServerSettings settings;
    settings.port = 0;
    settings.tls_certificate = "/nonexistent/certificate.pem";
    settings.tls_key = "/nonexistent/key.pem";
    EXPECT_THROW(Server(settings).start(), std::runtime_error);
}

}  // namespace
}  // namespace raybundle
