// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <openssl/ssl.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "net/server.h"
#include "raw_client.h"
#include "test_certificate.h"

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;

const std::string kEditor(64, 'e');
const std::string kViewer(64, 'v');

ServerSettings guarded() {
    ServerSettings settings;
    settings.port = 0;
    settings.access.tokens = AccessTokens({{"lead", v1::EDITOR, token_digest(kEditor)},
                                           {"screen", v1::VIEWER, token_digest(kViewer)}});
    return settings;
}

std::string hello(const std::string& token) {
    return R"({"id":1,"hello":{"protocol":"1.0","token":")" + token + R"("}})";
}

std::string get(std::uint16_t port, const std::string& path, const std::string& headers = {}) {
    return http_exchange(port, "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" + headers +
                                   "Connection: close\r\n\r\n");
}

/// A joined event within five seconds.
std::optional<ClientEvent> next_event(Server& server) {
    const auto end = Clock::now() + std::chrono::seconds(120);
    while (Clock::now() < end) {
        server.inbox().wait_for(std::chrono::milliseconds(50));
        auto events = server.inbox().drain();
        if (!events.empty()) {
            return events.front();
        }
    }
    return std::nullopt;
}

TEST(ServerAccess, AWrongTokenReachesNobody) {
    Server server(guarded());
    server.start();
    RawClient client(server.port());
    client.upgrade();
    client.send_text(hello("guess"));
    const auto refusal = client.read_message();
    EXPECT_TRUE(has(refusal->payload, "UNAUTHENTICATED")) << refusal->payload;
    EXPECT_FALSE(has(refusal->payload, "guess")) << "a token is never repeated";
    client.send_text(hello(kViewer));
    const auto joined = next_event(server);
    ASSERT_TRUE(joined.has_value());
    EXPECT_EQ(joined->role, v1::VIEWER);
}

TEST(ServerAccess, AWithdrawnTokenEndsItsConnections) {
    Server server(guarded());
    server.start();
    RawClient viewer(server.port());
    viewer.upgrade();
    viewer.send_text(hello(kViewer));
    ASSERT_TRUE(next_event(server).has_value());
    RawClient editor(server.port());
    editor.upgrade();
    editor.send_text(hello(kEditor));
    ASSERT_TRUE(next_event(server).has_value());
    server.set_access({AccessTokens({{"lead", v1::EDITOR, token_digest(kEditor)}}), {}});
    EXPECT_TRUE(has(viewer.read_message()->payload, "no longer valid"));
    EXPECT_EQ(viewer.read_message()->close_code(), 1008);
    editor.send_text(R"({"id":2,"ping":{}})");
    EXPECT_TRUE(has(editor.read_message()->payload, "pong"));
}

TEST(ServerAccess, MetricsWantAToken) {
    Server server(guarded());
    server.start();
    const std::string refused = get(server.port(), "/metrics");
    EXPECT_TRUE(refused.starts_with("HTTP/1.1 401")) << refused;
    EXPECT_TRUE(has(refused, "www-authenticate: Bearer\r\n")) << refused;
    EXPECT_FALSE(has(refused, "raybundle_viewers"));
    const std::string allowed =
        get(server.port(), "/metrics", "Authorization: Bearer " + kViewer + "\r\n");
    EXPECT_TRUE(allowed.starts_with("HTTP/1.1 200")) << allowed;
    EXPECT_TRUE(get(server.port(), "/healthz").starts_with("HTTP/1.1 503")) << "health is open";
}

TEST(ServerAccess, ConnectionsOfOneAddressAreLimited) {
    ServerSettings settings;
    settings.port = 0;
    settings.max_connections_per_address = 3;
    settings.limit_loopback = true;
    Server server(settings);
    server.start();
    std::vector<std::unique_ptr<RawClient>> open;
    for (int i = 0; i < 3; ++i) {
        open.push_back(std::make_unique<RawClient>(server.port()));
        EXPECT_TRUE(has(open.back()->upgrade(), " 101 ")) << i;
    }
    EXPECT_TRUE(RawClient(server.port()).closed());
    open.clear();
    const auto end = Clock::now() + std::chrono::seconds(120);
    bool accepted = false;
    while (!accepted && Clock::now() < end) {
        accepted = has(RawClient(server.port()).upgrade(), " 101 ");
    }
    EXPECT_TRUE(accepted) << "closed connections still count";
}

TEST(ServerAccess, ManyConnectionsOfThisMachineAreAProxy) {
    ServerSettings settings;
    settings.port = 0;
    settings.max_connections_per_address = 1;
    Server server(settings);
    server.start();
    RawClient first(server.port());
    RawClient second(server.port());
    EXPECT_TRUE(has(first.upgrade(), " 101 "));
    EXPECT_TRUE(has(second.upgrade(), " 101 "));
}

struct TlsDeleter {
    void operator()(SSL* tls) const { SSL_free(tls); }
    void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
    void operator()(X509* certificate) const { X509_free(certificate); }
};

struct TlsAnswer {
    std::string text;
    std::string common_name;  ///< of the server's certificate
};

/// One HTTPS exchange that trusts exactly `trusted`. Nothing where the handshake fails.
std::optional<TlsAnswer> https_get(std::uint16_t port, const std::string& path,
                                   const std::string& trusted, int max_version = TLS1_3_VERSION) {
    const std::unique_ptr<SSL_CTX, TlsDeleter> context(SSL_CTX_new(TLS_client_method()));
    SSL_CTX_load_verify_file(context.get(), trusted.c_str());
    SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
    SSL_CTX_set_max_proto_version(context.get(), max_version);
    SSL_CTX_set_security_level(context.get(), 0);
    const RawClient client(port);
    const std::unique_ptr<SSL, TlsDeleter> tls(SSL_new(context.get()));
    SSL_set_fd(tls.get(), client.socket());
    if (SSL_connect(tls.get()) != 1) {
        return std::nullopt;
    }
    const std::unique_ptr<X509, TlsDeleter> peer(SSL_get1_peer_certificate(tls.get()));
    std::string name(64, '\0');
    const int length = X509_NAME_get_text_by_NID(X509_get_subject_name(peer.get()), NID_commonName,
                                                 name.data(), static_cast<int>(name.size()));
    name.resize(static_cast<std::size_t>(std::max(length, 0)));
    const std::string request =
        "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n";
    SSL_write(tls.get(), request.data(), static_cast<int>(request.size()));
    TlsAnswer answer{{}, name};
    std::string piece(4096, '\0');
    int count = 0;
    while ((count = SSL_read(tls.get(), piece.data(), static_cast<int>(piece.size()))) > 0) {
        answer.text.append(piece, 0, static_cast<std::size_t>(count));
    }
    return answer;
}

class ServerTlsTest : public testing::Test {
  protected:
    ServerTlsTest() {
        ServerSettings settings;
        settings.port = 0;
        settings.tls_certificate = certificate_.certificate();
        settings.tls_key = certificate_.key();
        server_ = std::make_unique<Server>(settings);
        server_->start();
    }

    TestCertificate certificate_{"first"};
    std::unique_ptr<Server> server_;
};

TEST_F(ServerTlsTest, ServesHttpsAndNothingElse) {
    EXPECT_TRUE(server_->address().starts_with("https://"));
    const auto answer = https_get(server_->port(), "/", certificate_.certificate());
    ASSERT_TRUE(answer.has_value());
    EXPECT_TRUE(answer->text.starts_with("HTTP/1.1 200")) << answer->text.substr(0, 200);
    EXPECT_TRUE(has(answer->text, "content-security-policy"));
    EXPECT_EQ(answer->common_name, "first");
    EXPECT_FALSE(has(get(server_->port(), "/healthz"), "starting"));
}

TEST_F(ServerTlsTest, RefusesOldProtocolVersions) {
    EXPECT_FALSE(
        https_get(server_->port(), "/", certificate_.certificate(), TLS1_1_VERSION).has_value());
    EXPECT_TRUE(
        https_get(server_->port(), "/", certificate_.certificate(), TLS1_2_VERSION).has_value());
}

TEST_F(ServerTlsTest, ARenewedCertificateIsUsedWithoutARestart) {
    certificate_.make("second");
    server_->reload_certificate();
    std::optional<TlsAnswer> answer;
    const auto end = Clock::now() + std::chrono::seconds(120);
    while (!answer && Clock::now() < end) {
        answer = https_get(server_->port(), "/healthz", certificate_.certificate());
    }
    ASSERT_TRUE(answer.has_value());
    EXPECT_EQ(answer->common_name, "second");
}

TEST_F(ServerTlsTest, ABrokenRenewalKeepsTheOldCertificate) {
    const TestCertificate other("other");
    const std::string kept = certificate_.certificate() + ".kept";
    std::filesystem::copy_file(certificate_.certificate(), kept);
    std::filesystem::copy_file(other.certificate(), certificate_.certificate(),
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_THROW(server_->reload_certificate(), std::runtime_error) << "key of another certificate";
    std::ofstream(certificate_.certificate()) << "nonsense";
    try {
        server_->reload_certificate();
        ADD_FAILURE() << "nonsense was accepted";
    } catch (const std::runtime_error& error) {
        EXPECT_TRUE(has(error.what(), certificate_.certificate())) << error.what();
    }
    std::filesystem::remove(certificate_.certificate());
    ASSERT_EQ(mkfifo(certificate_.certificate().c_str(), 0600), 0);
    EXPECT_THROW(server_->reload_certificate(), std::runtime_error) << "a pipe nobody writes to";
    EXPECT_TRUE(https_get(server_->port(), "/", kept).has_value());
}

}  // namespace
}  // namespace raybundle
