// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "scene/scene.h"

namespace raybundle {

/// Floor area of the rooms in which these places are, of luminaires say, m²: what EN 15193 divides
/// power by. A room is what has a ceiling at least 1.2 m above something to stand or lie on, and
/// all that it is open to; furniture counts as the floor below it, walls do not. Objects at their
/// present places; solids are told by fronts outwards (the loader marks closed two-sided shells).
/// By columns of 1/256 of the scene's extent, at least 5 cm; wider ones where that
/// would be more than 64 MiB. 0: no place is in a room.
double floor_area(const Scene& scene, std::span<const glm::vec3> places);

}  // namespace raybundle
