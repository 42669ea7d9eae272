// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/facet_boxes.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <memory>
#include <new>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include "gpu/egl_context.h"

namespace raybundle {

namespace {

using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)>;
using Bvh = std::unique_ptr<std::remove_pointer_t<RTCBVH>, decltype(&rtcReleaseBVH)>;

/// Node of Embree's builder: two children, or an item.
struct BuildNode {
    Bounds box;
    BuildNode* children[2] = {nullptr, nullptr};
    std::uint32_t item = NO_HIT;
};

Bounds bounds_of(const RTCBounds& b) {
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

BuildNode* new_node(RTCThreadLocalAllocator allocator) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode;
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new_node(allocator);
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* item, std::size_t,
                  void*) {
    BuildNode* node = new_node(allocator);
    node->item = item->primID;
    node->box = {{item->lower_x, item->lower_y, item->lower_z},
                 {item->upper_x, item->upper_y, item->upper_z}};
    return node;
}

void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned k = 0; k < count; ++k) {
        static_cast<BuildNode*>(node)->children[k] = static_cast<BuildNode*>(children[k]);
    }
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    Bounds box;
    for (unsigned k = 0; k < count; ++k) {
        const Bounds part = bounds_of(*bounds[k]);
        box.add(part.min);
        box.add(part.max);
    }
    static_cast<BuildNode*>(node)->box = box;
}

/// Node of a finished tree, in preorder.
struct TreeNode {
    Bounds box;
    std::uint32_t item = NO_HIT;  // index of a box; NO_HIT: an inner node, whose parts follow
    std::uint32_t next = 0;       // node after the subtree
};

/// The nodes below `root`, in preorder.
std::vector<TreeNode> in_preorder(const BuildNode* root, std::size_t items) {
    std::vector<TreeNode> tree;
    tree.reserve(2 * items);
    struct Pending {
        const BuildNode* node;  // null: the subtree of `index` ends here
        std::uint32_t index;
    };
    std::vector<Pending> pending{{root, 0}};
    while (!pending.empty()) {
        const Pending next = pending.back();
        pending.pop_back();
        const auto index = static_cast<std::uint32_t>(tree.size());
        if (next.node == nullptr) {
            tree[next.index].next = index;
            continue;
        }
        tree.push_back({next.node->box, next.node->item, 0});
        pending.push_back({nullptr, index});
        for (const BuildNode* part : {next.node->children[1], next.node->children[0]}) {
            if (part != nullptr) {
                pending.push_back({part, 0});
            }
        }
    }
    return tree;
}

/// A tree over boxes by their surface areas; empty ones are left out.
std::vector<TreeNode> build_tree(RTCDevice device, std::span<const Bounds> boxes) {
    std::vector<RTCBuildPrimitive> items;
    items.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Bounds& b = boxes[i];
        if (!b.empty()) {
            items.push_back({b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, i});
        }
    }
    if (items.empty()) {
        return {};
    }
    const Bvh bvh(rtcNewBVH(device), rtcReleaseBVH);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxLeafSize = 1;
    arguments.maxDepth = 1024;
    arguments.bvh = bvh.get();
    arguments.primitives = items.data();
    arguments.primitiveCount = items.size();
    arguments.primitiveArrayCapacity = items.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    const void* root = rtcBuildBVH(&arguments);
    if (root == nullptr) {
        throw GpuError("cannot build the tree of boxes round the scene's triangles (Embree error " +
                       std::to_string(static_cast<int>(rtcGetDeviceError(device))) + ")");
    }
    return in_preorder(static_cast<const BuildNode*>(root), items.size());
}

/// Box round a box that a matrix has moved (J. Arvo 1990, "Transforming Axis-Aligned Bounding
/// Boxes"), with room for rounding.
Bounds moved_box(const Bounds& box, const glm::mat4& matrix) {
    const glm::vec3 centre(matrix * glm::vec4(box.centre(), 1.0F));
    const glm::vec3 half = 0.5F * box.extent();
    const glm::vec3 reach = glm::abs(glm::vec3(matrix[0])) * half.x +
                            glm::abs(glm::vec3(matrix[1])) * half.y +
                            glm::abs(glm::vec3(matrix[2])) * half.z;
    // Of the vertices' products, which may be large and cancel.
    const auto product = [&](int k) { return glm::abs(glm::vec3(matrix[k]) * box.centre()[k]); };
    const glm::vec3 rounding =
        1e-6F * (glm::abs(glm::vec3(matrix[3])) + product(0) + product(1) + product(2) + reach);
    return {centre - reach - rounding, centre + reach + rounding};
}

/// The facets of one object.
struct ObjectTree {
    std::vector<std::uint32_t> facets;
    std::vector<TreeNode> nodes;  // their items index `facets`

    void build(RTCDevice device, std::span<const glm::vec3> positions,
               std::span<const glm::uvec3> all_facets) {
        std::vector<Bounds> boxes;
        boxes.reserve(facets.size());
        for (const std::uint32_t facet : facets) {
            Bounds box;
            for (int k = 0; k < 3; ++k) {
                box.add(positions[all_facets[facet][k]]);
            }
            boxes.push_back(box);
        }
        nodes = build_tree(device, boxes);
    }
};

}  // namespace

FacetBoxes::FacetBoxes(std::span<const glm::vec3> positions, std::span<const glm::uvec3> facets,
                       std::span<const std::uint32_t> vertex_object,
                       std::span<const glm::mat4> world_from_object)
    : objects_(world_from_object.size()) {
    const Device device(rtcNewDevice(nullptr), rtcReleaseDevice);
    std::vector<ObjectTree> trees(world_from_object.size());
    for (std::uint32_t i = 0; i < facets.size(); ++i) {
        trees[vertex_object[facets[i].x]].facets.push_back(i);
    }
    std::vector<Bounds> object_boxes(trees.size());
    for (std::size_t i = 0; i < trees.size(); ++i) {
        trees[i].build(device.get(), positions, facets);
        if (!trees[i].nodes.empty()) {
            object_boxes[i] = moved_box(trees[i].nodes.front().box, world_from_object[i]);
        }
    }
    const std::vector<TreeNode> top = build_tree(device.get(), object_boxes);
    const std::size_t all = std::accumulate(
        trees.begin(), trees.end(), top.size(),
        [](std::size_t sum, const ObjectTree& tree) { return sum + tree.nodes.size(); });
    nodes_.reserve(all);
    object_space_.reserve(all);
    std::vector<std::uint32_t> place_of;  // of the nodes of `top`, and the end
    for (const TreeNode& node : top) {
        place_of.push_back(count());
        if (node.item == NO_HIT) {
            over_objects_.push_back(count());
            nodes_.push_back({{}, 0, {}, NO_HIT});
            object_space_.emplace_back();
            continue;
        }
        const ObjectTree tree = std::move(trees[node.item]);
        const std::uint32_t first = count();
        for (const TreeNode& part : tree.nodes) {
            const bool inner = part.item == NO_HIT;
            nodes_.push_back({{}, first + part.next, {}, inner ? NO_HIT : tree.facets[part.item]});
            object_space_.push_back(part.box);
        }
        objects_[node.item] = {first, count()};
        enclose(objects_[node.item], world_from_object[node.item]);
    }
    place_of.push_back(count());
    for (std::size_t i = 0; i < top.size(); ++i) {
        if (top[i].item == NO_HIT) {
            nodes_[place_of[i]].next = place_of[top[i].next];
        }
    }
    std::for_each(over_objects_.rbegin(), over_objects_.rend(),
                  [this](std::uint32_t node) { enclose_parts(node); });
    buffer_ = Buffer::from<layout::FacetBox>("facet boxes", nodes_);
    texture_ = create_buffer_texture("facet boxes", GL_RGBA32F, buffer_);
}

void FacetBoxes::enclose(Range range, const glm::mat4& world_from_object) {
    for (std::uint32_t i = range.first; i < range.end; ++i) {
        const Bounds box = moved_box(object_space_[i], world_from_object);
        nodes_[i].low = box.min;
        nodes_[i].high = box.max;
    }
}

/// Puts the box of a node over the objects round those of its two parts.
void FacetBoxes::enclose_parts(std::uint32_t node) {
    const layout::FacetBox& first = nodes_[node + 1];
    const layout::FacetBox& second = nodes_[first.next];
    nodes_[node].low = glm::min(first.low, second.low);
    nodes_[node].high = glm::max(first.high, second.high);
}

void FacetBoxes::place(std::uint32_t object, const glm::mat4& world_from_object) {
    const Range range = objects_[object];
    if (range.first == range.end) {
        return;
    }
    enclose(range, world_from_object);
    upload(range.first, range.end);
    for (auto node = over_objects_.rbegin(); node != over_objects_.rend(); ++node) {
        if (*node < range.first && nodes_[*node].next >= range.end) {
            enclose_parts(*node);
            upload(*node, *node + 1);
        }
    }
}

void FacetBoxes::upload(std::uint32_t first, std::uint32_t end) {
    buffer_.write(std::span<const layout::FacetBox>(nodes_).subspan(first, end - first),
                  first * sizeof(layout::FacetBox));
}

void FacetBoxes::bind() const {
    glBindTextureUnit(UNIT_FACET_BOXES, texture_.get());
}

}  // namespace raybundle
