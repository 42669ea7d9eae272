// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raybundle {

/// What a WebSocket handshake says about itself.
struct UpgradeRequest {
    std::string path;
    std::string origin;  ///< empty: not a browser
    std::string host;
};

/// Whether a page of this origin may talk to the server: its own, by the Host header, one of the
/// list, or no page at all (empty).
bool origin_allowed(std::string_view origin, std::string_view host,
                    std::span<const std::string> allowed_origins);

/// HTTP status to refuse a handshake with, or 0 to accept it: 404 elsewhere than /ws, 403 for a
/// page of another origin that is not in `allowed_origins`. Without this check any page that a
/// viewer happens to visit could drive a server on his own machine or network.
int refusal_status(const UpgradeRequest& request, std::span<const std::string> allowed_origins);

}  // namespace raybundle
