// SPDX-License-Identifier: Apache-2.0
#include "scheduling/phase_budget.h"

#include <algorithm>

namespace raybundle {

void PhaseBudget::begin(double now_ms) {
    since_ms_ = now_ms;
    bundles_ = 0;
}

void PhaseBudget::note_bundle(double now_ms, bool last) {
    ++bundles_;
    if (last) {
        const double each = std::max(now_ms - since_ms_, 0.0) / bundles_;
        const double before = bundle_ms_.value_or(each);
        bundle_ms_ = before + settings_.phase_smoothing * (each - before);
    }
}

std::optional<double> PhaseBudget::bundles_in_time() const {
    return bundle_ms_ && *bundle_ms_ > 0.0
               ? std::optional(settings_.phase_deadline_ms / *bundle_ms_)
               : std::nullopt;
}

}  // namespace raybundle
