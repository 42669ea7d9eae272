// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace raybundle {

/// Axis-aligned boxes, and which of them overlap another: a tree halved at the median of the
/// longest side, so that its depth is the logarithm of their number.
class BoxTree {
  public:
    struct Box {
        glm::dvec3 low{0.0}, high{0.0};

        [[nodiscard]] bool overlaps(const Box& other) const {
            return glm::all(glm::lessThanEqual(low, other.high)) &&
                   glm::all(glm::lessThanEqual(other.low, high));
        }
    };

    explicit BoxTree(std::vector<Box> boxes);

    /// Calls visit(i) for every box i of the constructor's that overlaps this one.
    template <typename Visit>
    void for_each_overlapping(const Box& box, const Visit& visit) const {
        std::array<std::uint32_t, max_depth> pending{};
        std::size_t depth = 0;
        if (!nodes_.empty()) {
            pending[depth++] = 0;
        }
        while (depth > 0) {
            const std::uint32_t index = pending[--depth];
            const Node& node = nodes_[index];
            if (!node.box.overlaps(box)) {
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                if (boxes_[order_[i]].overlaps(box)) {
                    visit(order_[i]);
                }
            }
            if (node.count == 0) {
                pending[depth++] = node.second_child;
                pending[depth++] = index + 1;
            }
        }
    }

  private:
    static constexpr std::size_t max_depth = 64;
    struct Node {
        Box box;
        std::uint32_t first = 0, count = 0;  // of `order_`, in a leaf; count 0: an inner node
        std::uint32_t second_child = 0;      // the first one follows its parent
    };

    void build(std::uint32_t first, std::uint32_t count);

    std::vector<Box> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace raybundle
