// SPDX-License-Identifier: Apache-2.0
#include "net/access/access_tokens.h"

#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <openssl/sha.h>

#include <algorithm>
#include <stdexcept>

namespace raybundle {
namespace {

/// Value of a hexadecimal digit, -1 for anything else.
int hex_value(char digit) {
    if (digit >= '0' && digit <= '9') {
        return digit - '0';
    }
    if (digit >= 'a' && digit <= 'f') {
        return digit - 'a' + 10;
    }
    return digit >= 'A' && digit <= 'F' ? digit - 'A' + 10 : -1;
}

}  // namespace

std::string random_token() {
    TokenDigest bytes{};
    if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1) {
        throw std::runtime_error("no random numbers for a token");
    }
    return to_hex(bytes);
}

TokenDigest token_digest(std::string_view token) {
    TokenDigest digest{};
    SHA256(reinterpret_cast<const unsigned char*>(token.data()), token.size(), digest.data());
    return digest;
}

std::string to_hex(const TokenDigest& digest) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    text.reserve(2 * digest.size());
    for (const unsigned byte : digest) {
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

std::optional<TokenDigest> parse_digest(std::string_view hex) {
    TokenDigest digest{};
    if (hex.size() != 2 * digest.size()) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < digest.size(); ++i) {
        const int high = hex_value(hex[2 * i]);
        const int low = hex_value(hex[2 * i + 1]);
        if (high < 0 || low < 0) {
            return std::nullopt;
        }
        digest[i] = static_cast<std::uint8_t>(16 * high + low);
    }
    return digest;
}

std::optional<v1::Role> parse_role(std::string_view name) {
    v1::Role role = v1::ROLE_UNSPECIFIED;
    if (!v1::Role_Parse(std::string(name), &role) || role == v1::ROLE_UNSPECIFIED) {
        return std::nullopt;
    }
    return role;
}

std::optional<AccessToken> AccessTokens::find(const TokenDigest& digest) const {
    std::optional<AccessToken> found;
    for (const AccessToken& token : tokens_) {
        if (CRYPTO_memcmp(token.digest.data(), digest.data(), digest.size()) == 0) {
            found = token;
        }
    }
    return found;
}

bool same_name(std::string_view a, std::string_view b) {
    const auto trimmed = [](std::string_view text) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        return text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
    };
    const auto lower = [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c; };
    a = trimmed(a);
    b = trimmed(b);
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) {
        return lower(static_cast<unsigned char>(x)) == lower(static_cast<unsigned char>(y));
    });
}

bool AccessTokens::owns_name(std::string_view name) const {
    return std::any_of(tokens_.begin(), tokens_.end(), [name](const AccessToken& token) {
        return !token.name.empty() && same_name(token.name, name);
    });
}

std::optional<v1::Role> AccessTokens::role_of(const TokenDigest& digest) const {
    if (tokens_.empty()) {
        return v1::EDITOR;
    }
    const auto token = find(digest);
    return token ? std::optional(token->role) : std::nullopt;
}

}  // namespace raybundle
