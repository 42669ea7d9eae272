// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace raybundle {

/// Largest albedo of a patch: the iteration contracts.
constexpr float max_albedo = 0.999F;

/// Albedo of the Lambert surface that stands for a material whose base colour (factor times
/// texture, linear) is `colour`.
///
/// The solution carries diffuse reflection. A dielectric reflects base_colour * (1 - metallic)
/// diffusely. A metal reflects nothing diffusely and base_colour at normal incidence as a gloss; so
/// that metals are not black and a room keeps its energy, that part is folded in here as if it
/// were diffuse: base_colour * metallic. The 4 % that a dielectric reflects at its surface
/// (specular) come on top of neither.
glm::vec3 lambert_albedo(const Material& material, const glm::vec3& colour);

/// Whether lambert_albedo() had to cut this colour down to max_albedo.
bool exceeds_max_albedo(const Material& material, const glm::vec3& colour);

}  // namespace raybundle
