// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <cmath>

#include "app/render_job.h"
#include "app/solve_job.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "scene/effects/effects_plan.h"
#include "walkthrough/walkthrough.h"

namespace raybundle {

namespace {

/// Of the picture whose error is estimated, and whose brightness scene.glb is exposed for: small,
/// since what is written are patches.
constexpr glm::uvec2 first_picture_size(160, 120);

struct Solved {
    double seconds = 0.0;
    std::optional<double> error = std::nullopt;
};

Solved with_picture(Solver& solver, const LoadedScene& loaded, const Options& options) {
    const Camera camera = choose_camera(loaded.scene, options);
    const ViewPrograms programs(solver.scene());
    FinalPicture picture(solver.scene(), solver.store(), programs, camera, first_picture_size);
    picture.check_by(
        spot_check(loaded.scene, loaded.mesh, camera, first_picture_size, options.scene.seed));
    const SolveOutcome outcome = solve_picture(solver, picture, options);
    Solved solved{.seconds = outcome.seconds};
    if (outcome.statistics.known) {
        solved.error = outcome.statistics.relative_error;
    }
    return solved;
}

/// Factor from cd/m² to display white by which a picture from the camera is exposed.
float display_factor(const Solver& solver, const Camera& camera) {
    const ViewPrograms programs(solver.scene(), PixelLight::patches);
    ViewerImage image(solver.scene(), solver.store(), programs, first_picture_size);
    image.set_camera(camera);
    image.request_statistics();
    image.finish_statistics();
    return ViewerImage::display_factor(image.automatic_exposure());
}

nlohmann::ordered_json solve_json(const Options& options, const Solver& solver,
                                  const LoadedScene& loaded, const Solved& solved) {
    nlohmann::ordered_json error = nullptr;
    if (solved.error) {
        error = *solved.error;
    }
    return {{"iterations", solver.iterations()},
            {"seconds", solved.seconds},
            {"seed", options.scene.seed},
            {"patches", loaded.mesh.patch_count()},
            {"relativeError", error},
            {"notices", loaded.scene.notices}};
}

double megabytes(std::size_t bytes) {
    return static_cast<double>(bytes) / 1e6;
}

void report(const std::string& folder, const WalkthroughSizes& sizes) {
    spdlog::info(
        "{}: {} triangles, {} vertices; {:.2f} MB of geometry, {:.2f} MB of light, {:.2f} MB of "
        "textures, {:.2f} MB of page; scene.glb {:.2f} MB",
        folder, sizes.triangles, sizes.vertices, megabytes(sizes.geometry), megabytes(sizes.light),
        megabytes(sizes.textures), megabytes(sizes.page), megabytes(sizes.gltf));
}

}  // namespace

int run_export(const Options& options) {
    check_new_folder(options.output.file, options.export_scene.force);
    check_camera(options);
    SolverSettings settings;
    settings.seed = options.scene.seed;
    const EglContext context = create_egl_context({options.device.gpu, false});
    const LoadedScene loaded = load_scene(options);
    if (loaded.scene.medium) {
        spdlog::warn(
            "{}: walkthroughs show surfaces without the air before them, which dims them and "
            "scatters light; `render` shows it",
            loaded.scene.name);
    }
    const Camera camera = choose_camera(loaded.scene, options);
    settings.caustics = is_active(
        plan_effects(loaded.scene, loaded.mesh.patch_count(), options.stop.error.value_or(0.0)),
        "caustics");
    Solver solver(loaded.scene, loaded.mesh, settings);
    Solved solved;
    if (options.stop.error) {
        solved = with_picture(solver, loaded, options);
    } else {
        solved.seconds = solve_patches(solver, options);
    }
    const std::vector<glm::vec4> irradiance = solver.store().read_irradiance();
    NewFolder folder(options.output.file, options.export_scene.force);
    const WalkthroughSizes sizes = write_walkthrough(
        {loaded.scene, loaded.mesh, irradiance, solve_json(options, solver, loaded, solved)},
        client_files(), shader_files(), display_factor(solver, camera), folder);
    folder.keep();
    report(options.output.file, sizes);
    return exit_done;
}

}  // namespace raybundle
