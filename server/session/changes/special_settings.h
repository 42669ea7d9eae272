// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scheduling/phase_budget.h"
#include "transport/scene_change.h"

namespace raybundle {

/// More bundles have no numbers of their own in the sequences of a special phase.
inline constexpr unsigned max_special_bundles = 64;

/// How many bundles a special phase (ch. 7.4) gets while somebody waits for the first frame after a
/// change. It gets the usual number at least: half as many leave streaks for seconds where light
/// was taken away. It gets more where the budget has time for them; the phase itself uses them
/// where it finds much to correct.
///
/// target: smallest relative error that a viewer asks for; 0: none does. hurried: the next change
/// waits already, as in a drag, and corrects what this one leaves.
SpecialSettings special_settings(const PhaseBudget& budget, double target, bool hurried);

}  // namespace raybundle
