// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace raybundle {

/// Lets a guest take part in iterations. In the long run, the guest adds at most a share of what
/// iterations cost without it. Has no clock of its own.
class TimeShare {
  public:
    /// share: of the usual cost; max_credit_ms: what may be saved up for later; smoothing: weight
    /// of the newest iteration in the usual cost.
    TimeShare(double share, double max_credit_ms, double smoothing)
        : share_(share), max_credit_ms_(max_credit_ms), smoothing_(smoothing) {}

    /// Whether the guest may take part in the next iterations.
    [[nodiscard]] bool may() const { return credit_ms_ > 0.0; }

    /// Notes the cost of an iteration, with the guest or without.
    void note_iteration(double cost_ms, bool took_part) {
        if (!took_part) {
            usual_ms_ = usual_ms_ == 0.0 ? cost_ms : usual_ms_ + smoothing_ * (cost_ms - usual_ms_);
        }
        const double usual = std::min(cost_ms, usual_ms_);
        credit_ms_ += share_ * usual;
        if (took_part) {
            charge(cost_ms - usual);
        }
        credit_ms_ = std::min(credit_ms_, max_credit_ms_);
    }

    /// Notes other work for the guest.
    void charge(double cost_ms) { credit_ms_ -= cost_ms; }

  private:
    double share_, max_credit_ms_, smoothing_;
    double credit_ms_ = 0.0;
    double usual_ms_ = 0.0;  ///< of an iteration without it, running mean; 0: not known
};

}  // namespace raybundle
