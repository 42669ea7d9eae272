// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "net/http/http_response.h"

namespace raybundle {

/// Name of the WebSocket subprotocol. A client may also name none.
inline constexpr const char* kSubprotocol = "raybundle.v1";

/// What a WebSocket handshake says about itself.
struct UpgradeRequest {
    std::string path;
    std::string origin;  ///< empty: not a browser
    std::string host;
    std::string version = "13";                    ///< Sec-WebSocket-Version
    std::string key = "dGhlIHNhbXBsZSBub25jZQ==";  ///< Sec-WebSocket-Key
    std::string protocols{};                       ///< Sec-WebSocket-Protocol; empty: none named
};

/// Which pages may talk to the server besides its own.
struct OriginRules {
    std::vector<std::string> allowed;  ///< e.g. "https://a.example"
    /// Its own are only those that came by a numeric address or from localhost. Whoever owns
    /// another name may let it mean this machine once his page is loaded (DNS rebinding), and the
    /// page's Origin and Host agree.
    bool no_foreign_names = false;
};

/// Whether a page of this origin may talk to the server: its own, by the Host header, one that is
/// allowed, or no page at all (empty).
bool origin_allowed(std::string_view origin, std::string_view host, const OriginRules& rules);

/// HTTP status to refuse a handshake with, or 0 to accept it: 404 elsewhere than /ws, 403 for a
/// page of another origin that the rules do not allow. Without this check any page that a viewer
/// happens to visit could drive a server on his own machine or network.
int refusal_status(const UpgradeRequest& request, const OriginRules& rules);

/// The answer that refuses a handshake, or nothing: what refusal_status() refuses, and what
/// RFC 6455, 4.2 does: 426 for another version than 13, 400 for a key that is not 16 bytes in
/// base64, or subprotocols none of which is spoken here. libwebsockets accepts the first two, and
/// hangs up without a word at the third.
std::optional<HttpResponse> refuse_upgrade(const UpgradeRequest& request, const OriginRules& rules);

}  // namespace raybundle
