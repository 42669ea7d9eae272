// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "reference/ray_scene.h"

namespace raybundle {

/// Share of light that comes straight through the thin panes between two points in space (own space
/// of the ray scene), all inner reflections and the tint included; 0 where anything else lies
/// between them, bodies of glass too, which bend rays.
glm::dvec3 share_through_panes(const RayScene& scene, const glm::dvec3& from, const glm::dvec3& to);
/// The same from infinitely far away. direction: to there, unit.
glm::dvec3 share_through_panes_from_sky(const RayScene& scene, const glm::dvec3& from,
                                        const glm::dvec3& direction);

}  // namespace raybundle
