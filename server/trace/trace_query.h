// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "trace/facet_tree_scene.h"
#include "trace/line_openings.h"
#include "trace/line_order.h"
#include "trace/ray_grid.h"

namespace raybundle {

/// All hits of the lines of a packet.
struct PacketLines {
    glm::ivec2 first{0};  // pixel
    int columns = 4;
    int line_row = 0;
    std::array<std::vector<LineHit>, 16> lines;
};

/// What the filters have to know. The context comes first, since Embree hands on its address.
struct Query {
    RTCIntersectContext context{};
    const FacetTreeScene* tree = nullptr;
    const LineOpenings* openings = nullptr;
    const TraceRules* rules = nullptr;
    std::span<const std::uint32_t> hidden;
    bool fronts_only = false;
    PacketLines* lines = nullptr;
    std::uint32_t own_facet = 0xffffffffU;  ///< of filter_shadow()
    float tie = 0.0F;                       ///< m, likewise
};

/// Filter of parts that rays may pass, or that are in motion.
void filter_part(const RTCFilterFunctionNArguments* arguments);
/// Takes out backs, and what is hidden, as the query says.
void filter_query(const RTCFilterFunctionNArguments* arguments);
/// Keeps all that lines meet in the query's lines.
void filter_lines(const RTCFilterFunctionNArguments* arguments);

/// Takes out what belongs to the surface that rays to lamps begin on.
void filter_shadow(const RTCFilterFunctionNArguments* arguments);

}  // namespace raybundle
