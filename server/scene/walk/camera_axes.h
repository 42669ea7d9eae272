// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace raybundle {

/// Vectors that span a camera's picture, world space: the ray through a point of the picture goes
/// along forward + x * right + y * up with x and y in [-1, 1], y upwards.
struct CameraAxes {
    glm::vec3 right, up;  ///< scaled to the edge of the picture at unit distance
    glm::vec3 forward;    ///< unit
};

/// Axes of a camera whose picture has this size in pixels. A camera that looks along its `up` is
/// given another one.
CameraAxes camera_axes(const Camera& camera, glm::uvec2 size);

}  // namespace raybundle
