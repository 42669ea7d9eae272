// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "view/error/error_interval.h"

namespace raybundle {

/// Estimated error and brightness of what a viewer shows, from its probe pixels (one in 16).
struct ImageStatistics {
    /// Enough samples for an estimate, in this picture and since objects, lights or materials
    /// changed.
    bool known = false;
    /// Taken since camera or scene changed when this was requested; 0: it is of before that.
    std::uint64_t samples = 0;
    double relative_error = 1.0;  ///< estimated relRMSE of luminance
    double error_low = 1.0;       ///< 95 % interval
    double error_high = 1.0;
    double noise = 1.0;           ///< part of the error that more samples take away
    double discretisation = 0.0;  ///< the rest: detail finer than the pixels, and where errors are
                                  ///< measured whatever else is wrong
    double mean_log_luminance = 0.0;  ///< mean of ln(luminance / (cd/m²))
    double rms_luminance = 0.0;       ///< cd/m²
    double unresolved_light = 0.0;    ///< cd/m²; that no picture of this scene tells from none
    double faint_light = 0.0;  ///< cd/m²; next to nothing beside the sky, beside what was shown
                               ///< before the last change, or to the eye

    /// Next to no light arrives: so many cd/m² it is at most, as a root mean square. An error
    /// relative to light that may as well be none says nothing.
    [[nodiscard]] std::optional<double> darker_than() const;
    /// The interval ends below a target. Or it never will, and the noise is but half of what the
    /// pixels cannot resolve anyway: more samples bring next to nothing.
    [[nodiscard]] bool meets(double target) const {
        return error_high <= target ||
               (!reachable(discretisation, target) && noise <= 0.5 * discretisation);
    }
};

}  // namespace raybundle
