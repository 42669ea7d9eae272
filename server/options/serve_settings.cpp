// SPDX-License-Identifier: Apache-2.0
#include "options/serve_settings.h"

#include <arpa/inet.h>
#include <spdlog/spdlog.h>

#include <fstream>
#include <memory>

namespace raybundle {
namespace {

constexpr std::uint32_t bytes_per_megabyte = 1'000'000;

bool is_loopback(const std::string& host) {
    in_addr ipv4{};
    const bool numeric = inet_pton(AF_INET, host.c_str(), &ipv4) == 1;
    return host == "localhost" || host == "::1" || (numeric && (ntohl(ipv4.s_addr) >> 24U) == 127U);
}

/// All of a file without the line end that editors add. Throws UsageError.
std::string content_of(const std::string& file) {
    constexpr std::size_t max_bytes = 65536;
    std::ifstream stream(file, std::ios::binary);
    std::string text(max_bytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (!stream.is_open() || stream.bad()) {
        throw UsageError("jwt: " + file + ": cannot be read");
    }
    if (text.size() > max_bytes) {
        throw UsageError("jwt: " + file + ": has more than 65536 bytes");
    }
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) {
        text.pop_back();
    }
    if (text.empty()) {
        throw UsageError("jwt: " + file + ": is empty");
    }
    return text;
}

/// Null where there is none. Throws UsageError.
std::shared_ptr<const JwtVerifier> jwt_verifier(const Options& options) {
    if (!options.network.jwt) {
        return nullptr;
    }
    const JwtOptions& jwt = *options.network.jwt;
    JwtSettings settings;
    settings.issuer = jwt.issuer;
    settings.audience = jwt.audience;
    settings.role_claim = jwt.role_claim;
    settings.name_claim = jwt.name_claim;
    if (!jwt.secret_file.empty()) {
        settings.secret = content_of(jwt.secret_file);
    }
    for (const std::string& file : jwt.key_files) {
        settings.public_keys.push_back(content_of(file) + "\n");
    }
    try {
        return std::make_shared<const JwtVerifier>(settings);
    } catch (const std::runtime_error& error) {
        throw UsageError(std::string("jwt: ") + error.what());
    }
}

bool has_tokens(const Options& options) {
    return !options.network.tokens.empty() || options.network.jwt.has_value();
}

void check_exposure(const Options& options, const std::string& host) {
    if (is_loopback(host)) {
        return;
    }
    if (!has_tokens(options) && !options.network.allow_remote) {
        throw UsageError("--listen " + options.network.listen +
                         " lets anyone on the network change the scene; configure tokens, or add "
                         "--allow-remote if that is meant");
    }
    if (has_tokens(options) && options.network.tls_cert.empty()) {
        spdlog::warn("tokens travel unencrypted to {}: use --tls-cert and --tls-key",
                     options.network.listen);
    }
}

}  // namespace

std::shared_ptr<AuditLog> open_audit_log(const Options& options) {
    try {
        return options.network.audit_log.empty()
                   ? nullptr
                   : std::make_shared<AuditLog>(options.network.audit_log);
    } catch (const std::runtime_error& error) {
        throw UsageError(std::string("--audit-log ") + error.what());
    }
}

ServerSettings server_settings(const Options& options) {
    const auto [host, port] = parse_address(options.network.listen);
    check_exposure(options, host);
    if (options.network.tls_cert.empty() != options.network.tls_key.empty()) {
        throw UsageError("--tls-cert and --tls-key belong together");
    }
    ServerSettings settings;
    settings.host = host;
    settings.port = port;
    settings.tls_certificate = options.network.tls_cert;
    settings.tls_key = options.network.tls_key;
    settings.max_viewers = static_cast<std::size_t>(options.serve.max_viewers);
    settings.max_connections = static_cast<std::size_t>(options.network.max_connections);
    settings.max_connections_per_address =
        static_cast<std::size_t>(options.network.max_connections_per_address);
    settings.trusted_proxies = options.network.trusted_proxies;
    settings.max_messages_per_second = options.network.max_messages_per_second;
    if (!options.serve.scenes.empty()) {
        settings.max_upload_bytes =
            static_cast<std::uint32_t>(options.serve.max_upload_megabytes) * bytes_per_megabyte;
    }
    settings.max_upload_s = options.serve.max_upload_seconds;
    // Without tokens, who reaches the server may do everything: on this machine a browser can be
    // made to by any page.
    const bool no_foreign_names =
        !has_tokens(options) && is_loopback(host) && !options.network.allow_remote;
    settings.access = {AccessTokens(options.network.tokens),
                       {options.network.allowed_origins, no_foreign_names},
                       jwt_verifier(options)};
    return settings;
}

}  // namespace raybundle
