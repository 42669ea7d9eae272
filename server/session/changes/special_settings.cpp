// SPDX-License-Identifier: Apache-2.0
#include "session/changes/special_settings.h"

#include <algorithm>

namespace raybundle {

namespace {

/// Bundles beside which carrying a change on to other surfaces pays: the noise of few would
/// outweigh what they bring.
constexpr unsigned first_stage_of_two = 24;

}  // namespace

SpecialSettings special_settings(const PhaseBudget& budget, double target, bool hurried) {
    SpecialSettings settings = interactive_special();
    const unsigned carrying = SpecialSettings{}.bounces;
    const double fit = budget.bundles_in_time().value_or(settings.bundles);
    auto affordable =
        static_cast<unsigned>(std::clamp(fit, 0.0, double{max_special_bundles + carrying}));
    if (!hurried && affordable >= first_stage_of_two + carrying) {
        settings.bounces = carrying;
        affordable -= carrying;
    }
    settings.most_bundles =
        hurried ? settings.bundles : std::clamp(affordable, settings.bundles, max_special_bundles);
    if (target > 0.0) {
        settings.relevant_noise =
            std::clamp(0.5F * static_cast<float>(target), 0.0025F, settings.relevant_noise);
    }
    return settings;
}

}  // namespace raybundle
