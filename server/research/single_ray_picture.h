// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/measures/image_estimate.h"
#include "reference/solution_picture.h"
#include "research/single_ray.h"

namespace raybundle {

/// The picture of a single-ray solution and its error. Emission and main part come from the
/// solution as it is. What glossy surfaces reflect besides is a mean over the random
/// representations that the solution has had (the image estimate M L(m) of ch. 2.6): every
/// iterations_per_look iterations each pixel takes one look at the incoming samples of each batch.
class SingleRayPicture {
  public:
    static constexpr std::uint64_t iterations_per_look = 64;

    /// seed: of the looks' places within the pixels.
    SingleRayPicture(const RayScene& scene, const CameraRays& camera, std::uint64_t seed);

    /// To be called after each iteration: looks when it is time, and restarts the solution's
    /// incoming samples.
    void follow(SingleRay& solution);

    /// Radiance, cd/m², row 0 at the top; irradiance interpolated over the vertices. Where glossy
    /// surfaces are noisy it may be negative.
    [[nodiscard]] std::vector<glm::dvec3> picture(const SingleRay& solution) const;
    /// Statistical error at the centres of the pixels of a mask, by the scatter of the batches;
    /// what the interpolation blurs is not in it.
    [[nodiscard]] ImageError error(const SingleRay& solution,
                                   const std::vector<bool>& measured) const;
    [[nodiscard]] std::size_t bytes() const { return looks_.size() * sizeof(glm::vec3); }

  private:
    void look(const SingleRay& solution, std::vector<glm::vec3>& sums) const;
    [[nodiscard]] glm::dvec3 beyond_main_part(const SingleRay& solution, std::uint32_t batch,
                                              const glm::dvec3& direction) const;
    [[nodiscard]] std::vector<glm::vec3> looks_so_far(const SingleRay& solution) const;
    [[nodiscard]] glm::dvec3 centre_main_part(const SingleRay& solution, std::size_t pixel,
                                              const InterpolatedIrradiance& irradiance) const;

    const RayScene& scene_;
    CameraRays camera_;
    std::uint64_t seed_;
    std::vector<std::optional<SurfacePoint>> centres_;
    std::vector<glm::vec3> looks_;  // cd/m² times particles of a batch; [pixel * batches + batch]
    std::uint32_t look_count_ = 0;
};

}  // namespace raybundle
