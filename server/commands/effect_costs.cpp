// SPDX-License-Identifier: Apache-2.0
#include "commands/effect_costs.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "commands/render_job.h"
#include "gpu/egl_context.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {
namespace {

constexpr glm::uvec2 viewer_size(320, 240);
constexpr int first_iterations = 8;  // in which drivers finish compiling
constexpr int iterations = 24;

/// Milliseconds of an iteration with one small viewer.
double iteration_cost(const Scene& scene, const PatchMesh& mesh, std::uint64_t seed,
                      bool caustics = true) {
    SolverSettings settings;
    settings.seed = seed;
    settings.caustics = caustics;
    Solver solver(scene, mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, viewer_size);
    image.set_camera(scene.cameras.front());
    BundleReceiver* const receivers[] = {&image};
    const auto run = [&](int count) {
        for (int i = 0; i < count; ++i) {
            solver.step(receivers);
        }
        glFinish();
    };
    run(first_iterations);
    const Stopwatch watch;
    run(iterations);
    return 1e3 * watch.seconds() / iterations;
}

}  // namespace

void measure_effects(const Options& options, const LoadedScene& loaded, EffectsPlan& plan) {
    const EglContext context = create_egl_context({options.gpu, false});
    const double whole = iteration_cost(loaded.scene, loaded.mesh, options.seed);
    Scene bare = loaded.scene;
    PatchMesh bare_mesh = loaded.mesh;
    for (Effect& effect : plan.effects) {
        if (!effect.active) {
            continue;
        }
        Scene scene = loaded.scene;
        PatchMesh mesh = loaded.mesh;
        if (effect.name == "caustics") {
            effect.ms_per_iteration =
                std::max(whole - iteration_cost(scene, mesh, options.seed, false), 0.0);
        } else if (remove_effect(effect.name, scene, mesh)) {
            effect.ms_per_iteration =
                std::max(whole - iteration_cost(scene, mesh, options.seed), 0.0);
            remove_effect(effect.name, bare, bare_mesh);
        }
    }
    plan.effects.front().ms_per_iteration = iteration_cost(bare, bare_mesh, options.seed, false);
}

}  // namespace raybundle
