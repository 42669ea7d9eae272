// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "view/viewer_image.h"

namespace raybundle {

/// How far a point that a probe has found may be from its surface, m: as near as rays tell surfaces
/// apart, a ten-thousandth of the scene's diameter, and what single precision leaves of coordinates
/// far out.
float probe_rounding(const GpuScene& gpu_scene, const glm::vec3& point);

/// What a probe says of a point of a patch that no picture shows: the same as a picture of one
/// pixel that looks at the point from right in front of it. point: world, m. Nothing where another
/// surface is there, or the point is not on the patch. Small, synchronous. Throws GpuError.
std::optional<PixelProbe> probe_point(const GpuScene& gpu_scene, const RadianceStore& store,
                                      const ViewPrograms& programs, const Scene& scene,
                                      const PatchMesh& mesh, std::uint32_t patch,
                                      const glm::vec3& point);

/// The same of the first surface that a ray meets, seen from the ray's origin: a picture of one
/// pixel. What is nearer than a ten-thousandth of the scene's diameter is not met. origin: world,
/// m; direction: any length but 0. Nothing where the ray meets no patch. Throws GpuError.
std::optional<PixelProbe> probe_ray(const GpuScene& gpu_scene, const RadianceStore& store,
                                    const ViewPrograms& programs, const glm::vec3& origin,
                                    const glm::vec3& direction);

}  // namespace raybundle
