// SPDX-License-Identifier: Apache-2.0
// Uploads that never end, and wrong tokens, over HTTP.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "net/server.h"
#include "raw_client.h"

namespace raybundle {
namespace {

const std::string kToken(64, 'e');

class ForgottenUpload : public Upload {
  public:
    bool write(std::string_view /*bytes*/) override { return true; }
    void finish(std::function<void(UploadResult)> done) override { done({201, "Stored"}); }
};

std::unique_ptr<Server> serve(double max_upload_s) {
    ServerSettings settings;
    settings.port = 0;
    settings.max_upload_bytes = 1000000;
    settings.max_upload_s = max_upload_s;
    settings.access.tokens = AccessTokens({{"lead", v1::EDITOR, token_digest(kToken)}});
    auto server = std::make_unique<Server>(settings);
    server->set_upload_factory(
        [](const std::string& /*name*/) { return std::make_unique<ForgottenUpload>(); });
    server->start();
    return server;
}

std::string put(std::size_t length, const std::string& token = kToken) {
    return "PUT /scenes/a.glb HTTP/1.1\r\nHost: a\r\nAuthorization: Bearer " + token +
           "\r\nContent-Length: " + std::to_string(length) + "\r\n\r\n";
}

std::string get_metrics(const std::string& token) {
    return "GET /metrics HTTP/1.1\r\nHost: a\r\nAuthorization: Bearer " + token + "\r\n\r\n";
}

/// One answer, its body included, of a connection that goes on.
std::string answer_of(RawClient& client, const std::string& request) {
    client.send(request);
    const std::string head = client.read_until("\r\n\r\n");
    return head + client.read_until("\n");
}

TEST(HttpServiceTest, AnUploadThatDoesNotEndGets408) {
    const auto server = serve(0.3);
    RawClient silent(server->port());
    silent.send(put(1000) + "glTF");
    const std::string answer = silent.read_all();
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 408")) << answer;
    EXPECT_TRUE(has(answer, "longer than 0.3 s")) << answer;
    EXPECT_TRUE(has(answer, "996 bytes were missing")) << answer;
}

TEST(HttpServiceTest, BytesThatTrickleInDoNotExtendTheTime) {
    const auto server = serve(0.3);
    RawClient slow(server->port());
    slow.send(put(1000000));
    std::string answer;
    for (int i = 0; i < 100000 && answer.empty(); ++i) {  // each waits for the answer a while
        slow.send("x");
        answer = slow.read_for(std::chrono::milliseconds(20));
    }
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 408")) << answer;
    EXPECT_TRUE(slow.closed());
    RawClient next(server->port());
    next.send(put(4) + "glTF");
    EXPECT_TRUE(has(next.read_until("\r\n\r\n"), " 201 ")) << "the place is free again";
}

TEST(HttpServiceTest, AnUploadInTimeKeepsItsConnection) {
    const auto server = serve(3600.0);
    RawClient client(server->port());
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(has(answer_of(client, put(4) + "glTF"), " 201 ")) << i;
    }
}

TEST(HttpServiceTest, ManyWrongTokensWaitForTheirAnswers) {
    using Clock = std::chrono::steady_clock;
    const auto server = serve(3600.0);
    RawClient client(server->port());
    for (std::uint64_t i = 0; i < WrongTokens::free_tries; ++i) {
        EXPECT_TRUE(has(answer_of(client, get_metrics("guess")), " 401 "));
    }
    const auto delay = std::chrono::duration<double, std::milli>(WrongTokens::first_delay_ms);
    auto asked = Clock::now();
    EXPECT_TRUE(has(answer_of(client, get_metrics("guess")), " 401 "));
    EXPECT_GE(Clock::now() - asked, delay) << "metrics";
    asked = Clock::now();
    EXPECT_TRUE(has(answer_of(client, put(4, "guess") + "glTF"), " 401 "));
    EXPECT_GE(Clock::now() - asked, 2.0 * delay) << "an upload, with a body";
    client.send(get_metrics(kToken));
    EXPECT_TRUE(has(client.read_until("\r\n\r\n"), " 200 ")) << "a right token is never held up";
    EXPECT_TRUE(has(client.read_until("wrong_tokens_total 5\n"), "wrong_tokens_total 5\n"));
}

TEST(HttpServiceTest, WhoLeavesWhileHisAnswerWaitsHoldsNothing) {
    const auto server = serve(3600.0);
    for (int i = 0; i < 8; ++i) {
        RawClient client(server->port());
        client.send(get_metrics("guess"));
        client.reset();
    }
    RawClient next(server->port());
    EXPECT_TRUE(has(answer_of(next, get_metrics(kToken)), " 200 "));
}

}  // namespace
}  // namespace raybundle
