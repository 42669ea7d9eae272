// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace raybundle {

/// Who is at the other end of a connection.
struct PeerAddress {
    /// What connections are counted by: the IPv4 address, or the /64 network of an IPv6 address,
    /// which is what one subscriber gets. Empty: unknown.
    std::string key;
    bool loopback = false;  ///< this machine, for example a reverse proxy
    std::string text{};     ///< the whole address
};

/// Peer of a connected TCP socket.
PeerAddress peer_address(int socket);

/// Connections open by address.
class AddressCount {
  public:
    void add(const std::string& key) { ++open_[key]; }

    void remove(const std::string& key) {
        const auto found = open_.find(key);
        if (found != open_.end() && --found->second == 0) {
            open_.erase(found);
        }
    }

    [[nodiscard]] std::size_t of(const std::string& key) const {
        const auto found = open_.find(key);
        return found == open_.end() ? 0 : found->second;
    }

  private:
    std::map<std::string, std::size_t> open_;
};

}  // namespace raybundle
