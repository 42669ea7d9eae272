// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// Irradiance of the patches interpolated over the vertices of each smoothing group (Gouraud): a
/// vertex has the area-weighted mean of its patches, as in the viewers' pictures of the solution.
class VertexIrradiance {
  public:
    /// patches: irradiance of each, lx.
    VertexIrradiance(const RayScene& scene, std::span<const glm::dvec3> patches);

    /// At a point that does not absorb, lx.
    [[nodiscard]] glm::dvec3 at(const SurfacePoint& point) const;

  private:
    const RayScene& scene_;
    std::vector<glm::dvec3> vertices_;  // [2 * vertex + side]
};

/// Picture of a solution, cd/m², row 0 at the top: the mean over each pixel's area, by 4 x 4 rays.
std::vector<glm::dvec3> picture_of(const RayScene& scene, const CameraRays& camera,
                                   const VertexIrradiance& irradiance);

/// What the centres of a picture's pixels show, row by row; nothing: the sky.
std::vector<std::optional<SurfacePoint>> pixel_centres(const RayScene& scene,
                                                       const CameraRays& camera);

}  // namespace raybundle
