// SPDX-License-Identifier: Apache-2.0
#include "scene/contact/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace raybundle {
namespace {

constexpr std::uint32_t leaf_size = 4;

int longest_side(const BoxTree::Box& box) {
    const glm::dvec3 sides = box.high - box.low;
    if (sides.x >= sides.y && sides.x >= sides.z) {
        return 0;
    }
    return sides.y >= sides.z ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!boxes_.empty()) {
        build(0, static_cast<std::uint32_t>(boxes_.size()));
    }
}

void BoxTree::build(std::uint32_t first, std::uint32_t count) {
    Box box = boxes_[order_[first]];
    for (std::uint32_t i = first; i < first + count; ++i) {
        box.low = glm::min(box.low, boxes_[order_[i]].low);
        box.high = glm::max(box.high, boxes_[order_[i]].high);
    }
    const std::size_t index = nodes_.size();
    nodes_.push_back({box, first, count, 0});
    if (count <= leaf_size) {
        return;
    }
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count,
                     [&, axis = longest_side(box)](std::uint32_t a, std::uint32_t b) {
                         return boxes_[a].low[axis] + boxes_[a].high[axis] <
                                boxes_[b].low[axis] + boxes_[b].high[axis];
                     });
    nodes_[index].count = 0;
    build(first, count / 2);
    nodes_[index].second_child = static_cast<std::uint32_t>(nodes_.size());
    build(first + count / 2, count - count / 2);
}

}  // namespace raybundle
