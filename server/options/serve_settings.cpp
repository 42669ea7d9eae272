// SPDX-License-Identifier: Apache-2.0
#include "options/serve_settings.h"

#include <arpa/inet.h>
#include <spdlog/spdlog.h>

namespace raybundle {
namespace {

constexpr std::uint32_t bytes_per_megabyte = 1'000'000;

bool is_loopback(const std::string& host) {
    in_addr ipv4{};
    const bool numeric = inet_pton(AF_INET, host.c_str(), &ipv4) == 1;
    return host == "localhost" || host == "::1" || (numeric && (ntohl(ipv4.s_addr) >> 24U) == 127U);
}

void check_exposure(const Options& options, const std::string& host) {
    if (is_loopback(host)) {
        return;
    }
    if (options.tokens.empty() && !options.allow_remote) {
        throw UsageError("--listen " + options.listen +
                         " lets anyone on the network change the scene; configure tokens, or add "
                         "--allow-remote if that is meant");
    }
    if (!options.tokens.empty() && options.tls_cert.empty()) {
        spdlog::warn("tokens travel unencrypted to {}: use --tls-cert and --tls-key",
                     options.listen);
    }
}

}  // namespace

ServerSettings server_settings(const Options& options) {
    const auto [host, port] = parse_address(options.listen);
    check_exposure(options, host);
    if (options.tls_cert.empty() != options.tls_key.empty()) {
        throw UsageError("--tls-cert and --tls-key belong together");
    }
    ServerSettings settings;
    settings.host = host;
    settings.port = port;
    settings.tls_certificate = options.tls_cert;
    settings.tls_key = options.tls_key;
    settings.max_viewers = static_cast<std::size_t>(options.max_viewers);
    settings.max_connections = static_cast<std::size_t>(options.max_connections);
    settings.max_connections_per_address =
        static_cast<std::size_t>(options.max_connections_per_address);
    settings.trusted_proxies = options.trusted_proxies;
    settings.max_messages_per_second = options.max_messages_per_second;
    if (!options.scenes.empty()) {
        settings.max_upload_bytes =
            static_cast<std::uint32_t>(options.max_upload_megabytes) * bytes_per_megabyte;
    }
    settings.max_upload_s = options.max_upload_seconds;
    // Without tokens, who reaches the server may do everything: on this machine a browser can be
    // made to by any page.
    const bool no_foreign_names = options.tokens.empty() && is_loopback(host);
    settings.access = {AccessTokens(options.tokens), {options.allowed_origins, no_foreign_names}};
    return settings;
}

}  // namespace raybundle
