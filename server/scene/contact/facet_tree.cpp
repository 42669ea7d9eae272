// SPDX-License-Identifier: Apache-2.0
#include "scene/contact/facet_tree.h"

#include <array>

namespace raybundle {

namespace {

bool is_leaf(const BisectionNode& node) {
    return node.first_child == BisectionNode::no_children;
}

}  // namespace

// Bisection halves areas, so that the depth, and with it the recursion, is bounded by the patch
// limit: every level of it doubles the triangles.
FacetNode pack_facet(std::span<const BisectionNode> nodes, std::uint32_t root,
                     std::span<const std::uint32_t> triangle_of_node,
                     std::vector<FacetNode>& tree) {
    if (is_leaf(nodes[root])) {
        return FacetNode::leaf(triangle_of_node[root]);
    }
    // The triangles at the heads of the seven bisections, and behind them the eight exits.
    std::array<std::uint32_t, FacetNode::bisections + FacetNode::exits> heap{};
    heap[0] = root;
    FacetNode packed{0, static_cast<std::uint32_t>(tree.size())};
    for (std::uint32_t i = 0; i < FacetNode::bisections; ++i) {
        const BisectionNode& node = nodes[heap[i]];
        const std::uint32_t edge = is_leaf(node) ? FacetNode::stop : node.split_edge;
        packed.code |= edge << (2 * i);
        heap[2 * i + 1] = is_leaf(node) ? heap[i] : node.first_child;
        heap[2 * i + 2] = is_leaf(node) ? heap[i] : node.first_child + 1;
    }
    tree.resize(tree.size() + FacetNode::exits);
    for (std::uint32_t exit = 0; exit < FacetNode::exits; ++exit) {
        const FacetNode below =
            pack_facet(nodes, heap[FacetNode::bisections + exit], triangle_of_node, tree);
        tree[packed.first + exit] = below;
    }
    return packed;
}

}  // namespace raybundle
