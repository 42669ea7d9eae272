// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace raybundle {

/// Size of the pictures whose cameras move, so that their frames keep a rhythm that people see as
/// motion: full while there is time for it, else as much smaller as it takes, by steps. Has no
/// clock of its own.
class MovingScale {
  public:
    static constexpr double kMin = 0.625;  ///< of width and height
    static constexpr double kStep = 1.0 / 16.0;

    /// A frame for each who moves would take full_ms if their pictures were full, and shall take
    /// no more than budget_ms.
    void note(double full_ms, double budget_ms);

    /// Of width and height, kMin to 1.
    [[nodiscard]] double scale() const { return scale_; }

  private:
    double scale_ = 1.0;
};

}  // namespace raybundle
