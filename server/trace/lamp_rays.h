// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "scene/scene.h"
#include "trace/ray_grid.h"

namespace raybundle {

/// A point on which the light of lamps is looked for; as shaders/lamps/lamps.glsl has it.
struct LampPoint {
    glm::vec3 position{0.0F};  ///< m
    std::uint32_t facet = 0;   ///< its own, which hides nothing, or FacetTracer::no_hit
    glm::vec3 normal{0.0F};    ///< lamps behind it do not count; 0: all count
    std::uint32_t cell = 0;    ///< row of the slots that are asked for; no_cell: nothing is
    static constexpr std::uint32_t no_cell = 0xffffffffU;
    static constexpr std::uint32_t moved =
        0x80000000U;  ///< flag: it is on an object that has moved
};
static_assert(sizeof(LampPoint) == 32);

/// Lamps to ask points for: rows of lamp_slots numbers each.
constexpr std::size_t lamp_slots = 16;
constexpr std::uint32_t no_lamp = 0xffffffffU;

struct LampQuestion {
    /// Of the lamps: position, w = 1, or unit direction towards one infinitely far away, w = 0.
    std::span<const glm::vec4> lamps;
    std::span<const std::uint32_t> slots;  ///< of cell c from lamp_slots * c on; or no_lamp
    /// Where there are any: only ways that meet one are followed, but from points that have moved.
    std::span<const Bounds> boxes;
    bool but_moved = false;  ///< nothing reaches points that have moved
    TraceRules rules;
    float tie = 0.0F;  ///< m: what is no higher above a point belongs to its surface
};

}  // namespace raybundle
