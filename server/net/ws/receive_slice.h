// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace raybundle {

/// How much of one viewer's messages is worked off before the network thread turns to the others:
/// who floods the server waits, not those beside him.
class ReceiveSlice {
  public:
    /// Derived: parsing takes at most 100 ns a byte, so that a slice takes 2 ms, and 25 viewers
    /// that all flood delay a ping by 50 ms. Measured (CPU time of parse_text_message(), EPYC,
    /// -O1), with cost_of_message: 30 ns (ping) to 52 ns (moveObject); of 20 to 50 kB 12 to 37 ns.
    static constexpr std::size_t max_cost = 20000;
    /// A ping of 11 bytes takes 6.4 µs: what 200 bytes take at 30 ns.
    static constexpr std::size_t cost_of_message = 200;

    /// Counts what has come. False: no more in this slice.
    bool take(std::size_t bytes, bool ends_message) {
        cost_ += bytes + (ends_message ? cost_of_message : 0);
        return !spent();
    }

    [[nodiscard]] bool spent() const { return cost_ >= max_cost; }

    /// The others have had their turn.
    void renew() { cost_ = 0; }

  private:
    std::size_t cost_ = 0;
};

}  // namespace raybundle
