// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace raybundle {

/// A numeric address to listen on.
struct ListenAddress {
    std::string numeric;  ///< e.g. "127.0.0.1" or "::1"
    bool is_ipv6 = false;
    bool is_any = false;  ///< all interfaces
};

/// Resolves a host name or numeric address. Throws std::runtime_error that names it.
ListenAddress resolve_listen_address(const std::string& host);

/// Why a socket cannot listen there, e.g. "Address already in use"; empty where it can.
std::string listen_problem(const ListenAddress& address, std::uint16_t port);

/// "host:port", with brackets around an IPv6 address.
std::string host_and_port(const std::string& host, std::uint16_t port);

}  // namespace raybundle
