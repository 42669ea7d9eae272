// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "reference/ray_scene.h"

namespace raybundle {

/// Whether a point lies within a solid: most of what can be seen from there are back sides that no
/// light reaches. Of surfaces with two sides nobody can tell. position: own space of the scene.
bool inside_solid(const RayScene& scene, const glm::dvec3& position);

/// The point, or where it lies on a surface, or up to a millimetre below one, that faces along the
/// axis: where rays start in front of that. On the surface rounding would decide what it sees.
/// position: own space; axis: unit.
glm::dvec3 in_front_of_surface(const RayScene& scene, const glm::dvec3& position,
                               const glm::dvec3& axis);

}  // namespace raybundle
