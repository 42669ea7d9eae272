// SPDX-License-Identifier: Apache-2.0
// What all ways to render a picture to a file have in common.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/progress.h"
#include "options/cli_options.h"
#include "scene/scene.h"
#include "view/final_picture.h"

namespace raybundle {

/// Throws UsageError where --eye, --target or --fov make no camera; before a scene is read.
void check_camera(const Options& options);
/// The camera that --camera, or --eye and --target, ask for. Throws UsageError.
Camera choose_camera(const Scene& scene, const Options& options);

/// Throws UsageError unless the path ends in .exr or .png.
void require_picture_format(const std::string& path);
bool is_exr(const std::string& path);

/// Paths that a picture's error is measured by, independent of whatever else has this seed.
std::unique_ptr<SpotCheck> spot_check(const Scene& scene, const PatchMesh& mesh,
                                      const Camera& camera, glm::uvec2 size, std::uint64_t seed);

/// A line of progress: what is done, how accurate it is, and the time that is left, s.
void show_progress(Progress& bar, double elapsed, double left, std::uint64_t iterations,
                   double relative_error);

/// When to stop: whichever of the given limits comes first; 10 s where none is given.
class StopRule {
  public:
    explicit StopRule(const Options& options);

    /// How far the job is: done at 1. estimate: upper end of the estimated relative error.
    [[nodiscard]] double progress(double elapsed, std::uint64_t done, double estimate) const;
    /// Time until then, s. samples_factor: of the samples that bring the error to its target;
    /// infinite where none do.
    [[nodiscard]] double seconds_left(double elapsed, std::uint64_t done,
                                      double samples_factor) const;
    /// What progress() is told of a picture's error: 0 where no sample would bring it closer.
    [[nodiscard]] double estimate_of(const ImageStatistics& statistics) const;
    [[nodiscard]] double estimate_of(const FinalPicture& picture) const;
    [[nodiscard]] bool needs_error() const { return error_.has_value(); }

  private:
    std::optional<double> seconds_;
    std::optional<std::uint64_t> iterations_;
    std::optional<double> error_;
};

}  // namespace raybundle
