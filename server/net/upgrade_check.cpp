// SPDX-License-Identifier: Apache-2.0
#include "net/upgrade_check.h"

#include <algorithm>
#include <cctype>

namespace raybundle {
namespace {

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

}  // namespace raybundle
