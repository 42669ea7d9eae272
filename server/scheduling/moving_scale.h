// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scheduling/scheduling_settings.h"

namespace raybundle {

/// Size of the pictures whose cameras move, so that their frames keep a rhythm that people see as
/// motion: full while there is time for it, else as much smaller as it takes, by steps. Has no
/// clock of its own.
class MovingScale {
  public:
    explicit MovingScale(const MovingScaleSettings& settings = {}) : settings_(settings) {}

    /// A frame for each who moves would take full_ms if their pictures were full, and shall take
    /// no more than budget_ms.
    void note(double full_ms, double budget_ms);

    /// Of width and height, at most 1.
    [[nodiscard]] double scale() const { return scale_; }

  private:
    MovingScaleSettings settings_;
    double scale_ = 1.0;
};

}  // namespace raybundle
