// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "commands/command.h"
#include "gpu/egl_context.h"
#include "transport/solver.h"
#include "view/image_file.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

using Clock = std::chrono::steady_clock;

Camera choose_camera(const Scene& scene, const Options& options) {
    if (!options.eye.empty() || !options.target.empty()) {
        if (options.eye.empty() || options.target.empty()) {
            throw UsageError("--eye and --target belong together");
        }
        Camera camera;
        camera.eye = parse_vector("--eye", options.eye);
        camera.target = parse_vector("--target", options.target);
        camera.vertical_fov = glm::radians(options.fov);
        if (camera.eye == camera.target) {
            throw UsageError("--target: is the eye itself");
        }
        return camera;
    }
    if (options.camera.empty()) {
        return scene.cameras.front();
    }
    std::string names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == options.camera) {
            return camera;
        }
        names += (names.empty() ? "" : ", ") + camera.name;
    }
    std::size_t index = scene.cameras.size();
    std::from_chars(options.camera.data(), options.camera.data() + options.camera.size(), index);
    if (index >= scene.cameras.size()) {
        throw UsageError("--camera: no camera '" + options.camera + "'; there are: " + names);
    }
    return scene.cameras[index];
}

/// When to stop: whichever of the given limits comes first; 10 s where none is given.
struct StopRule {
    std::optional<double> seconds;
    std::optional<std::uint64_t> iterations;
    std::optional<double> error;

    [[nodiscard]] double progress(double elapsed, std::uint64_t done, double estimate) const {
        double result = 0.0;
        if (seconds) {
            result = std::max(result, elapsed / *seconds);
        }
        if (iterations) {
            result = std::max(result, static_cast<double>(done) / static_cast<double>(*iterations));
        }
        if (error && estimate > 0.0) {
            result = std::max(result, std::min(1.0, *error / estimate));
        }
        return result;
    }
};

class ProgressBar {
  public:
    ProgressBar() : shown_(isatty(STDERR_FILENO) != 0) {}
    ~ProgressBar() {
        if (shown_) {
            fmt::print(stderr, "\r\033[K");
        }
    }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(double progress, std::uint64_t iterations, double error) {
        const auto now = Clock::now();
        if (!shown_ || now - last_ < std::chrono::milliseconds(200)) {
            return;
        }
        last_ = now;
        fmt::print(stderr, "\r\033[K{:3.0f} %  {} iterations, estimated error {:.1f} %",
                   100.0 * std::min(progress, 1.0), iterations, 100.0 * error);
        std::fflush(stderr);
    }

  private:
    bool shown_;
    Clock::time_point last_;
};

struct Outcome {
    double seconds = 0.0;
    ImageStatistics statistics;
};

Outcome solve(Solver& solver, ViewerImage& image, const Options& options) {
    StopRule rule{options.seconds, options.iterations, options.error};
    if (!rule.seconds && !rule.iterations && !rule.error) {
        rule.seconds = 10.0;
    }
    BundleReceiver* const receivers[] = {&image};
    ProgressBar bar;
    Outcome outcome;
    const auto start = Clock::now();
    constexpr std::uint64_t statistics_interval = 16;
    while (true) {
        solver.step(receivers);
        outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (solver.iterations() % statistics_interval == 0) {
            image.request_statistics();
            glFinish();
            outcome.statistics = image.statistics();
        }
        const double progress =
            rule.progress(outcome.seconds, solver.iterations(), outcome.statistics.error_high);
        bar.show(progress, solver.iterations(), outcome.statistics.relative_error);
        if (progress >= 1.0) {
            break;
        }
    }
    image.request_statistics();
    glFinish();
    outcome.statistics = image.statistics();
    return outcome;
}

void write_picture(ViewerImage& image, const std::string& path) {
    const auto width = static_cast<int>(image.size().x);
    const auto height = static_cast<int>(image.size().y);
    if (std::filesystem::path(path).extension() == ".exr") {
        write_exr(path, width, height, image.read_radiance());
    } else {
        image.compose(DisplayMode::photo, image.automatic_exposure());
        write_png(path, width, height, image.take());
    }
}

void write_statistics(const Options& options, const EglContext& context, const Solver& solver,
                      const LoadedScene& loaded, const ViewerImage& image, const Outcome& outcome) {
    const nlohmann::ordered_json json = {
        {"scene", loaded.scene.name},
        {"device", context.renderer()},
        {"method", options.method},
        {"seed", options.seed},
        {"size", {image.size().x, image.size().y}},
        {"seconds", outcome.seconds},
        {"loadSeconds", loaded.seconds},
        {"iterations", solver.iterations()},
        {"patches", loaded.mesh.patch_count()},
        {"bytes", solver.bytes() + image.bytes()},
        {"bytesPerPatch", static_cast<double>(solver.store().bytes()) /
                              static_cast<double>(loaded.mesh.patch_count())},
        {"bundleResolution", {solver.resolution().hemicube, solver.resolution().window}},
        {"relativeError", outcome.statistics.relative_error},
        {"errorLow", outcome.statistics.error_low},
        {"errorHigh", outcome.statistics.error_high},
        {"nonFinite", solver.non_finite()},
        {"notices", loaded.scene.notices}};
    write_file(options.stats, json.dump(2) + "\n");
}

}  // namespace

int run_render(const Options& options) {
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (extension != ".exr" && extension != ".png") {
        throw UsageError("--output: '" + options.output + "' ends neither in .exr nor in .png");
    }
    const glm::uvec2 size = parse_size(options.size);
    SolverSettings settings;
    settings.seed = options.seed;
    settings.probabilities = parse_method(options.method);
    const EglContext context = create_egl_context({options.gpu, false});
    const LoadedScene loaded = load_scene(options);
    const Camera camera = choose_camera(loaded.scene, options);
    Solver solver(loaded.scene, loaded.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(camera);
    const Outcome outcome = solve(solver, image, options);
    write_picture(image, options.output);
    if (!options.stats.empty()) {
        write_statistics(options, context, solver, loaded, image, outcome);
    }
    spdlog::info("{}: {} iterations in {:.2f} s, estimated error {:.2f} % ({:.2f} to {:.2f} %)",
                 options.output, solver.iterations(), outcome.seconds,
                 100.0 * outcome.statistics.relative_error, 100.0 * outcome.statistics.error_low,
                 100.0 * outcome.statistics.error_high);
    return exit_done;
}

}  // namespace raybundle
