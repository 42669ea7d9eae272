// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace raybundle {

/// Counts wrong tokens by peer and says how long their answers wait. A valid token is never held
/// up: whoever shares an address with a guesser gets in. Any thread; no clock of its own.
class WrongTokens {
  public:
    /// Answered at once: who mistypes may correct himself as often as one connection lets him.
    static constexpr std::uint64_t free_tries = 3;
    static constexpr double first_delay_ms = 250.0;
    static constexpr double last_delay_ms = 4000.0;  ///< below the time for hello
    static constexpr double forgotten_ms = 60000.0;  ///< after the last wrong token
    static constexpr std::size_t max_peers = 4096;   ///< remembered; the oldest is forgotten

    struct Answer {
        double delay_ms = 0.0;           ///< 0 for the free tries, then doubling
        bool worth_a_line = true;        ///< of the log: the 1st, 2nd, 4th, 8th ... of a peer
        std::uint64_t of_this_peer = 1;  ///< so far
    };

    Answer note(const std::string& peer, double now_ms);

    [[nodiscard]] std::uint64_t total() const;

  private:
    struct Peer {
        std::uint64_t count = 0;
        double last_ms = 0.0;
    };

    void forget_old(double now_ms);
    void forget_oldest();

    mutable std::mutex mutex_;
    std::map<std::string, Peer> peers_;
    std::uint64_t total_ = 0;
};

}  // namespace raybundle
