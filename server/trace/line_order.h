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
    /// Surfaces back to back coincide up to this distance across them; 0: none do.
    float tie = 0.0F;
    float range = 0.0F;  ///< and up to this distance along the line
};

/// Orders the surfaces of a line as shaders/transport/transport_layers_patches.comp does: by depth,
/// then by number. Of two surfaces that coincide back to back, the one that faces the window comes
/// first, so that a thin wall stops light.
void order_line(std::span<LineHit> hits, const LineOrder& order);

}  // namespace raybundle
