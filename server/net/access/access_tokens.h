// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raybundle.pb.h"

namespace raybundle {

/// SHA-256 of a token. A token is random and has 256 bits, so a fast hash without salt is enough:
/// nothing can be guessed.
using TokenDigest = std::array<std::uint8_t, 32>;

/// What the server keeps of a token: never the token itself.
struct AccessToken {
    std::string name;  ///< for the log and for people
    v1::Role role = v1::VIEWER;
    TokenDigest digest{};
};

/// A new token: 64 lower-case hexadecimal digits, 256 random bits. Throws std::runtime_error where
/// the system gives no random numbers.
std::string random_token();

TokenDigest token_digest(std::string_view token);
std::string to_hex(const TokenDigest& digest);
/// Nothing unless it is 64 hexadecimal digits.
std::optional<TokenDigest> parse_digest(std::string_view hex);

/// "VIEWER", "REVIEWER" or "EDITOR"; nothing for anything else.
std::optional<v1::Role> parse_role(std::string_view name);

/// The tokens that open a server. With none, everybody may do everything.
class AccessTokens {
  public:
    AccessTokens() = default;
    explicit AccessTokens(std::vector<AccessToken> tokens) : tokens_(std::move(tokens)) {}

    [[nodiscard]] bool empty() const { return tokens_.empty(); }

    /// The entry of a digest. Takes the same time whatever the digest: every entry is compared, in
    /// constant time.
    [[nodiscard]] std::optional<AccessToken> find(const TokenDigest& digest) const;

    /// Whether a token has this name: nobody else may call himself so.
    [[nodiscard]] bool owns_name(std::string_view name) const;

    /// What a token allows: EDITOR where there are no tokens, nothing for a wrong one.
    [[nodiscard]] std::optional<v1::Role> role_of(const TokenDigest& digest) const;

  private:
    std::vector<AccessToken> tokens_;
};

/// Whether people read two names as the same: without regard to case and blanks around.
bool same_name(std::string_view a, std::string_view b);

}  // namespace raybundle
