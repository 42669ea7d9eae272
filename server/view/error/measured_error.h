// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "reference/spot_check.h"
#include "view/viewer_image.h"

namespace raybundle {

/// Of the squared error of a picture less is worth knowing than this share of it.
constexpr double known_well = 0.15;
/// More paths are worth while after so many times as many samples.
constexpr double next_check_factor = 1.25;

/// What was measured of the true error of a picture, and what it makes of that which the picture's
/// samples say from then on: the error is taken to fall as they say, and is known the less the more
/// samples have come since.
///
/// What samples did not know of stays when the picture shows something else, a changed scene or
/// another view: they know no more of it then. It is part of the error until paths say otherwise.
class MeasuredError {
  public:
    /// by_samples: the statistics when it was measured. What was measured too badly to say more
    /// than they do changes nothing.
    void take(const SquaredError& square, const ImageStatistics& by_samples);
    /// The picture shows something else from now on.
    void carry_over();
    [[nodiscard]] bool known() const { return square_.has_value(); }

    /// The statistics of the picture with its error and interval as measured.
    [[nodiscard]] ImageStatistics with(const ImageStatistics& by_samples) const;
    /// Factor of the samples that bring the upper end of that interval to a target, >= 1; infinite
    /// where none do. unresolved: what will be left by then of what the pixels do not resolve.
    [[nodiscard]] double samples_factor_to(double target, const ImageStatistics& by_samples,
                                           SampleOrder order, double unresolved = 1.0) const;

  private:
    [[nodiscard]] SquaredError now(const ImageStatistics& by_samples) const;
    [[nodiscard]] ImageStatistics with_carried(const ImageStatistics& by_samples) const;

    std::optional<SquaredError> square_;
    ImageStatistics said_;       // when it was measured
    double carried_square_ = 0;  // that samples did not know of, of what was shown before
};

}  // namespace raybundle
