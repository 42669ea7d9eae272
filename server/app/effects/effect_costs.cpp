// SPDX-License-Identifier: Apache-2.0
#include "app/effects/effect_costs.h"

#include <algorithm>

#include "app/effects/effect_trial.h"
#include "gpu/egl_context.h"

namespace raybundle {
namespace {

constexpr TrialLength cost_trial = {.size = {320, 240}, .first_iterations = 8, .iterations = 24};

}  // namespace

void measure_effects(const Options& options, const Scene& scene, const PatchMesh& mesh,
                     EffectsPlan& plan, const std::stop_token& stop) {
    const EglContext context = create_egl_context({options.device.gpu, false});
    const auto cost = [&](const EffectTrial& trial) {
        return run_trial(trial, cost_trial, options.scene.seed).ms;
    };
    EffectTrial all{scene, mesh};
    all.caustics = is_active(plan, "caustics");
    EffectTrial bare = all;
    const double whole = cost(all);
    for (Effect& effect : plan.effects) {
        if (stop.stop_requested()) {
            return;
        }
        EffectTrial without = all;
        if (effect.active && without.remove(effect.name)) {
            effect.ms_per_iteration = std::max(whole - cost(without), 0.0);
            bare.remove(effect.name);
        }
    }
    plan.effects.front().ms_per_iteration = cost(bare);
}

}  // namespace raybundle
