// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scheduling/scheduling_settings.h"

namespace raybundle {

/// How many bundles a special phase has time for until the deadline of the first frame after a
/// change, by what earlier phases took. Has no clock of its own.
class PhaseBudget {
  public:
    explicit PhaseBudget(const ChangeSettings& settings = {}) : settings_(settings) {}

    /// Notes that a phase begins. A phase that has not ended before does not count.
    void begin(double now_ms);
    /// Notes that a bundle of the phase has been transferred. last: the phase ends; the next one is
    /// expected to take as long, waiting included.
    void note_bundle(double now_ms, bool last);
    /// Time since the running phase, or the last one, began.
    [[nodiscard]] double elapsed_ms(double now_ms) const { return now_ms - since_ms_; }

    /// Bundles until the deadline; nothing before the first phase has been measured.
    [[nodiscard]] std::optional<double> bundles_in_time() const;

  private:
    ChangeSettings settings_;
    std::optional<double> bundle_ms_;
    double since_ms_ = 0.0;  // of the running phase
    unsigned bundles_ = 0;   // likewise
};

}  // namespace raybundle
