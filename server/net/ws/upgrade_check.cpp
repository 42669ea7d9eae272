// SPDX-License-Identifier: Apache-2.0
#include "net/ws/upgrade_check.h"

#include <algorithm>
#include <cctype>

namespace raybundle {
namespace {

constexpr int kBadRequest = 400;
constexpr int kForbidden = 403;
constexpr int kNotFound = 404;

bool equal_ignoring_case(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

/// "host:port" of an http or https origin; empty for any other.
std::string_view authority(std::string_view origin) {
    for (const std::string_view scheme : {"http://", "https://"}) {
        if (equal_ignoring_case(origin.substr(0, scheme.size()), scheme)) {
            return origin.substr(scheme.size());
        }
    }
    return {};
}

/// Whether "host" or "host:port" is an IPv4 or IPv6 address or localhost, so that no name server
/// has a say in what it means. No name of the DNS ends in a label of digits only (RFC 3696, 2).
bool is_fixed(std::string_view host) {
    if (host.starts_with('[')) {
        return true;
    }
    host = host.substr(0, host.find(':'));
    constexpr std::string_view kLocal = "localhost";
    return equal_ignoring_case(host, kLocal) ||
           (!host.empty() && host.find_first_not_of("0123456789.") == std::string_view::npos);
}

/// Whether a Sec-WebSocket-Key is 16 bytes in base64: 22 digits and the padding.
bool is_key(std::string_view key) {
    constexpr std::size_t kDigits = 22;
    return key.size() == kDigits + 2 && key.ends_with("==") &&
           std::all_of(key.begin(), key.begin() + kDigits, [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '+' || c == '/';
           });
}

/// Whether a list of subprotocols is empty or has ours.
bool offers_ours(std::string_view protocols) {
    bool any = false;
    while (!protocols.empty()) {
        const std::size_t end = std::min(protocols.find(','), protocols.size());
        std::string_view name = protocols.substr(0, end);
        name.remove_prefix(std::min(name.find_first_not_of(" \t"), name.size()));
        name = name.substr(0, name.find_last_not_of(" \t") + 1);
        if (name == kSubprotocol) {
            return true;
        }
        any = any || !name.empty();
        protocols.remove_prefix(std::min(end + 1, protocols.size()));
    }
    return !any;
}

}  // namespace

bool origin_allowed(std::string_view origin, std::string_view host, const OriginRules& rules) {
    const std::string_view page = authority(origin);
    const bool own = !page.empty() && equal_ignoring_case(page, host);
    if (origin.empty() || (own && (!rules.no_foreign_names || is_fixed(host)))) {
        return true;
    }
    return std::any_of(rules.allowed.begin(), rules.allowed.end(), [&](const std::string& allowed) {
        return equal_ignoring_case(allowed, origin);
    });
}

int refusal_status(const UpgradeRequest& request, const OriginRules& rules) {
    if (request.path != "/ws") {
        return kNotFound;
    }
    return origin_allowed(request.origin, request.host, rules) ? 0 : kForbidden;
}

std::optional<HttpResponse> refuse_upgrade(const UpgradeRequest& request,
                                           const OriginRules& rules) {
    const auto refuse = [](int status, std::string text) {
        HttpResponse response;
        response.status = status;
        response.body = std::move(text);
        return response;
    };
    const int status = refusal_status(request, rules);
    if (status == kNotFound) {
        return refuse(kNotFound, "Not found; the WebSocket address is /ws\n");
    }
    if (status == kForbidden) {
        return refuse(kForbidden, "A page of another origin may not connect\n");
    }
    if (request.version != "13") {
        return upgrade_required("Sec-WebSocket-Version must be 13\n");
    }
    if (!is_key(request.key)) {
        return refuse(kBadRequest, "Sec-WebSocket-Key must be 16 bytes in base64\n");
    }
    if (!offers_ours(request.protocols)) {
        return refuse(kBadRequest, "Unknown subprotocol, this server speaks " +
                                       std::string(kSubprotocol) + "\n");
    }
    return std::nullopt;
}

}  // namespace raybundle
