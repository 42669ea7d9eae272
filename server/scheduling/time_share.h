// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace raybundle {

/// Lets something take part in iterations as long as what it adds to their cost stays below a share
/// of what they cost without it, in the long run.
class TimeShare {
  public:
    /// share: of the usual cost; max_credit_ms: what may be saved up for later; smoothing: weight
    /// of the newest iteration in the usual cost.
    TimeShare(double share, double max_credit_ms, double smoothing)
        : share_(share), max_credit_ms_(max_credit_ms), smoothing_(smoothing) {}

    /// Whether it may take part in what comes next.
    [[nodiscard]] bool may() const { return credit_ms_ > 0.0; }

    /// An iteration has cost so much, with it or without.
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

    /// It has cost so much besides.
    void charge(double cost_ms) { credit_ms_ -= cost_ms; }

  private:
    double share_, max_credit_ms_, smoothing_;
    double credit_ms_ = 0.0;
    double usual_ms_ = 0.0;  ///< of an iteration without it, running mean; 0: not known
};

}  // namespace raybundle
