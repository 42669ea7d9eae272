// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// Whether a pixel of a picture, numbered row by row from the top, sees an emitting surface
/// anywhere in its area, as far as a grid of 8 x 8 rays finds it, or the sky at its centre. What
/// mirrors and glass show counts as if it were seen directly, by the stronger way at glass.
bool pixel_sees_emitter(const RayScene& scene, const CameraRays& camera, std::size_t pixel);

/// Whether a pixel counts for the error of a picture (design.md, section 8): neither it nor one of
/// its 8 neighbours sees an emitter or the sky.
bool pixel_is_measured(const RayScene& scene, const CameraRays& camera, glm::uvec2 at);

/// All pixels that do, row by row from the top.
std::vector<bool> measured_pixels(const RayScene& scene, const CameraRays& camera);

/// Pixels whose centre shows a surface that reflects and does not emit, row by row: those that
/// count for the exposure.
std::vector<bool> reflecting_pixels(const RayScene& scene, const CameraRays& camera);

}  // namespace raybundle
