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

}  // namespace

bool origin_allowed(std::string_view origin, std::string_view host,
                    std::span<const std::string> allowed_origins) {
    const std::string_view page = authority(origin);
    if (origin.empty() || (!page.empty() && equal_ignoring_case(page, host))) {
        return true;
    }
    return std::any_of(
        allowed_origins.begin(), allowed_origins.end(),
        [&](const std::string& allowed) { return equal_ignoring_case(allowed, origin); });
}

int refusal_status(const UpgradeRequest& request, std::span<const std::string> allowed_origins) {
    if (request.path != "/ws") {
        return kNotFound;
    }
    return origin_allowed(request.origin, request.host, allowed_origins) ? 0 : kForbidden;
}

}  // namespace raybundle
