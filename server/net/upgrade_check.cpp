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

int refusal_status(const UpgradeRequest& request, std::span<const std::string> allowed_origins) {
    if (request.path != "/ws") {
        return kNotFound;
    }
    if (request.origin.empty()) {
        return 0;
    }
    const std::string_view page = authority(request.origin);
    if (!page.empty() && equal_ignoring_case(page, request.host)) {
        return 0;
    }
    const bool allowed = std::any_of(
        allowed_origins.begin(), allowed_origins.end(),
        [&](const std::string& origin) { return equal_ignoring_case(origin, request.origin); });
    return allowed ? 0 : kForbidden;
}

}  // namespace raybundle
