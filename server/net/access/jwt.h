// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "net/access/access_tokens.h"

namespace raybundle {

/// Whose JSON Web Tokens (RFC 7519) open a server, and what in them says who comes.
struct JwtSettings {
    std::string issuer;    ///< `iss` must be that
    std::string audience;  ///< `aud` must be that, or hold it
    std::string secret;    ///< of HS256, at least 32 bytes; empty: HS256 is refused
    std::vector<std::string>
        public_keys;  ///< PEM, of RS256, at least 2048 bits; none: it is refused
    std::string role_claim = "raybundle_role";  ///< a role, or a list that holds some
    std::string name_claim = "name";            ///< what others see; absent: `sub`
};

/// What a token says that is right.
struct JwtPass {
    v1::Role role = v1::VIEWER;
    std::string name;
    double expires_s = 0.0;  ///< Unix time
};

/// Checks tokens by OpenSSL. Any thread.
class JwtVerifier {
  public:
    /// Throws std::runtime_error, which says what is wrong with the settings.
    explicit JwtVerifier(const JwtSettings& settings);
    ~JwtVerifier();
    JwtVerifier(const JwtVerifier&) = delete;
    JwtVerifier& operator=(const JwtVerifier&) = delete;

    /// Nothing for a token that is malformed, signed by nobody known or by another method, of
    /// another issuer or audience, without a role, not yet valid or expired. now_s: Unix time.
    [[nodiscard]] std::optional<JwtPass> verify(std::string_view token, double now_s) const;

    /// Another one for other settings.
    [[nodiscard]] const TokenDigest& fingerprint() const { return fingerprint_; }

  private:
    struct Keys;

    [[nodiscard]] bool is_signed(std::string_view method, std::string_view text,
                                 const std::string& signature) const;
    [[nodiscard]] std::optional<JwtPass> claims(const std::string& text, double now_s) const;

    JwtSettings settings_;
    TokenDigest fingerprint_{};
    std::unique_ptr<Keys> keys_;
};

/// Whether a text has the shape of one: two dots.
bool looks_like_jwt(std::string_view text);

}  // namespace raybundle
