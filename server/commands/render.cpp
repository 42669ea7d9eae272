// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>
#include <variant>

#include "app/render_job.h"
#include "app/solve_job.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "options/method_options.h"
#include "scene/effects/effects_plan.h"
#include "transport/solver.h"
#include "view/final_picture.h"
#include "view/image/image_file.h"
#include "view/image/whole_file.h"

namespace raybundle {

namespace {

void write_picture(FinalPicture& picture, const std::string& path) {
    const auto width = static_cast<int>(picture.size().x);
    const auto height = static_cast<int>(picture.size().y);
    if (is_exr(path)) {
        write_exr(path, width, height, picture.read_radiance());
    } else {
        write_png(path, width, height, picture.read_display());
    }
}

EffectsPlan effects_plan(const Options& options, const LoadedScene& loaded) {
    return plan_effects(loaded.scene, loaded.mesh.patch_count(), options.stop.error.value_or(0.0));
}

/// What path tracing of some pixels measured of the error; null where it did not.
nlohmann::ordered_json measured_json(const FinalPicture& picture) {
    const std::optional<FinalPicture::Checked>& checked = picture.checked();
    if (!checked) {
        return nullptr;
    }
    return {{"squared", checked->square.value},
            {"standardError", checked->square.standard_error},
            {"pixels", checked->pixels},
            {"paths", checked->paths}};
}

void write_statistics(const Options& options, const EglContext& context, const Solver& solver,
                      const LoadedScene& loaded, const FinalPicture& picture,
                      const SolveOutcome& outcome) {
    const nlohmann::json plan = effects_plan_json(effects_plan(options, loaded));
    const StrategyProbabilities& p = solver.probabilities();
    const nlohmann::ordered_json json = {
        {"scene", loaded.scene.name},
        {"device", context.renderer()},
        {"method", options.render.method},
        {"seed", options.scene.seed},
        {"size", {picture.size().x, picture.size().y}},
        {"pixelGrid", picture.pixel_grid()},
        {"seconds", outcome.seconds},
        {"loadSeconds", loaded.seconds},
        {"iterations", solver.iterations()},
        {"patches", loaded.mesh.patch_count()},
        {"bytes", solver.bytes() + picture.bytes()},
        {"bytesPerPatch", static_cast<double>(solver.store().bytes()) /
                              static_cast<double>(loaded.mesh.patch_count())},
        {"bundleResolution", {solver.resolution().hemicube, solver.resolution().window}},
        {"relativeError", outcome.statistics.relative_error},
        {"errorLow", outcome.statistics.error_low},
        {"errorHigh", outcome.statistics.error_high},
        {"errorMeasured", measured_json(picture)},
        {"errorNoise", outcome.statistics.noise},
        {"errorDiscretisation", outcome.statistics.discretisation},
        {"biased", options.render.bias_for_noise > 0},
        {"constantRadiance", solver.scene().constant_radiance()},
        {"perspectiveBundles", solver.shots().all},
        {"fromEmitters", solver.shots().from_emitters},
        {"probabilities", {p.layered, p.plane, p.perspective, p.opening}},
        {"nonFinite", solver.non_finite()},
        {"effects", nlohmann::ordered_json(plan["effects"])},
        {"notices", loaded.scene.notices}};
    write_file(options.render.stats, json.dump(2) + "\n");
}

/// Throws UsageError where something else is asked for that needs pixels.
int render_patches(const RenderMethod& method, glm::uvec2 size, const Options& options) {
    const auto* probabilities = std::get_if<StrategyProbabilities>(&method);
    if (probabilities == nullptr || options.stop.error || !options.render.stats.empty()) {
        throw UsageError(
            "--patches: takes --seconds or --iterations, and no --error, --stats or --method of "
            "the CPU: nothing is gathered at pixels");
    }
    return run_render_patches(*probabilities, size, options);
}

}  // namespace

int run_render(const Options& options) {
    require_picture_format(options.output.file);
    require_writable(options.output.file);
    if (!options.render.stats.empty()) {
        require_writable(options.render.stats);
    }
    check_camera(options);
    const glm::uvec2 size = parse_size(options.render.size);
    const RenderMethod method = parse_method(options.render.method);
    check_method_options(options.render, method);
    const auto shares = parse_shares("--shares", options.render.shares);
    const auto first_shares = parse_shares("--first-shares", options.render.first_shares);
    const bool variant = options.render.bias_for_noise > 0 || options.render.constant_radiance ||
                         options.render.random_faces;
    if (variant &&
        (!options.render.script.empty() || std::holds_alternative<ReferenceKind>(method))) {
        throw UsageError(
            "--bias-for-noise, --constant-radiance and --random-faces: only for single pictures by "
            "ray bundles");
    }
    if (!options.render.script.empty()) {
        if (options.render.patches || !std::holds_alternative<StrategyProbabilities>(method)) {
            throw UsageError(
                "--script: " +
                (options.render.patches ? "--patches" : "--method " + options.render.method) +
                " renders single pictures only");
        }
        return run_render_script(std::get<StrategyProbabilities>(method), size, options);
    }
    if (options.render.patches) {
        return render_patches(method, size, options);
    }
    if (const auto* kind = std::get_if<ReferenceKind>(&method)) {
        return run_render_reference(*kind, size, options);
    }
    SolverSettings settings;
    settings.seed = options.scene.seed;
    settings.probabilities = std::get<StrategyProbabilities>(method);
    if (shares) {
        settings.probabilities = *shares;
        settings.adapt_probabilities = false;
        settings.first_probabilities = first_shares;
    }
    settings.planes_per_direction = options.render.planes_per_direction;
    settings.noise_horizon = options.render.bias_for_noise;
    settings.constant_radiance = options.render.constant_radiance;
    settings.random_faces = options.render.random_faces;
    const EglContext context = create_egl_context({options.device.gpu, false});
    const LoadedScene loaded = load_scene(options);
    const Camera camera = choose_camera(loaded.scene, options);
    if (const std::string missed = light_missed(loaded.scene, settings.probabilities);
        !missed.empty()) {
        spdlog::warn("--method {}: {}", options.render.method, missed);
    }
    settings.caustics = is_active(effects_plan(options, loaded), "caustics");
    Solver solver(loaded.scene, loaded.mesh, settings);
    if (options.render.constant_radiance && !solver.scene().constant_radiance()) {
        spdlog::warn("--constant-radiance: left out, since {} has glossy surfaces",
                     options.scene.file);
    }
    const ViewPrograms programs(solver.scene());
    FinalPicture picture(solver.scene(), solver.store(), programs, camera, size);
    picture.check_by(spot_check(loaded.scene, loaded.mesh, camera, size, options.scene.seed));
    const SolveOutcome outcome = solve_picture(solver, picture, options);
    write_picture(picture, options.output.file);
    if (!options.render.stats.empty()) {
        write_statistics(options, context, solver, loaded, picture, outcome);
    }
    const ImageStatistics& found = outcome.statistics;
    const std::string error = found.known
                                  ? fmt::format("estimated error {:.2f} % ({:.2f} to {:.2f} %)",
                                                100.0 * found.relative_error,
                                                100.0 * found.error_low, 100.0 * found.error_high)
                                  : "error not known";
    spdlog::info("{}: {} iterations in {:.2f} s, {}", options.output.file, solver.iterations(),
                 outcome.seconds, error);
    return exit_done;
}

}  // namespace raybundle
