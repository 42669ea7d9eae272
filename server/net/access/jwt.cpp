// SPDX-License-Identifier: Apache-2.0
#include "net/access/jwt.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/pem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace raybundle {
namespace {

using Json = nlohmann::json;

constexpr std::size_t min_secret_bytes = 32;  // RFC 7518, 3.2: as long as the hash
constexpr int min_key_bits = 2048;            // likewise, 3.3
constexpr double clock_skew_s = 60.0;         // of who issues, for `nbf`
constexpr std::size_t max_name_bytes = 64;

int base64url_value(char c) {
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    return c == '-' ? 62 : c == '_' ? 63 : -1;
}

/// RFC 4648, without padding. Nothing for other characters, and for bits that are left over.
std::optional<std::string> decode(std::string_view text) {
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        const int value = base64url_value(c);
        if (value < 0) {
            return std::nullopt;
        }
        bits = (bits << 6U) | static_cast<unsigned>(value);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 255U);
            bits &= (1U << static_cast<unsigned>(count)) - 1U;
        }
    }
    return count < 6 && bits == 0 ? std::optional(std::move(bytes)) : std::nullopt;
}

Json parse(const std::string& text) {
    return Json::parse(text, nullptr, false);
}

std::string text_of(const Json& object, const std::string& key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<double> number_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    const bool fits = found != object.end() && found->is_number();
    return fits && std::isfinite(found->get<double>()) ? std::optional(found->get<double>())
                                                       : std::nullopt;
}

/// Whether a claim is a text, or a list that holds it.
bool holds(const Json& object, const char* key, const std::string& wanted) {
    const auto found = object.find(key);
    if (found == object.end()) {
        return false;
    }
    return found->is_array() ? std::find(found->begin(), found->end(), wanted) != found->end()
                             : *found == wanted;
}

/// The highest of the roles that a claim names.
std::optional<v1::Role> role_of(const Json& object, const std::string& key) {
    std::optional<v1::Role> highest;
    for (const v1::Role role : {v1::VIEWER, v1::REVIEWER, v1::EDITOR}) {
        if (holds(object, key.c_str(), v1::Role_Name(role))) {
            highest = role;
        }
    }
    return highest;
}

/// At most max_name_bytes, whole characters of UTF-8.
std::string shortened(std::string name) {
    if (name.size() > max_name_bytes) {
        std::size_t end = max_name_bytes;
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) {
            --end;
        }
        name.resize(end);
    }
    return name;
}

}  // namespace

struct JwtVerifier::Keys {
    using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
    std::vector<Key> rsa;
};

JwtVerifier::~JwtVerifier() = default;

JwtVerifier::JwtVerifier(const JwtSettings& settings)
    : settings_(settings), keys_(std::make_unique<Keys>()) {
    if (settings.issuer.empty() || settings.audience.empty()) {
        throw std::runtime_error("needs an issuer and an audience");
    }
    if (settings.secret.empty() == settings.public_keys.empty()) {
        throw std::runtime_error("needs either a secret or public keys");
    }
    if (!settings.secret.empty() && settings.secret.size() < min_secret_bytes) {
        throw std::runtime_error("the secret has less than 32 bytes");
    }
    std::string all = settings.issuer + '\n' + settings.audience + '\n' + settings.secret + '\n' +
                      settings.role_claim + '\n' + settings.name_claim;
    for (const std::string& pem : settings.public_keys) {
        const std::unique_ptr<BIO, decltype(&BIO_free)> bio(
            BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), &BIO_free);
        Keys::Key key(PEM_read_bio_PUBKEY(bio.get(), nullptr, nullptr, nullptr), &EVP_PKEY_free);
        if (key == nullptr || EVP_PKEY_base_id(key.get()) != EVP_PKEY_RSA) {
            throw std::runtime_error("a public key is no RSA key in PEM (BEGIN PUBLIC KEY)");
        }
        if (EVP_PKEY_bits(key.get()) < min_key_bits) {
            throw std::runtime_error("a public key has less than 2048 bits");
        }
        keys_->rsa.push_back(std::move(key));
        all += '\n' + pem;
    }
    fingerprint_ = token_digest(all);
}

/// By the method that the token names, where the settings have keys for it: none else.
bool JwtVerifier::is_signed(std::string_view method, std::string_view text,
                            const std::string& signature) const {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(text.data());
    const auto* const given = reinterpret_cast<const unsigned char*>(signature.data());
    if (method == "HS256" && !settings_.secret.empty()) {
        std::array<unsigned char, EVP_MAX_MD_SIZE> expected{};
        unsigned size = 0;
        HMAC(EVP_sha256(), settings_.secret.data(), static_cast<int>(settings_.secret.size()),
             bytes, text.size(), expected.data(), &size);
        return signature.size() == size && CRYPTO_memcmp(expected.data(), given, size) == 0;
    }
    if (method != "RS256") {
        return false;
    }
    return std::any_of(keys_->rsa.begin(), keys_->rsa.end(), [&](const Keys::Key& key) {
        const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                              &EVP_MD_CTX_free);
        return EVP_DigestVerifyInit(context.get(), nullptr, EVP_sha256(), nullptr, key.get()) ==
                   1 &&
               EVP_DigestVerify(context.get(), given, signature.size(), bytes, text.size()) == 1;
    });
}

std::optional<JwtPass> JwtVerifier::claims(const std::string& text, double now_s) const {
    const Json body = parse(text);
    if (!body.is_object() || text_of(body, "iss") != settings_.issuer ||
        !holds(body, "aud", settings_.audience)) {
        return std::nullopt;
    }
    const auto expires = number_of(body, "exp");
    const double begins = number_of(body, "nbf").value_or(0.0);
    const auto role = role_of(body, settings_.role_claim);
    if (!expires || now_s >= *expires || now_s + clock_skew_s < begins || !role) {
        return std::nullopt;
    }
    const std::string name = text_of(body, settings_.name_claim);
    return JwtPass{*role, shortened(name.empty() ? text_of(body, "sub") : name), *expires};
}

std::optional<JwtPass> JwtVerifier::verify(std::string_view token, double now_s) const {
    const std::size_t first = token.find('.');
    const std::size_t second = first == std::string_view::npos ? first : token.find('.', first + 1);
    if (second == std::string_view::npos) {
        return std::nullopt;
    }
    const auto head = decode(token.substr(0, first));
    const auto body = decode(token.substr(first + 1, second - first - 1));
    const auto signature = decode(token.substr(second + 1));
    const Json header = head ? parse(*head) : Json();
    // `crit` names extensions that whoever does not know them must refuse.
    if (!body || !signature || !header.is_object() || header.contains("crit") ||
        !is_signed(text_of(header, "alg"), token.substr(0, second), *signature)) {
        return std::nullopt;
    }
    return claims(*body, now_s);
}

bool looks_like_jwt(std::string_view text) {
    return std::count(text.begin(), text.end(), '.') == 2;
}

}  // namespace raybundle
