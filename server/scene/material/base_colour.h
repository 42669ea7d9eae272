// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace raybundle {

/// Largest albedo of a surface: the iteration contracts.
constexpr float max_albedo = 0.999F;

/// A base colour (factor times texture, linear) as it is used.
inline glm::vec3 clamped_base_colour(const glm::vec3& colour) {
    return glm::clamp(colour, 0.0F, max_albedo);
}

/// Whether clamped_base_colour() has to cut this colour down.
inline bool exceeds_max_albedo(const glm::vec3& colour) {
    return glm::any(glm::greaterThan(colour, glm::vec3(max_albedo)));
}

}  // namespace raybundle
