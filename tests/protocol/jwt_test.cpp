// SPDX-License-Identifier: Apache-2.0
// JSON Web Tokens: which open a server, which do not, and when their sessions end.
#include "net/access/jwt.h"

#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/pem.h>
#include <openssl/rsa.h>

#include <array>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "net/access/gate.h"
#include "net/server.h"
#include "raw_client.h"

namespace raybundle {
namespace {

using Json = nlohmann::json;

constexpr double kNow = 1'800'000'000.0;
const std::string kSecret(32, 's');

std::string encode(const std::string& bytes) {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    std::string text;
    unsigned bits = 0;
    unsigned count = 0;
    for (const char c : bytes) {
        bits = (bits << 8U) | static_cast<unsigned char>(c);
        for (count += 8; count >= 6; count -= 6) {
            text += letters[(bits >> (count - 6)) & 63U];
        }
    }
    return count > 0 ? text + letters[(bits << (6 - count)) & 63U] : text;
}

std::string hmac(const std::string& secret, const std::string& text) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned size = 0;
    HMAC(EVP_sha256(), secret.data(), static_cast<int>(secret.size()),
         reinterpret_cast<const unsigned char*>(text.data()), text.size(), bytes.data(), &size);
    return {reinterpret_cast<const char*>(bytes.data()), size};
}

/// A key of RSA that signs.
class RsaKey {
  public:
    explicit RsaKey(unsigned bits) : key_(EVP_RSA_gen(bits), &EVP_PKEY_free) {}

    [[nodiscard]] std::string public_pem() const {
        const std::unique_ptr<BIO, decltype(&BIO_free)> bio(BIO_new(BIO_s_mem()), &BIO_free);
        PEM_write_bio_PUBKEY(bio.get(), key_.get());
        char* data = nullptr;
        const long size = BIO_get_mem_data(bio.get(), &data);
        return {data, static_cast<std::size_t>(size)};
    }

    [[nodiscard]] std::string sign(const std::string& text) const {
        const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                              &EVP_MD_CTX_free);
        const auto* const bytes = reinterpret_cast<const unsigned char*>(text.data());
        std::size_t size = 0;
        EVP_DigestSignInit(context.get(), nullptr, EVP_sha256(), nullptr, key_.get());
        EVP_DigestSign(context.get(), nullptr, &size, bytes, text.size());
        std::string signature(size, '\0');
        EVP_DigestSign(context.get(), reinterpret_cast<unsigned char*>(signature.data()), &size,
                       bytes, text.size());
        signature.resize(size);
        return signature;
    }

  private:
    std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key_;
};

Json claims() {
    return {
        {"iss", "https://login.example"}, {"aud", "raybundle"}, {"sub", "42"}, {"exp", kNow + 60.0},
        {"raybundle_role", "EDITOR"},     {"name", "Ada"}};
}

std::string unsigned_token(const Json& head, const Json& body) {
    return encode(head.dump()) + "." + encode(body.dump());
}

std::string hs256(const Json& body, const Json& head = {{"alg", "HS256"}, {"typ", "JWT"}},
                  const std::string& secret = kSecret) {
    const std::string text = unsigned_token(head, body);
    return text + "." + encode(hmac(secret, text));
}

JwtSettings by_secret() {
    JwtSettings settings;
    settings.issuer = "https://login.example";
    settings.audience = "raybundle";
    settings.secret = kSecret;
    return settings;
}

TEST(Jwt, ARightOneSaysWhoComesAsWhat) {
    const JwtVerifier verifier(by_secret());
    const auto pass = verifier.verify(hs256(claims()), kNow);
    ASSERT_TRUE(pass.has_value());
    EXPECT_EQ(pass->role, v1::EDITOR);
    EXPECT_EQ(pass->name, "Ada");
    EXPECT_EQ(pass->expires_s, kNow + 60.0);
    Json body = claims();
    body["aud"] = {"other", "raybundle"};
    body["raybundle_role"] = {"something", "VIEWER", "REVIEWER"};
    body.erase("name");
    const auto listed = verifier.verify(hs256(body), kNow);
    ASSERT_TRUE(listed.has_value());
    EXPECT_EQ(listed->role, v1::REVIEWER) << "the highest of a list";
    EXPECT_EQ(listed->name, "42");
}

TEST(Jwt, WhatIsNotRightOpensNothing) {
    const JwtVerifier verifier(by_secret());
    const auto changed = [](const char* key, const Json& value) {
        Json body = claims();
        body[key] = value;
        return hs256(body);
    };
    Json without_end = claims();
    without_end.erase("exp");
    const std::string right = hs256(claims());
    std::string tampered = right;
    tampered[right.find('.') + 5] ^= 1;
    const std::pair<const char*, std::string> wrong[] = {
        {"expired", changed("exp", kNow)},
        {"end is no number", changed("exp", "never")},
        {"without end", hs256(without_end)},
        {"not yet", changed("nbf", kNow + 3600.0)},
        {"other issuer", changed("iss", "https://elsewhere.example")},
        {"other audience", changed("aud", "mail")},
        {"no role", changed("raybundle_role", "ADMIN")},
        {"role of another type", changed("raybundle_role", 3)},
        {"tampered", tampered},
        {"another secret", hs256(claims(), {{"alg", "HS256"}}, std::string(32, 't'))},
        {"no method", unsigned_token({{"alg", "none"}}, claims()) + "."},
        {"unknown method", hs256(claims(), {{"alg", "HS512"}})},
        {"critical extension", hs256(claims(), {{"alg", "HS256"}, {"crit", {"b64"}}})},
        {"no signature", right.substr(0, right.rfind('.') + 1)},
        {"cut", right.substr(0, right.size() - 2)},
        {"no dots", "abc"},
        {"empty", ""},
        {"dots alone", ".."},
        {"no JSON", encode("abc") + "." + encode("[]") + "."},
        {"padding", right + "="},
    };
    for (const auto& [what, token] : wrong) {
        EXPECT_FALSE(verifier.verify(token, kNow).has_value()) << what;
    }
}

TEST(Jwt, RsaKeysVerifyAndAreNoSecrets) {
    const RsaKey one(2048);
    const RsaKey other(2048);
    JwtSettings settings = by_secret();
    settings.secret.clear();
    settings.public_keys = {one.public_pem(), other.public_pem()};
    const JwtVerifier verifier(settings);
    const std::string text = unsigned_token({{"alg", "RS256"}}, claims());
    EXPECT_TRUE(verifier.verify(text + "." + encode(one.sign(text)), kNow).has_value());
    EXPECT_TRUE(verifier.verify(text + "." + encode(other.sign(text)), kNow).has_value());
    EXPECT_FALSE(verifier.verify(text + "." + encode(RsaKey(2048).sign(text)), kNow).has_value());
    // The public key is known to all: it must not serve as the secret of HS256.
    EXPECT_FALSE(
        verifier.verify(hs256(claims(), {{"alg", "HS256"}}, one.public_pem()), kNow).has_value());
    const JwtVerifier secret(by_secret());
    EXPECT_FALSE(secret.verify(text + "." + encode(one.sign(text)), kNow).has_value());
}

TEST(Jwt, WeakSettingsAreRefused) {
    JwtSettings short_secret = by_secret();
    short_secret.secret = "short";
    JwtSettings nobody = by_secret();
    nobody.issuer.clear();
    JwtSettings no_key = by_secret();
    no_key.secret.clear();
    JwtSettings both = by_secret();
    both.public_keys = {RsaKey(2048).public_pem()};
    JwtSettings small_key = no_key;
    small_key.public_keys = {RsaKey(1024).public_pem()};
    JwtSettings no_pem = no_key;
    no_pem.public_keys = {"abc"};
    for (const JwtSettings& wrong : {short_secret, nobody, no_key, both, small_key, no_pem}) {
        EXPECT_THROW(JwtVerifier{wrong}, std::runtime_error);
    }
}

double unix_now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

std::string valid_for(double seconds) {
    Json body = claims();
    body["exp"] = unix_now() + seconds;
    return hs256(body);
}

TEST(JwtGate, TokensAndPlainOnesOpenTheSameServer) {
    const auto verifier = std::make_shared<const JwtVerifier>(by_secret());
    Gate gate{8, {AccessTokens({{"lead", v1::VIEWER, token_digest("plain")}}), {}, verifier}};
    v1::Hello hello;
    hello.set_token(valid_for(3600.0));
    auto answer = gate.enter(hello);
    ASSERT_TRUE(std::holds_alternative<Pass>(answer));
    const Pass pass = std::get<Pass>(answer);
    EXPECT_EQ(pass.role, v1::EDITOR);
    EXPECT_EQ(pass.token_name, "Ada");
    EXPECT_TRUE(gate.still_valid(pass));
    hello.set_token("plain");
    EXPECT_TRUE(std::holds_alternative<Pass>(gate.enter(hello)));
    hello.set_token("");
    EXPECT_TRUE(std::holds_alternative<Denial>(gate.enter(hello)));
    EXPECT_EQ(gate.role_of("Bearer " + valid_for(3600.0)), v1::EDITOR);
    EXPECT_FALSE(gate.role_of("Bearer " + valid_for(-1.0)).has_value());
    JwtSettings others = by_secret();
    others.issuer = "https://elsewhere.example";
    gate.set_access({{}, {}, std::make_shared<const JwtVerifier>(others)});
    EXPECT_FALSE(gate.still_valid(pass)) << "who is trusted has changed";
    gate.set_access({{}, {}, std::make_shared<const JwtVerifier>(by_secret())});
    EXPECT_TRUE(gate.still_valid(pass)) << "read again, and the same";
}

TEST(JwtSession, EndsWithItsToken) {
    ServerSettings settings;
    settings.port = 0;
    settings.access.jwt = std::make_shared<const JwtVerifier>(by_secret());
    Server server(settings);
    server.start();
    for (double seconds = 1.0;; seconds *= 2.0) {
        RawClient client(server.port());
        client.upgrade();
        client.send_text(R"({"id":1,"hello":{"protocol":"1.0","token":")" + valid_for(seconds) +
                         R"("}})");
        const std::string said = client.read_message()->payload;
        if (has(said, "is not valid")) {
            continue;  // so slow that it had expired before it was read
        }
        EXPECT_TRUE(has(said, "no longer valid")) << said;
        EXPECT_EQ(client.read_message()->close_code(), 1008);
        return;
    }
}

}  // namespace
}  // namespace raybundle
