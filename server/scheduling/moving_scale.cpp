// SPDX-License-Identifier: Apache-2.0
#include "scheduling/moving_scale.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

void MovingScale::note(double full_ms, double budget_ms) {
    const double wanted = full_ms > 0.0 ? std::sqrt(budget_ms / full_ms) : 1.0;
    // Half a step too much is tolerated and a whole one too little: noise does not change the size.
    const bool keeps =
        wanted >= scale_ - 0.5 * settings_.step && wanted < std::min(scale_ + settings_.step, 1.0);
    if (!keeps) {
        scale_ =
            std::clamp(std::floor(wanted / settings_.step) * settings_.step, settings_.min, 1.0);
    }
}

}  // namespace raybundle
