// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "scene/scene.h"

namespace raybundle {

/// Boxes round the facets, by which a ray finds the nearest one (shaders/scene/facet_boxes.glsl): a
/// binary tree over the objects, whose leaves are binary trees over their facets. The nodes are in
/// preorder, each with the number of the one after its subtree, so that a walk needs no stack. The
/// trees' shape stays; what an object's move changes is the boxes of its facets and those on the
/// way to the root. Objects are at their present places only.
class FacetBoxes {
  public:
    /// positions: object space; facets: vertices; vertex_object: of each vertex;
    /// world_from_object: of each object. Throws GpuError where memory runs out.
    FacetBoxes(std::span<const glm::vec3> positions, std::span<const glm::uvec3> facets,
               std::span<const std::uint32_t> vertex_object,
               std::span<const glm::mat4> world_from_object);

    /// Puts an object elsewhere.
    void place(std::uint32_t object, const glm::mat4& world_from_object);
    void bind() const;

    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(nodes_.size()); }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

  private:
    /// Nodes [first, end) of an object.
    struct Range {
        std::uint32_t first = 0, end = 0;
    };

    void enclose(Range range, const glm::mat4& world_from_object);
    void enclose_parts(std::uint32_t node);
    void upload(std::uint32_t first, std::uint32_t end);

    std::vector<layout::FacetBox> nodes_;      // world space
    std::vector<Bounds> object_space_;         // box of each node, of those over the objects empty
    std::vector<Range> objects_;               // by object
    std::vector<std::uint32_t> over_objects_;  // nodes over the objects, parents first
    Buffer buffer_;
    Texture2D texture_;
};

}  // namespace raybundle
