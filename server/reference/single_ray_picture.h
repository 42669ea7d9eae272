// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/image_estimate.h"
#include "reference/single_ray.h"

namespace raybundle {

/// The picture of a single-ray solution and its error.
class SingleRayPicture {
  public:
    SingleRayPicture(const RayScene& scene, const CameraRays& camera);

    /// Radiance, cd/m², row 0 at the top; irradiance interpolated over the vertices.
    [[nodiscard]] std::vector<glm::dvec3> picture(const SingleRay& solution) const;
    /// Statistical error at the pixels' centres, by the scatter of the batches; what the
    /// interpolation blurs is not in it.
    [[nodiscard]] ImageError error(const SingleRay& solution) const;

  private:
    const RayScene& scene_;
    CameraRays camera_;
    std::vector<std::optional<SurfacePoint>> centres_;
};

}  // namespace raybundle
