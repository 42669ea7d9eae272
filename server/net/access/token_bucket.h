// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace raybundle {

/// Limits a rate: `rate` permits a second on average, `burst` at once. Has no clock of its own.
class TokenBucket {
  public:
    TokenBucket(double rate, double burst) : rate_(rate), burst_(burst), permits_(burst) {}

    /// Takes a permit if there is one. A clock that jumps backwards is taken as standing still.
    bool take(double now_ms) {
        const double elapsed_s = std::max(now_ms - last_ms_, 0.0) / 1000.0;
        last_ms_ = now_ms;
        permits_ = std::min(burst_, permits_ + elapsed_s * rate_);
        if (permits_ < 1.0) {
            return false;
        }
        permits_ -= 1.0;
        return true;
    }

  private:
    double rate_;
    double burst_;
    double permits_;
    double last_ms_ = 0.0;
};

}  // namespace raybundle
