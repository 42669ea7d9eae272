// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include "app/render_job.h"
#include "app/solve_job.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "view/image/image_file.h"
#include "view/image/tone_curve.h"

namespace raybundle {

namespace {

/// PNG is exposed for the mean of all pixels that show any light.
void write_picture(const std::string& path, glm::uvec2 size,
                   const std::vector<glm::vec4>& radiance) {
    const auto width = static_cast<int>(size.x);
    const auto height = static_cast<int>(size.y);
    if (is_exr(path)) {
        write_exr(path, width, height, radiance);
        return;
    }
    const std::vector<glm::dvec3> colours(radiance.begin(), radiance.end());
    std::vector<bool> counted;
    counted.reserve(colours.size());
    for (const glm::dvec3& colour : colours) {
        counted.push_back(colour != glm::dvec3(0.0));
    }
    write_png(path, width, height,
              tone_mapped(colours, automatic_display_factor(colours, counted)));
}

}  // namespace

int run_render_patches(const StrategyProbabilities& probabilities, glm::uvec2 size,
                       const Options& options) {
    SolverSettings settings;
    settings.seed = options.scene.seed;
    settings.probabilities = probabilities;
    settings.noise_horizon = options.render.bias_for_noise;
    settings.constant_radiance = options.render.constant_radiance;
    settings.random_faces = options.render.random_faces;
    const EglContext context = create_egl_context({options.device.gpu, false});
    const LoadedScene loaded = load_scene(options);
    const Camera camera = choose_camera(loaded.scene, options);
    Solver solver(loaded.scene, loaded.mesh, settings);
    const double seconds = solve_patches(solver, options);
    const ViewPrograms programs(solver.scene(), PixelLight::patches);
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(camera);
    image.smooth();
    write_picture(options.output.file, size, image.read_radiance());
    spdlog::info("{}: light of {} patches after {} iterations in {:.2f} s", options.output.file,
                 loaded.mesh.patch_count(), solver.iterations(), seconds);
    return exit_done;
}

}  // namespace raybundle
