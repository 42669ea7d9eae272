// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace raybundle {

/// Unit vector as a point of the square [-1, 1]^2, as shaders/common/octahedral.glsl has it.
inline glm::vec2 octahedral_from_vector(const glm::vec3& n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (sum <= 0.0F) {
        return {0.0F, 0.0F};
    }
    const glm::vec2 p = glm::vec2(n) / sum;
    if (n.z >= 0.0F) {
        return p;
    }
    return {(1.0F - std::abs(p.y)) * (p.x >= 0.0F ? 1.0F : -1.0F),
            (1.0F - std::abs(p.x)) * (p.y >= 0.0F ? 1.0F : -1.0F)};
}

}  // namespace raybundle
