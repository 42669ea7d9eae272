// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/mesh/bisection_node.h"

namespace raybundle {

/// Up to three levels of the bisections that have cut a facet into triangles, in 64 bits, so that a
/// walk from a facet to the triangle under a point takes a third of the memory accesses. The walk
/// is triangle_at() in shaders/scene/facets.glsl.
///
/// An inner node has bits 2i, 2i+1 of `code` for its bisections i = 0 (root), 1, 2 (its children),
/// 3..6 (theirs): the edge that is split (see BisectionNode), or `stop` where that triangle
/// is whole. A walk leaves it at one of eight exits: facet_tree[first + exit], the bits of the exit
/// being the choices, most significant first, 0 after a stop. A leaf has bit 31 of `code`, and
/// `first` is the triangle.
struct FacetNode {
    static constexpr std::uint32_t leaf_bit = 0x80000000U;
    static constexpr std::uint32_t stop = 3;
    static constexpr std::uint32_t bisections = 7;
    static constexpr std::uint32_t exits = 8;

    std::uint32_t code = leaf_bit;
    std::uint32_t first = 0;

    static FacetNode leaf(std::uint32_t triangle) { return {leaf_bit, triangle}; }
};

/// Packs the bisections below `root` into `tree` and returns the facet's own node.
/// triangle_of_node: triangle of every leaf of `nodes`.
FacetNode pack_facet(std::span<const BisectionNode> nodes, std::uint32_t root,
                     std::span<const std::uint32_t> triangle_of_node, std::vector<FacetNode>& tree);

}  // namespace raybundle
