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
