// SPDX-License-Identifier: Apache-2.0
#include "app/render_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>

namespace raybundle {

namespace {

/// The camera of --eye and --target; nothing where they are not given.
std::optional<Camera> free_camera(const Options& options) {
    if (options.camera.eye.empty() && options.camera.target.empty()) {
        return std::nullopt;
    }
    if (options.camera.eye.empty() || options.camera.target.empty()) {
        throw UsageError("--eye and --target belong together");
    }
    Camera camera;
    camera.eye = parse_vector("--eye", options.camera.eye);
    camera.target = parse_vector("--target", options.camera.target);
    camera.vertical_fov = glm::radians(options.camera.fov);
    if (camera.eye == camera.target) {
        throw UsageError("--target: is the eye itself");
    }
    return camera;
}

}  // namespace

void check_camera(const Options& options) {
    free_camera(options);
}

Camera choose_camera(const Scene& scene, const Options& options) {
    if (const std::optional<Camera> camera = free_camera(options)) {
        return *camera;
    }
    if (options.camera.name.empty()) {
        return scene.cameras.front();
    }
    std::string names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == options.camera.name) {
            return camera;
        }
        names += (names.empty() ? "" : ", ") + camera.name;
    }
    std::size_t index = scene.cameras.size();
    std::from_chars(options.camera.name.data(),
                    options.camera.name.data() + options.camera.name.size(), index);
    if (index >= scene.cameras.size()) {
        throw UsageError("--camera: no camera '" + options.camera.name + "'; there are: " + names);
    }
    return scene.cameras[index];
}

bool is_exr(const std::string& path) {
    return std::filesystem::path(path).extension() == ".exr";
}

void require_picture_format(const std::string& path) {
    if (!is_exr(path) && std::filesystem::path(path).extension() != ".png") {
        throw UsageError("--output: '" + path + "' ends neither in .exr nor in .png");
    }
}

std::unique_ptr<SpotCheck> spot_check(const Scene& scene, const PatchMesh& mesh,
                                      const Camera& camera, glm::uvec2 size, std::uint64_t seed) {
    constexpr std::uint64_t own_stream = 0x73706f7463686563ULL;
    return std::make_unique<SpotCheck>(std::make_shared<const TracedScene>(scene, mesh), camera,
                                       size, mixed_bits(seed ^ own_stream));
}

void show_progress(Progress& bar, double elapsed, double left, std::uint64_t iterations,
                   double relative_error) {
    bar.show(
        elapsed / (elapsed + left), left,
        fmt::format("{} iterations, estimated error {:.1f} %", iterations, 100.0 * relative_error));
}

StopRule::StopRule(const Options& options)
    : seconds_(options.stop.seconds),
      iterations_(options.stop.iterations),
      error_(options.stop.error) {
    if (!seconds_ && !iterations_ && !error_) {
        seconds_ = 10.0;
    }
}

double StopRule::progress(double elapsed, std::uint64_t done, double estimate) const {
    double result = 0.0;
    if (seconds_) {
        result = std::max(result, elapsed / *seconds_);
    }
    if (iterations_) {
        result = std::max(result, static_cast<double>(done) / static_cast<double>(*iterations_));
    }
    if (error_) {
        result = std::max(result, estimate > *error_ ? *error_ / estimate : 1.0);
    }
    return result;
}

double StopRule::seconds_left(double elapsed, std::uint64_t done, double samples_factor) const {
    double left = std::numeric_limits<double>::infinity();
    if (seconds_) {
        left = std::min(left, *seconds_ - elapsed);
    }
    if (iterations_ && done > 0) {
        left = std::min(
            left, elapsed * (static_cast<double>(*iterations_) / static_cast<double>(done) - 1.0));
    }
    if (error_) {
        left = std::min(left, elapsed * (samples_factor - 1.0));
    }
    return std::max(left, 0.0);
}

double StopRule::estimate_of(const ImageStatistics& statistics) const {
    return error_ && statistics.meets(*error_) ? 0.0 : statistics.error_high;
}

double StopRule::estimate_of(const FinalPicture& picture) const {
    return error_ && picture.meets(*error_) ? 0.0 : picture.statistics().error_high;
}

}  // namespace raybundle
