// SPDX-License-Identifier: Apache-2.0
// What pictures of changed scenes state of their error, against the truth by path tracing.
#pragma once

#include <vector>

#include "changed_scene.h"
#include "research/accuracy/reference_picture.h"

namespace raybundle {

/// True error of a picture and what it stated, relative to the true picture.
struct StatedError {
    double error = 0.0;
    double stated = 0.0, low = 0.0, high = 0.0;
    double level = 0.0;  ///< factor of the true picture that comes nearest
};

/// The last state of a case as path tracing sees it.
class KnownPicture {
  public:
    explicit KnownPicture(const ChangeCase& c);

    [[nodiscard]] StatedError judge(const Served& served) const;
    [[nodiscard]] double noise() const { return reference_.noise->relative_rmse; }
    /// Root mean square of the pixels that count, cd/m².
    [[nodiscard]] double light() const { return light_; }

  private:
    std::vector<bool> measured_;
    ReferencePicture reference_;
    double light_ = 0.0;
};

struct StatedSummary {
    unsigned pictures = 0, covered = 0, above = 0;
    double error = 0.0;                          ///< root mean square
    double level = 0.0;                          ///< mean
    double stated = 0.0, low = 0.0, high = 0.0;  ///< medians
    double high_over_error = 0.0;                ///< median
    double log_mean = 0.0;                       ///< of ln(true error / stated error)
    double log_deviation = 0.0;                  ///< standard deviation of the same
};

StatedSummary summary_of(const std::vector<StatedError>& stated);

}  // namespace raybundle
