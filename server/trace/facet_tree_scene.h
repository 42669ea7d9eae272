// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "trace/embree_objects.h"

namespace raybundle {

/// The facets of a mesh in Embree's scene: in world space, so that rays meet the surfaces that the
/// rasteriser draws, to the bit of a vertex. One tree holds all objects that cannot move, and each
/// movable object has its own, below a common top level: a move rebuilds the moved object's tree
/// and the top level.
class FacetTreeScene {
  public:
    /// Some facets of one object, or of all objects that cannot move.
    struct Part {
        std::uint32_t object = 0;
        unsigned place = 0;  ///< of the object; 1: as it was before a move
        bool movable = false;
        bool in_motion = false;  ///< only rays of the same place meet it
        bool may_pass = false;   ///< rays may pass it: cut-outs and glass
        std::vector<std::uint32_t> facets;
        std::vector<glm::vec2> uvs;        ///< of the vertices, where may_pass
        std::vector<glm::vec3> positions;  ///< of the vertices, object space, where it can move
        EmbreeGeometry geometry;
        std::span<glm::uvec3> corners;          ///< of the facets; memory of the geometry
        std::span<glm::vec3> world;             ///< likewise
        unsigned id = RTC_INVALID_GEOMETRY_ID;  ///< of the geometry in the scene
    };

    /// may_pass: of each material. filter: of the parts that rays may pass, and of those in motion.
    /// Throws std::runtime_error where Embree has no memory.
    FacetTreeScene(const Scene& scene, const PatchMesh& mesh,
                   std::span<const glm::mat4> world_from_object, const std::vector<bool>& may_pass,
                   RTCFilterFunctionN filter);
    FacetTreeScene(const FacetTreeScene&) = delete;
    FacetTreeScene& operator=(const FacetTreeScene&) = delete;

    /// Moves an object. Rays meet it at both places until settle().
    /// Throws std::invalid_argument for one that is not movable.
    void move(std::uint32_t object, const glm::mat4& world_from_object);
    void settle();
    /// Builds the trees that have changed. Call it before rays are traced.
    void commit();

    [[nodiscard]] RTCScene get() const { return scene_.get(); }
    [[nodiscard]] RTCDevice device() const { return device_.get(); }
    [[nodiscard]] const Part& part(unsigned geometry) const { return *by_id_[geometry]; }
    [[nodiscard]] std::uint32_t material(std::uint32_t facet) const { return materials_[facet]; }
    [[nodiscard]] std::uint32_t object(std::uint32_t facet) const { return objects_[facet]; }
    /// Rays may pass a material from now on.
    void let_pass(std::uint32_t material);
    [[nodiscard]] std::size_t bytes() const;

  private:
    static constexpr std::uint32_t no_vertex = 0xffffffffU;

    void fill(Part& part, const PatchMesh& mesh, std::span<const glm::mat4> world_from_object,
              std::vector<std::uint32_t>& local_vertex);
    void make_geometry(Part& part, std::size_t vertices);
    void add_place_before(const Part& part);
    void attach(Part& part);
    void detach(Part& part);
    void check() const;

    EmbreeDevice device_;
    EmbreeScene scene_;
    RTCFilterFunctionN filter_;
    std::vector<std::unique_ptr<Part>> parts_;
    std::vector<std::unique_ptr<Part>> before_;  ///< moved ones where they were
    std::vector<const Part*> by_id_;
    std::vector<std::uint32_t> materials_, objects_;  ///< of the facets
    bool changed_ = true;
};

}  // namespace raybundle
