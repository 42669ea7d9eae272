// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reference/measures/image_estimate.h"
#include "reference/path_reuse.h"
#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"

namespace raybundle {

/// What a reference's own noise adds to a comparison.
struct ReferenceNoise {
    double relative_rmse = 0.0;
    double mrse = 0.0;
};

/// A finished picture to measure others against.
struct ReferencePicture {
    PixelFilter filter = PixelFilter::centre;
    std::string method;                ///< as `--method` names it; empty where that is not known
    std::vector<glm::dvec3> radiance;  ///< cd/m², row 0 at the top
    /// Nothing where it is not known, as of a file from elsewhere.
    std::optional<ReferenceNoise> noise;
    std::uint64_t samples = 0;  ///< of each pixel
    std::uint64_t seed = 0;     ///< of the newest samples
    double seconds = 0.0;       ///< spent on it, earlier runs included
};

/// Name of a filter in files: "centre" or "area".
std::string filter_name(PixelFilter filter);

/// A reference in the making: path tracing that shares paths, on top of an earlier one where there
/// is one. Scene and lights must outlive it.
class ReferenceMaker {
  public:
    /// earlier: of the same scene, camera, size and filter, its noise known.
    ReferenceMaker(const RayScene& scene, const LightSampling& lights, const CameraRays& camera,
                   const std::vector<bool>& measured, PixelFilter filter, std::uint64_t seed,
                   std::optional<ReferencePicture> earlier);

    /// One more sample of every pixel.
    void add_pass();
    /// The picture so far. Its noise is known from 8 passes on, or from the earlier one's.
    [[nodiscard]] ReferencePicture result() const;
    /// Of each pixel of result().
    [[nodiscard]] std::uint64_t samples() const;
    /// relRMSE of the noise of result(); infinite while unknown.
    [[nodiscard]] double noise() const;

  private:
    [[nodiscard]] ReferenceNoise own_noise() const;
    /// Weight of the earlier picture, by the variances.
    [[nodiscard]] double earlier_weight(const ReferenceNoise& own) const;

    PathReuse paths_;
    CameraRays camera_;
    std::vector<bool> measured_;
    std::uint64_t seed_;
    std::optional<ReferencePicture> earlier_;
    ImageEstimate image_;
    PixelFilter filter_;
    double seconds_ = 0.0;
};

}  // namespace raybundle
