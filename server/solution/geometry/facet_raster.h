// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle {

/// What is rasterised: the facets of a mesh, at both places of the objects. Their number is that of
/// the file's triangles, so that finer patches do not make rasterisation slower.
class FacetRaster {
  public:
    /// world_positions: vec4[2 * vertices], place 0 then place 1; must outlive this.
    FacetRaster(const PatchMesh& mesh, const Buffer& world_positions);

    /// Planes and weights from the present world positions. They must be bound.
    void place(unsigned place) const;
    /// Place 1 becomes as place 0.
    void settle() const;
    void bind() const;
    /// Draws the facets that a view (clip_from_world) can see, with a program that adds
    /// `first_facet` to gl_PrimitiveID. world_from_object: of this place. fronts_first: front faces
    /// win over back faces of equal depth.
    void draw(unsigned place, std::span<const glm::mat4> world_from_object,
              const glm::mat4& clip_from_world, bool fronts_first, const ShaderProgram& program,
              std::span<const std::uint32_t> hidden = {}) const;

    [[nodiscard]] std::uint32_t count() const { return count_; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    /// Neighbouring facets of one object, culled together.
    struct Cluster {
        std::uint32_t first = 0, count = 0, object = 0;
        glm::vec3 centre{0.0F};  // object space
        float radius = 0.0F;
    };

    void build_clusters(const PatchMesh& mesh, std::span<const glm::uvec3> facets);

    std::uint32_t count_, vertex_count_;
    std::vector<Cluster> clusters_;
    Buffer indices_, geometry_, nodes_, uvs_;
    VertexArray vertex_array_[2];
    Texture2D geometry_texture_, node_texture_;
    ShaderProgram place_facets_;
};

}  // namespace raybundle
