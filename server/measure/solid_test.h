// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "reference/ray_scene.h"

namespace raybundle {

/// Whether a point lies within a solid: most of what can be seen from there are back sides that no
/// light reaches. Of surfaces with two sides nobody can tell. position: own space of the scene.
bool inside_solid(const RayScene& scene, const glm::dvec3& position);

}  // namespace raybundle
