// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "scheduling/scheduling_settings.h"

namespace raybundle {

/// Bounds what something may take of the time that passes: a share of it in the long run, and so
/// much at once. A single piece of work may overdraw, which is paid back before the next. Has no
/// clock of its own.
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

    /// From now on.
    void set_share(double share) { share_ = share; }
    void charge(double cost_ms) { credit_ms_ -= cost_ms; }

  private:
    double share_, burst_ms_;
    double credit_ms_;
    double last_ms_ = 0.0;
};

}  // namespace raybundle
