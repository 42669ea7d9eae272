// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libwebsockets.h>

#include <cstddef>
#include <cstdint>

#include "net/server_settings.h"
#include "net/ws/upgrade_check.h"

struct ssl_ctx_st;

namespace raybundle {

/// A libwebsockets context that listens; `port` is the one it has got.
struct NetworkContext {
    lws_context* context = nullptr;
    std::uint16_t port = 0;
};

/// Bytes of a request's headers, names apart, that are answered: a cookie of a single sign-on has 8
/// kB.
inline constexpr std::size_t kMaxHeaderBytes = 16384;

/// Nothing below TLS 1.2 from now on.
void require_modern_tls(ssl_ctx_st* context);

/// Creates a context with one protocol that handles HTTP and WebSocket in `callback`; `user` comes
/// back from lws_context_user(). Throws std::runtime_error that names the address.
NetworkContext create_network_context(const ServerSettings& settings,
                                      lws_callback_function* callback, void* user);

}  // namespace raybundle
