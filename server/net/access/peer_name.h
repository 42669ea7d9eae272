// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// Who sent a request, for the log and for counting: the address of the socket, or where that is a
/// trusted proxy's, the last entry of X-Forwarded-For that is not one. Entries further left are the
/// client's own words. An entry that is no address is not believed.
std::string peer_name(const std::string& address, std::string_view forwarded_for,
                      const std::vector<std::string>& trusted_proxies);

/// Whether a text is a numeric IPv4 or IPv6 address.
bool is_address(const std::string& text);

}  // namespace raybundle
