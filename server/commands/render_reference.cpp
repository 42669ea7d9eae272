// SPDX-License-Identifier: Apache-2.0
// `render` with a method on the CPU: no GL context.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/render_job.h"
#include "commands/command.h"
#include "reference/measures/emitter_pixels.h"
#include "reference/sampling/russian_roulette.h"
#include "research/reference_method.h"
#include "view/image/image_file.h"
#include "view/image/tone_curve.h"

namespace raybundle {
namespace {

struct ReferenceOutcome {
    double seconds = 0.0;
    ImageError error;
};

/// Iterations between two estimates of the error, which costs about as much as one.
constexpr std::uint64_t error_interval = 8;

ReferenceOutcome solve(ReferenceMethod& method, const Options& options) {
    const StopRule rule(options);
    Progress bar;
    bar.begin(options.output.file, {});
    ReferenceOutcome outcome;
    const Stopwatch stopwatch;
    double progress = 0.0;
    while (progress < 1.0) {
        method.iterate();
        outcome.seconds = stopwatch.seconds();
        const bool looks = method.iterations() % error_interval == 0;
        if (looks && (rule.needs_error() || bar.due())) {
            outcome.error = method.error();
        }
        progress = rule.progress(outcome.seconds, method.iterations(), outcome.error.high);
        if (looks && bar.due()) {
            // Paths are independent: the error falls like 1/sqrt(n).
            const double ratio = outcome.error.high / options.stop.error.value_or(1.0);
            const double left = rule.seconds_left(outcome.seconds, method.iterations(),
                                                  outcome.error.high > 0.0
                                                      ? std::max(ratio * ratio, 1.0)
                                                      : std::numeric_limits<double>::infinity());
            show_progress(bar, outcome.seconds, left, method.iterations(), outcome.error.relative);
        }
    }
    outcome.error = method.error();
    return outcome;
}

void write_picture(const std::string& path, const std::vector<glm::dvec3>& radiance,
                   glm::uvec2 size, const std::vector<bool>& reflecting) {
    const auto width = static_cast<int>(size.x);
    const auto height = static_cast<int>(size.y);
    if (is_exr(path)) {
        std::vector<glm::vec4> pixels;
        pixels.reserve(radiance.size());
        for (const glm::dvec3& value : radiance) {
            pixels.emplace_back(value, 1.0);
        }
        write_exr(path, width, height, pixels);
    } else {
        write_png(path, width, height,
                  tone_mapped(radiance, automatic_display_factor(radiance, reflecting)));
    }
}

void write_statistics(const Options& options, glm::uvec2 size, const LoadedScene& loaded,
                      const ReferenceMethod& method, const ReferenceOutcome& outcome) {
    const nlohmann::ordered_json json = {
        {"scene", loaded.scene.name},
        {"device", fmt::format("CPU, {} threads", std::thread::hardware_concurrency())},
        {"method", options.render.method},
        {"seed", options.scene.seed},
        {"size", {size.x, size.y}},
        {"seconds", outcome.seconds},
        {"loadSeconds", loaded.seconds},
        {"iterations", method.iterations()},
        {"patches", loaded.mesh.patch_count()},
        {"bytes", method.bytes()},
        {"relativeError", outcome.error.relative},
        {"errorLow", outcome.error.low},
        {"errorHigh", outcome.error.high},
        {"nonFinite", method.non_finite()},
        {"notices", loaded.scene.notices}};
    write_file(options.render.stats, json.dump(2) + "\n");
}

}  // namespace

namespace {

/// Of --roulette. A fixed survival probability of 1 would never end: 64 reflections in the mean at
/// most.
PathSettings path_settings(const Options& options, const RayScene& scene, const Camera& camera,
                           glm::uvec2 size) {
    constexpr int certain = 1;      // ch. 3.3.2: roulette decides on the second reflection
    constexpr int reflections = 7;  // of the walks of eq. 3.16, as in figure 3.3
    constexpr std::uint32_t looks = 16;
    constexpr double longest = 1.0 - 1.0 / 64.0;
    PathSettings settings;
    if (options.render.roulette == "albedo") {
        settings.survival = Survival::albedo;
        settings.certain_bounces = certain;
    } else if (options.render.roulette == "optimum") {
        const WalkStatistics walks =
            measure_walks(scene, CameraRays(scene, camera, size), looks, options.scene.seed);
        settings.survival = Survival::fixed;
        settings.survival_probability =
            std::clamp(optimal_survival(walks, reflections), 1.0 - longest, longest);
        settings.certain_bounces = certain;
        spdlog::info("--roulette optimum: mean albedo {:.3f}, E {:.4g}, D² {:.4g}: survival {:.3f}",
                     walks.albedo, walks.mean_square, walks.variance,
                     settings.survival_probability);
    }
    return settings;
}

}  // namespace

int run_render_reference(ReferenceKind kind, glm::uvec2 size, const Options& options) {
    const LoadedScene loaded = load_scene(options);
    const Camera camera = choose_camera(loaded.scene, options);
    const RayScene scene(loaded.scene, loaded.mesh);
    const auto method = make_reference_method(kind, scene, camera, size, options.scene.seed,
                                              path_settings(options, scene, camera, size));
    if (const std::string missed = light_missed(kind, scene, camera, size); !missed.empty()) {
        spdlog::warn("{}", missed);
    }
    const ReferenceOutcome outcome = solve(*method, options);
    write_picture(options.output.file, method->picture(), size,
                  reflecting_pixels(scene, CameraRays(scene, camera, size)));
    if (!options.render.stats.empty()) {
        write_statistics(options, size, loaded, *method, outcome);
    }
    spdlog::info("{}: {} iterations in {:.2f} s, estimated error {:.2f} % ({:.2f} to {:.2f} %)",
                 options.output.file, method->iterations(), outcome.seconds,
                 100.0 * outcome.error.relative, 100.0 * outcome.error.low,
                 100.0 * outcome.error.high);
    return exit_done;
}

}  // namespace raybundle
