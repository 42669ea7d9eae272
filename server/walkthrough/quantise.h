// SPDX-License-Identifier: Apache-2.0
// How walkthroughs store numbers. client_web/walkthrough/shaders.js decodes them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "scene/scene.h"

namespace raybundle {

/// Three channels with 9 bits each and one exponent of 5 (EXT_texture_shared_exponent, RGB9_E5): 0
/// to 65408, within 2^-9 of the largest channel from 2^-16 on. Negative and NaN become 0.
std::uint32_t rgb9e5(const glm::vec3& colour);
glm::vec3 from_rgb9e5(std::uint32_t packed);
constexpr float largest_rgb9e5 = 65408.0F;

/// A grid of 2^21 points along each axis of a box.
struct PositionGrid {
    static constexpr float steps = 2097151.0F;  // 2^21 - 1

    explicit PositionGrid(const Bounds& bounds);
    glm::vec3 origin;
    glm::vec3 step;  ///< m

    [[nodiscard]] glm::uvec3 place(const glm::vec3& position) const;
};

/// A vertex in 12 bytes: 21 bits an axis, x lowest, then from bit 64 on the octahedral normal, two
/// snorm8. A normal of 0 is (0, 0, 1).
std::array<std::uint32_t, 3> packed_vertex(const PositionGrid& grid, const glm::vec3& position,
                                           const glm::vec3& normal);

/// Square roots of 0 to 1 as unorm8, the fourth 255.
std::uint32_t packed_colour(const glm::vec3& colour);

}  // namespace raybundle
