// SPDX-License-Identifier: Apache-2.0
#include "net/access/address_count.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace raybundle {
namespace {

PeerAddress of_ipv4(const in_addr& address) {
    std::array<char, INET_ADDRSTRLEN> text{};
    inet_ntop(AF_INET, &address, text.data(), text.size());
    return {text.data(), (ntohl(address.s_addr) >> 24U) == 127U, text.data()};
}

PeerAddress of_ipv6(in6_addr address) {
    if (IN6_IS_ADDR_V4MAPPED(&address)) {
        in_addr inner{};
        std::memcpy(&inner, &address.s6_addr[12], sizeof inner);
        return of_ipv4(inner);
    }
    const bool loopback = IN6_IS_ADDR_LOOPBACK(&address);
    std::array<char, INET6_ADDRSTRLEN> whole{};
    inet_ntop(AF_INET6, &address, whole.data(), whole.size());
    std::fill(std::begin(address.s6_addr) + 8, std::end(address.s6_addr), std::uint8_t{0});
    std::array<char, INET6_ADDRSTRLEN> text{};
    inet_ntop(AF_INET6, &address, text.data(), text.size());
    return {std::string(text.data()) + "/64", loopback, whole.data()};
}

}  // namespace

PeerAddress peer_address(int socket) {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    if (getpeername(socket, reinterpret_cast<sockaddr*>(&storage), &size) != 0) {
        return {};
    }
    if (storage.ss_family == AF_INET) {
        return of_ipv4(reinterpret_cast<const sockaddr_in&>(storage).sin_addr);
    }
    if (storage.ss_family == AF_INET6) {
        return of_ipv6(reinterpret_cast<const sockaddr_in6&>(storage).sin6_addr);
    }
    return {};
}

}  // namespace raybundle
