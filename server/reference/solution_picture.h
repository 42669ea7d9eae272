// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "reference/albedo_tables.h"
#include "reference/camera_rays.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// Irradiance of the patches interpolated over the vertices of each smoothing group (Gouraud): a
/// vertex has the area-weighted mean of its patches, as in the viewers' pictures of the solution.
class InterpolatedIrradiance {
  public:
    /// patches: irradiance of each, lx.
    InterpolatedIrradiance(const RayScene& scene, std::span<const glm::dvec3> patches);

    /// At a point that does not absorb, lx.
    [[nodiscard]] glm::dvec3 at(const SurfacePoint& point) const;

  private:
    const RayScene& scene_;
    std::vector<glm::dvec3> vertices_;  // [2 * vertex + side]
};

/// Main part of the radiance that a point reflects: a(cos_out) E / pi. It is all of it on Lambert
/// surfaces, and on others where light comes from everywhere alike.
///
/// Ch. 7.2 averages the reflected radiance over the outgoing directions instead, which takes the
/// albedo at the incoming angle. With the outgoing one the irradiance is all that has to be kept,
/// the picture knows the texture's colour, and the rest (f_r - a/pi, random) is smaller: it is 0
/// in the mean under uniform light. Main part and rest add up to f_r in either form.
glm::dvec3 main_part(const AlbedoTables& tables, std::uint32_t material,
                     const Scattering& scattering, const glm::dvec3& irradiance);

/// Picture of a solution's emission and main part, cd/m², row 0 at the top: the mean over each
/// pixel's area, by 4 x 4 rays.
std::vector<glm::dvec3> picture_of(const RayScene& scene, const AlbedoTables& tables,
                                   const CameraRays& camera,
                                   const InterpolatedIrradiance& irradiance);

/// What the centres of a picture's pixels show, row by row; nothing: the sky.
std::vector<std::optional<SurfacePoint>> pixel_centres(const RayScene& scene,
                                                       const CameraRays& camera);

}  // namespace raybundle
