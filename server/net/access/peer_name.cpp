// SPDX-License-Identifier: Apache-2.0
#include "net/access/peer_name.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

namespace raybundle {

bool is_address(const std::string& text) {
    std::array<unsigned char, sizeof(in6_addr)> bytes{};
    return inet_pton(AF_INET, text.c_str(), bytes.data()) == 1 ||
           inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1;
}

std::string peer_name(const std::string& address, std::string_view forwarded_for,
                      const std::vector<std::string>& trusted_proxies) {
    const auto trusted = [&](const std::string& name) {
        return std::find(trusted_proxies.begin(), trusted_proxies.end(), name) !=
               trusted_proxies.end();
    };
    std::string name = address;
    while (trusted(name) && !forwarded_for.empty()) {
        const std::size_t comma = forwarded_for.rfind(',');
        std::string_view entry =
            comma == std::string_view::npos ? forwarded_for : forwarded_for.substr(comma + 1);
        forwarded_for = comma == std::string_view::npos ? "" : forwarded_for.substr(0, comma);
        entry.remove_prefix(std::min(entry.find_first_not_of(" \t"), entry.size()));
        entry = entry.substr(0, entry.find_last_not_of(" \t") + 1);
        if (!is_address(std::string(entry))) {
            break;
        }
        name = entry;
    }
    return name;
}

}  // namespace raybundle
