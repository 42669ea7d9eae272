// SPDX-License-Identifier: Apache-2.0
#include "app/effects/contact_sheet.h"

#include <algorithm>
#include <vector>

#include "app/effects/effect_trial.h"
#include "gpu/egl_context.h"
#include "scene/effects/effects_plan.h"
#include "view/image/image_file.h"
#include "view/image/tone_curve.h"

namespace raybundle {
namespace {

constexpr glm::uvec2 contact_size(320, 240);
constexpr TrialLength picture_trial = {
    .size = contact_size, .first_iterations = 16, .iterations = 368};

/// Two pictures beside each other.
std::vector<glm::dvec3> side_by_side(const std::vector<glm::dvec3>& left,
                                     const std::vector<glm::dvec3>& right) {
    std::vector<glm::dvec3> both;
    both.reserve(left.size() + right.size());
    for (std::size_t y = 0; y < contact_size.y; ++y) {
        for (const auto* half : {&left, &right}) {
            const auto row = half->begin() + static_cast<std::ptrdiff_t>(y * contact_size.x);
            both.insert(both.end(), row, row + contact_size.x);
        }
    }
    return both;
}

}  // namespace

EffectCost write_contact_sheet(const Options& options, const LoadedScene& loaded) {
    const EffectsPlan plan = plan_effects(loaded.scene, loaded.mesh.patch_count());
    const bool active =
        std::any_of(plan.effects.begin(), plan.effects.end(), [&](const Effect& effect) {
            return effect.active && effect.name == options.inspect.effect;
        });
    const EffectTrial all{loaded.scene, loaded.mesh};
    EffectTrial rest = all;
    if (!active || !rest.remove(options.inspect.effect)) {
        throw UsageError("--effect: the scene has no effect '" + options.inspect.effect +
                         "' that can be taken out");
    }
    const EglContext context = create_egl_context({options.device.gpu, false});
    const TrialOutcome with = run_trial(all, picture_trial, options.scene.seed);
    const TrialOutcome without = run_trial(rest, picture_trial, options.scene.seed);
    const double factor =
        automatic_display_factor(with.picture, std::vector<bool>(with.picture.size(), true));
    write_png(options.inspect.contact_sheet, 2 * static_cast<int>(contact_size.x),
              static_cast<int>(contact_size.y),
              tone_mapped(side_by_side(with.picture, without.picture), factor));
    return {with.ms, without.ms, with.bytes, without.bytes};
}

}  // namespace raybundle
