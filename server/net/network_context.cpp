// SPDX-License-Identifier: Apache-2.0
#include "net/network_context.h"

#include <openssl/ssl.h>
#include <spdlog/spdlog.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "net/access/listen_address.h"
#include "net/access/tls_certificate.h"

namespace raybundle {
namespace {

constexpr std::size_t kReceiveBytes = 16384;
constexpr std::size_t kSendBytes = 65536;
constexpr unsigned kServiceBufferBytes = 32768;
/// What libwebsockets reads of headers before it hangs up without a word; the least that leaves
/// room to answer 431 to who is beyond kMaxHeaderBytes, most that its unsigned short takes.
constexpr unsigned short kReadHeaderBytes = 61440;
static_assert(kReadHeaderBytes > 2 * kMaxHeaderBytes);

/// A viewer that has been silent for so long is pinged, then given up.
const lws_retry_bo_t kKeepAlive = [] {
    lws_retry_bo_t policy{};
    policy.secs_since_valid_ping = 20;
    policy.secs_since_valid_hangup = 40;
    return policy;
}();

/// libwebsockets' own words. What matters to an operator is logged where it is handled.
void log_line(int level, const char* line) {
    std::string_view text(line);
    while (!text.empty() && text.back() == '\n') {
        text.remove_suffix(1);
    }
    spdlog::log(level == LLL_ERR ? spdlog::level::warn : spdlog::level::debug, "lws: {}", text);
}

lws_context_creation_info context_info(const ServerSettings& settings, const ListenAddress& address,
                                       const lws_protocols* protocols, void* user) {
    lws_context_creation_info info{};
    info.port = settings.port;
    info.iface = address.is_any ? nullptr : address.numeric.c_str();
    info.protocols = protocols;
    info.user = user;
    info.vhost_name = "raybundle";
    info.alpn = "http/1.1";  // WebSocket over HTTP/2 has no use here
    info.max_http_header_data = kReadHeaderBytes;
    info.pt_serv_buf_size = kServiceBufferBytes;
    info.retry_and_idle_policy = &kKeepAlive;
    info.timeout_secs = 10;
    info.keepalive_timeout = 30;
    info.gid = static_cast<decltype(info.gid)>(-1);
    info.uid = static_cast<decltype(info.uid)>(-1);
    info.options = LWS_SERVER_OPTION_VALIDATE_UTF8 | LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND |
                   LWS_SERVER_OPTION_EXPLICIT_VHOSTS;
    if (!address.is_ipv6) {
        info.options |= LWS_SERVER_OPTION_DISABLE_IPV6;
    }
    if (!settings.tls_certificate.empty()) {
        info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
        info.ssl_cert_filepath = settings.tls_certificate.c_str();
        info.ssl_private_key_filepath = settings.tls_key.c_str();
    }
    return info;
}

[[noreturn]] void throw_cannot_listen(const ServerSettings& settings,
                                      const ListenAddress& address) {
    std::string reason = listen_problem(address, settings.port);
    if (reason.empty()) {
        reason = settings.tls_certificate.empty()
                     ? "the network library refused"
                     : "certificate " + settings.tls_certificate + " or key " + settings.tls_key +
                           " cannot be used";
    }
    throw std::runtime_error("cannot listen on " + host_and_port(settings.host, settings.port) +
                             ": " + reason);
}

}  // namespace

void require_modern_tls(ssl_ctx_st* context) {
    SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
}

NetworkContext create_network_context(const ServerSettings& settings,
                                      lws_callback_function* callback, void* user) {
    lws_set_log_level(LLL_ERR | LLL_WARN | LLL_NOTICE, &log_line);
    const ListenAddress address = resolve_listen_address(settings.host);
    if (!settings.tls_certificate.empty()) {
        const TlsCertificate checked(settings.tls_certificate, settings.tls_key);
    }
    const lws_protocols protocols[] = {
        {kSubprotocol, callback, 0, kReceiveBytes, 0, nullptr, kSendBytes},
        {nullptr, nullptr, 0, 0, 0, nullptr, 0}};
    const lws_context_creation_info info = context_info(settings, address, protocols, user);
    lws_context* const context = lws_create_context(&info);
    if (context == nullptr) {
        throw std::runtime_error("the network library cannot be initialised");
    }
    lws_vhost* const vhost = lws_create_vhost(context, &info);
    if (vhost == nullptr) {
        lws_context_destroy(context);
        throw_cannot_listen(settings, address);
    }
    return {context, static_cast<std::uint16_t>(lws_get_vhost_listen_port(vhost))};
}

}  // namespace raybundle
