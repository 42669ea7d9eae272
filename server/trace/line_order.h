// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace raybundle {

/// A surface that a line of a window meets.
struct LineHit {
    float depth = 0.0F;         ///< along the window's axis, m
    std::uint32_t surface = 0;  ///< 2 * facet + side, as windows number sides
    glm::vec3 normal{0.0F};     ///< of the facet's front, of any length
};

/// How surfaces of a line are ordered; m.
struct LineOrder {
    glm::vec3 axis{0.0F, 0.0F, 1.0F};  ///< of the window
    /// Surfaces back to back that are not farther apart, measured across them, coincide; 0: such
    /// are not looked for.
    float tie = 0.0F;
    float range = 0.0F;  ///< no surfaces that are farther apart along the line do
};

/// Orders the surfaces of a line as shaders/transport_layers_patches.comp does: by depth, then by
/// number; of those that coincide back to back the one that faces the window comes first, so that a
/// thin wall is a wall.
void order_line(std::span<LineHit> hits, const LineOrder& order);

}  // namespace raybundle
