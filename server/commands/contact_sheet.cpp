// SPDX-License-Identifier: Apache-2.0
#include "commands/contact_sheet.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <vector>

#include "commands/render_job.h"
#include "gpu/egl_context.h"
#include "scene/effects_plan.h"
#include "transport/solver.h"
#include "view/image_file.h"
#include "view/tone_curve.h"
#include "view/viewer_image.h"

namespace raybundle {
namespace {

constexpr glm::uvec2 contact_size(320, 240);
constexpr int iterations = 384;
constexpr int first_iterations = 16;  // in which drivers finish compiling: not timed

struct Half {
    std::vector<glm::dvec3> picture;  // cd/m²
    double ms = 0.0;                  // per iteration
    std::size_t bytes = 0;
};

Half render_half(const Scene& scene, const PatchMesh& mesh, std::uint64_t seed, bool caustics) {
    SolverSettings settings;
    settings.seed = seed;
    settings.caustics = caustics;
    settings.coarse_iterations = iterations;
    Solver solver(scene, mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, contact_size);
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
    run(iterations - first_iterations);
    Half half;
    half.ms = 1e3 * watch.seconds() / (iterations - first_iterations);
    half.bytes = solver.bytes() + image.bytes();
    image.smooth();
    for (const glm::vec4& pixel : image.read_radiance()) {
        half.picture.emplace_back(pixel);
    }
    return half;
}

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
    const bool active = std::any_of(
        plan.effects.begin(), plan.effects.end(),
        [&](const Effect& effect) { return effect.active && effect.name == options.effect; });
    Scene scene = loaded.scene;
    PatchMesh mesh = loaded.mesh;
    const bool caustics = options.effect == "caustics";
    if (!active || (!caustics && !remove_effect(options.effect, scene, mesh))) {
        throw UsageError("--effect: the scene has no effect '" + options.effect +
                         "' that can be taken out");
    }
    const EglContext context = create_egl_context({options.gpu, false});
    const Half with = render_half(loaded.scene, loaded.mesh, options.seed, true);
    const Half without = render_half(scene, mesh, options.seed, !caustics);
    const double factor =
        automatic_display_factor(with.picture, std::vector<bool>(with.picture.size(), true));
    write_png(options.contact_sheet, 2 * static_cast<int>(contact_size.x),
              static_cast<int>(contact_size.y),
              tone_mapped(side_by_side(with.picture, without.picture), factor));
    return {with.ms, without.ms, with.bytes, without.bytes};
}

}  // namespace raybundle
