// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "scheduling/scheduling_settings.h"

namespace raybundle {

/// Bounds the time that a kind of work takes: to a share of the time that passes, and to a burst
/// after a pause. One piece of work may overdraw; the next waits until that has been paid back. Has
/// no clock of its own.
class TimeBudget {
  public:
    explicit TimeBudget(const BudgetSettings& settings)
        : share_(settings.share), burst_ms_(settings.burst_ms), credit_ms_(settings.burst_ms) {}

    /// Whether there is time for another piece of work. A clock that jumps back stands still.
    [[nodiscard]] bool may(double now_ms) {
        const double earned = share_ * std::max(now_ms - last_ms_, 0.0);
        credit_ms_ = std::min(credit_ms_ + earned, burst_ms_);
        last_ms_ = now_ms;
        return credit_ms_ > 0.0;
    }

    /// Sets the share from now on.
    void set_share(double share) { share_ = share; }
    void charge(double cost_ms) { credit_ms_ -= cost_ms; }

  private:
    double share_, burst_ms_;
    double credit_ms_;
    double last_ms_ = 0.0;
};

}  // namespace raybundle
