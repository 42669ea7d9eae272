// SPDX-License-Identifier: Apache-2.0
#include "session/phase_budget.h"

#include <algorithm>

namespace raybundle {

namespace {
constexpr double newest = 0.3;  // share of the newest phase in the mean
/// Bundles beside which it pays to carry a change on: their noise would outweigh what few bring.
constexpr unsigned first_stage_of_two = 24;
}  // namespace

void PhaseBudget::begin(double now_ms) {
    since_ms_ = now_ms;
    bundles_ = 0;
}

void PhaseBudget::note_bundle(double now_ms, bool last) {
    ++bundles_;
    if (!last) {
        return;
    }
    const double each = std::max(now_ms - since_ms_, 0.0) / bundles_;
    bundle_ms_ = bundle_ms_ > 0.0 ? bundle_ms_ + newest * (each - bundle_ms_) : each;
}

SpecialSettings PhaseBudget::settings(double target, bool hurried) const {
    SpecialSettings settings = interactive_special();
    const unsigned carrying = SpecialSettings{}.bounces;
    const double fit = bundle_ms_ > 0.0 ? deadline_ms / bundle_ms_ : settings.bundles;
    auto affordable = static_cast<unsigned>(std::clamp(fit, 0.0, double{max_bundles + carrying}));
    if (!hurried && affordable >= first_stage_of_two + carrying) {
        settings.bounces = carrying;
        affordable -= carrying;
    }
    settings.most_bundles =
        hurried ? settings.bundles : std::clamp(affordable, settings.bundles, max_bundles);
    if (target > 0.0) {
        settings.relevant_noise =
            std::clamp(0.5F * static_cast<float>(target), 0.0025F, settings.relevant_noise);
    }
    return settings;
}

}  // namespace raybundle
