// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace raybundle {

/// Direction i of `count` on a Fibonacci lattice on the sphere, unit.
inline glm::vec3 spread_direction(int i, int count) {
    const float golden_angle = std::numbers::pi_v<float> * (3.0F - std::sqrt(5.0F));
    const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(count);
    const float radius = std::sqrt(1.0F - y * y);
    const float angle = golden_angle * static_cast<float>(i);
    return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

}  // namespace raybundle
