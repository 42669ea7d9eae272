// SPDX-License-Identifier: Apache-2.0
#include "app/effects/effect_trial.h"

#include <epoxy/gl.h>

#include "app/render_job.h"
#include "scene/effects/effect_removal.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

bool EffectTrial::remove(std::string_view effect) {
    if (effect == "caustics") {  // not a part of the scene, but of what follows from it
        const bool removed = caustics;
        caustics = false;
        return removed;
    }
    return remove_effect(effect, scene, mesh);
}

TrialOutcome run_trial(const EffectTrial& trial, const TrialLength& length, std::uint64_t seed) {
    SolverSettings settings;
    settings.seed = seed;
    settings.caustics = trial.caustics;
    settings.coarse_iterations = static_cast<std::uint64_t>(length.first_iterations) +
                                 static_cast<std::uint64_t>(length.iterations);
    Solver solver(trial.scene, trial.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, length.size);
    image.set_camera(trial.scene.cameras.front());
    BundleReceiver* const receivers[] = {&image};
    const auto run = [&](int count) {
        for (int i = 0; i < count; ++i) {
            solver.step(receivers);
        }
        glFinish();
    };
    run(length.first_iterations);
    const Stopwatch watch;
    run(length.iterations);
    TrialOutcome outcome;
    outcome.ms = 1e3 * watch.seconds() / length.iterations;
    outcome.bytes = solver.bytes() + image.bytes();
    image.smooth();
    for (const glm::vec4& pixel : image.read_radiance()) {
        outcome.picture.emplace_back(pixel);
    }
    return outcome;
}

}  // namespace raybundle
