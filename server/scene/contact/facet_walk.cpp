// SPDX-License-Identifier: Apache-2.0
#include "scene/contact/facet_walk.h"

namespace raybundle {

std::uint32_t triangle_at(FacetNode node, const std::vector<FacetNode>& tree, glm::vec3 weights) {
    constexpr int max_depth = 24;  // 72 bisections
    constexpr int levels = 3;      // of bisections in a node
    for (int depth = 0; depth < max_depth && (node.code & FacetNode::leaf_bit) == 0; ++depth) {
        std::uint32_t bisection = 0;
        std::uint32_t exit = 0;
        for (int level = 0; level < levels; ++level) {
            const std::uint32_t edge = node.code >> (2 * bisection) & 3U;
            std::uint32_t bit = 0;
            if (edge != FacetNode::stop) {
                const glm::vec3 w = edge == 1   ? glm::vec3(weights.y, weights.z, weights.x)
                                    : edge == 2 ? glm::vec3(weights.z, weights.x, weights.y)
                                                : weights;
                const float difference = w.x - w.y;
                bit = difference < 0.0F ? 1 : 0;
                weights = bit != 0 ? glm::vec3(2.0F * w.x, -difference, w.z)
                                   : glm::vec3(difference, 2.0F * w.y, w.z);
            }
            exit = 2 * exit + bit;
            bisection = 2 * bisection + 1 + bit;
        }
        node = tree[node.first + exit];
    }
    return node.first;
}

}  // namespace raybundle
