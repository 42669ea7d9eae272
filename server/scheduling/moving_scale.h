// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scheduling/scheduling_settings.h"

namespace raybundle {

/// Chooses the size of pictures in motion, so that frames come often enough to be seen as motion:
/// full size while there is time for it, else smaller, by steps. Has no clock of its own.
class MovingScale {
  public:
    explicit MovingScale(const MovingScaleSettings& settings = {}) : settings_(settings) {}

    /// full_ms: time of a frame for every picture in motion, if all were full. budget_ms: time that
    /// they may take.
    void note(double full_ms, double budget_ms);

    /// Of width and height, at most 1.
    [[nodiscard]] double scale() const { return scale_; }

  private:
    MovingScaleSettings settings_;
    double scale_ = 1.0;
};

}  // namespace raybundle
