// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "reference/camera_rays.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// Whether a pixel of a picture, numbered row by row from the top, sees an emitting surface
/// anywhere in its area, as far as a grid of 8 x 8 rays finds it.
bool pixel_sees_emitter(const RayScene& scene, const CameraRays& camera, std::size_t pixel);

/// Which pixels of a picture see an emitting surface anywhere in their area, as far as a grid of
/// 8 x 8 rays a pixel finds it; row by row from the top. For without_emitters().
std::vector<bool> pixels_that_see_emitters(const RayScene& scene, const CameraRays& camera);

/// Mask of the pixels that count for the error of a picture (design.md, section 8): without those
/// that see an emitter or the sky, and their neighbours.
std::vector<bool> measured_pixels(const RayScene& scene, const CameraRays& camera);

/// Pixels whose centre shows a surface that reflects and does not emit, row by row: those that
/// count for the exposure.
std::vector<bool> reflecting_pixels(const RayScene& scene, const CameraRays& camera);

}  // namespace raybundle
