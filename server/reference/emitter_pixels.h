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

}  // namespace raybundle
