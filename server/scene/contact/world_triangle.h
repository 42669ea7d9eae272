// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "scene/scene.h"

namespace raybundle {

/// Corners of a triangle in the world, its object at its initial place, m.
std::array<glm::dvec3, 3> world_corners(const Scene& scene, const Triangle& triangle);

/// Its area times two, along its front's normal, m².
inline glm::dvec3 double_area(const std::array<glm::dvec3, 3>& corners) {
    return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

}  // namespace raybundle
