// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// What a WebSocket handshake says about itself.
struct UpgradeRequest {
    std::string path;
    std::string origin;  ///< empty: not a browser
    std::string host;
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

}  // namespace raybundle
