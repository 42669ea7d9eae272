// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "scene/gltf/gltf_loader.h"
#include "scene/mesh/patch_painter.h"
#include "scene/mix_bits.h"

namespace raybundle {
namespace {

// Least cosine between a triangle's normal and the mean of what it shares its light with. What a
// metal reflects depends on it.
constexpr double widest_of_metals = 0.866;
constexpr double widest_of_others = 0.17;
constexpr float metal = 0.5F;  // metalness from which on a surface is one

/// Welds corners that are equal in place and shading to vertices of a mesh, numbered in the order
/// of their first use. A hash table of nothing but vertex numbers, open addressing.
class VertexWeld {
  public:
    VertexWeld(const EdgeRefinement& refinement, PatchMesh& mesh)
        : refinement_(refinement),
          mesh_(mesh),
          slots_(std::bit_ceil(refinement.points().size() * 3 / 2 + 2), none) {}

    std::uint32_t vertex_of(const EdgeRefinement::Corner& corner, std::uint32_t object) {
        if (4 * (points_.size() + 1) > 3 * slots_.size()) {
            grow();
        }
        const EdgeRefinement::Shading shading = refinement_.shading(corner.shading);
        std::uint32_t& slot = slot_of(corner.point, shading);
        if (slot == none) {
            slot = static_cast<std::uint32_t>(points_.size());
            points_.push_back(corner.point);
            mesh_.positions.push_back(refinement_.points()[corner.point]);
            mesh_.normals.push_back(shading.normal);
            mesh_.uvs.push_back(shading.uv);
            mesh_.vertex_object.push_back(object);
            add_colour(shading.colour);
        }
        return slot;
    }

    /// Point of each vertex; takes them out.
    std::vector<std::uint32_t> take_points() { return std::move(points_); }

  private:
    static constexpr std::uint32_t none = 0xffffffffU;

    static std::uint64_t hash(std::uint32_t point, const EdgeRefinement::Shading& c) {
        const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
        std::uint64_t hash = mix_bits(bits(c.normal.x) << 32U | bits(c.normal.y));
        hash = mix_bits(hash ^ (bits(c.uv.x) << 32U | bits(c.uv.y)));
        hash = mix_bits(hash ^ (bits(c.colour.x) << 32U | (bits(c.colour.y) ^ bits(c.colour.z))));
        return mix_bits(hash ^ (bits(c.normal.z) << 32U | point));
    }
    [[nodiscard]] EdgeRefinement::Shading shading_of(std::uint32_t vertex) const {
        return {mesh_.normals[vertex], mesh_.uvs[vertex],
                mesh_.colours.empty() ? glm::vec3(1.0F) : mesh_.colours[vertex]};
    }
    std::uint32_t& slot_of(std::uint32_t point, const EdgeRefinement::Shading& shading) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = hash(point, shading) & mask;
        while (slots_[at] != none &&
               (points_[slots_[at]] != point || shading_of(slots_[at]) != shading)) {
            at = (at + 1) & mask;
        }
        return slots_[at];
    }
    void grow() {
        slots_.assign(2 * slots_.size(), none);
        for (std::uint32_t vertex = 0; vertex < points_.size(); ++vertex) {
            slot_of(points_[vertex], shading_of(vertex)) = vertex;
        }
    }
    /// No colours are kept as long as all are white.
    void add_colour(const glm::vec3& colour) {
        if (mesh_.colours.empty() && colour == glm::vec3(1.0F)) {
            return;
        }
        mesh_.colours.resize(points_.size() - 1, glm::vec3(1.0F));
        mesh_.colours.push_back(colour);
    }

    const EdgeRefinement& refinement_;
    PatchMesh& mesh_;
    std::vector<std::uint32_t> slots_;   // a power of two
    std::vector<std::uint32_t> points_;  // by vertex
};

/// Fills a PatchMesh from refined triangles: welds corners to vertices, adds patches.
class MeshBuilder {
  public:
    MeshBuilder(Scene& scene, EdgeRefinement refinement, const JoinSettings& join)
        : scene_(scene),
          refinement_(std::move(refinement)),
          join_(join),
          painter_(scene),
          triangle_of_node_(refinement_->nodes().size(), PatchMesh::no_patch),
          faces_(scene, mesh_) {
        weld_.emplace(*refinement_, mesh_);
    }

    PatchMesh build() {
        reserve();
        for (const EdgeRefinement::RefinedTriangle& triangle : refinement_->triangles()) {
            const PatchColour colour = colour_of(triangle);
            if (colour.coverage > 0.0F) {
                triangle_of_node_[triangle.node] =
                    static_cast<std::uint32_t>(mesh_.triangles.size());
                if (triangle.small) {
                    faces_.add(static_cast<std::uint32_t>(mesh_.triangles.size()),
                               kind_of(triangle, colour));
                }
                add_triangle(triangle, colour);
            } else {
                ++invisible_;
            }
        }
        refinement_->drop_triangles();
        add_facets();
        faces_.set_points(weld_->take_points());
        weld_.reset();
        refinement_.reset();
        triangle_of_node_ = {};
        add_back_sides();
        if (!cut_) {
            mesh_.coverage = {};
        }
        shrink();
        join();
        add_notices();
        if (mesh_.triangles.empty()) {
            throw SceneError(scene_.path, "", "everything in the scene is cut away by alpha MASK");
        }
        return std::move(mesh_);
    }

  private:
    /// For as many triangles and sides as there may be.
    void reserve() {
        const std::size_t triangles = refinement_->triangles().size();
        const std::size_t sides = refinement_->patch_count();
        mesh_.triangles.reserve(triangles);
        mesh_.triangle_material.reserve(triangles);
        two_sided_.reserve(triangles);
        mesh_.side_triangle.reserve(sides);
        mesh_.base_colour.reserve(sides);
        mesh_.emission.reserve(sides);
        mesh_.coverage.reserve(sides);
        if (std::any_of(scene_.materials.begin(), scene_.materials.end(), has_reflectance_grid)) {
            varied_ = true;
            mesh_.metallic_roughness.reserve(triangles);
        }
        const std::size_t facets = refinement_->unrefined().size();
        mesh_.facets.reserve(facets);
        mesh_.facet_material.reserve(facets);
        mesh_.facet_roots.reserve(facets);
    }

    /// Of vertices, whose number is not known before, and facets.
    void shrink() {
        mesh_.positions.shrink_to_fit();
        mesh_.normals.shrink_to_fit();
        mesh_.uvs.shrink_to_fit();
        mesh_.colours.shrink_to_fit();
        mesh_.vertex_object.shrink_to_fit();
        mesh_.facet_tree.shrink_to_fit();
    }

    PatchColour colour_of(const EdgeRefinement::RefinedTriangle& triangle) {
        const auto& [a, b, c] = triangle.corners;
        return painter_.colour_of(triangle.material,
                                  {refinement_->shading(a.shading), refinement_->shading(b.shading),
                                   refinement_->shading(c.shading)});
    }

    void add_triangle(const EdgeRefinement::RefinedTriangle& triangle, const PatchColour& colour) {
        mesh_.side_triangle.push_back(static_cast<std::uint32_t>(mesh_.triangles.size()));
        mesh_.triangles.push_back(vertices_of(triangle));
        mesh_.triangle_material.push_back(triangle.material);
        two_sided_.push_back(triangle.two_sided);
        mesh_.base_colour.push_back(colour.base_colour);
        mesh_.emission.push_back(colour.emission);
        mesh_.coverage.push_back(colour.coverage);
        if (varied_) {
            mesh_.metallic_roughness.push_back(colour.metallic_roughness);
        }
        cut_ = cut_ || colour.coverage < 1.0F;
    }

    glm::uvec3 vertices_of(const EdgeRefinement::RefinedTriangle& triangle) {
        glm::uvec3 vertices;
        for (int k = 0; k < 3; ++k) {
            vertices[k] =
                weld_->vertex_of(triangle.corners[static_cast<std::size_t>(k)], triangle.object);
        }
        return vertices;
    }

    std::uint32_t kind_of(const EdgeRefinement::RefinedTriangle& triangle,
                          const PatchColour& colour) {
        const glm::vec3& light = colour.emission;
        const Kind kind{triangle.object,
                        triangle.material,
                        triangle.two_sided ? 1U : 0U,
                        std::bit_cast<std::uint32_t>(light.r),
                        std::bit_cast<std::uint32_t>(light.g),
                        std::bit_cast<std::uint32_t>(light.b)};
        const auto known = kinds_.find(kind);
        if (known != kinds_.end()) {
            return known->second;
        }
        const auto number = static_cast<std::uint32_t>(kinds_.size());
        kinds_.emplace(kind, number);
        const Kind without{kind[0], kind[1], kind[2], 0U, 0U, 0U};
        const auto [rough, inserted] =
            kinds_.try_emplace(without, static_cast<std::uint32_t>(kinds_.size()));
        const float metallic = scene_.materials[triangle.material].metallic;
        const double widest = metallic >= metal ? widest_of_metals : widest_of_others;
        JoinKind join_kind{rough->second, std::acos(widest), triangle.two_sided};
        faces_.add_kind(join_kind);
        if (inserted) {
            faces_.add_kind(join_kind);
        }
        return number;
    }

    /// Joins small triangles, and makes patches of what is together.
    void join() {
        if (faces_.empty()) {
            return;
        }
        JoinSettings settings = join_;
        const std::size_t others = mesh_.side_count() - sides_of_faces();
        settings.most_sides -= std::min(settings.most_sides, others);
        if (settings.wanted_sides > 0) {
            settings.wanted_sides -= std::min(settings.wanted_sides - 1, others);
        }
        const std::vector<std::uint32_t> sets = join_faces(scene_, faces_, settings);
        mesh_.patch_sets = make_patch_sets(mesh_, faces_.triangles(), sets);
    }

    [[nodiscard]] std::size_t sides_of_faces() const {
        std::size_t sides = 0;
        for (std::uint32_t face = 0; face < faces_.size(); ++face) {
            sides += faces_.sides_of(face);
        }
        return sides;
    }

    /// The scene's triangles; in the place of one that alpha MASK has cut holes into, what is left.
    void add_facets() {
        for (const EdgeRefinement::RefinedTriangle& whole : refinement_->unrefined()) {
            const std::vector<std::uint32_t> pieces = triangles_below(whole.node);
            const bool complete =
                std::find(pieces.begin(), pieces.end(), PatchMesh::no_patch) == pieces.end();
            if (complete) {
                mesh_.facets.push_back(vertices_of(whole));
                mesh_.facet_material.push_back(whole.material);
                mesh_.facet_roots.push_back(pack_facet(refinement_->nodes(), whole.node,
                                                       triangle_of_node_, mesh_.facet_tree));
                continue;
            }
            for (const std::uint32_t triangle : pieces) {
                if (triangle != PatchMesh::no_patch) {
                    mesh_.facets.push_back(mesh_.triangles[triangle]);
                    mesh_.facet_material.push_back(whole.material);
                    mesh_.facet_roots.push_back(FacetNode::leaf(triangle));
                }
            }
        }
    }

    /// Triangles that the bisections of a node have ended in, no_patch for those left out.
    [[nodiscard]] std::vector<std::uint32_t> triangles_below(std::uint32_t root) const {
        std::vector<std::uint32_t> triangles;
        std::vector<std::uint32_t> pending = {root};
        while (!pending.empty()) {
            const std::uint32_t at = pending.back();
            pending.pop_back();
            const EdgeRefinement::Node& node = refinement_->nodes()[at];
            if (node.first_child == EdgeRefinement::Node::no_children) {
                triangles.push_back(triangle_of_node_[at]);
            } else {
                pending.push_back(node.first_child + 1);
                pending.push_back(node.first_child);
            }
        }
        return triangles;
    }

    void add_back_sides() {
        const std::size_t front_count = mesh_.triangles.size();
        mesh_.back_side.assign(front_count, PatchMesh::no_patch);
        for (std::size_t t = 0; t < front_count; ++t) {
            if (!two_sided_[t]) {
                continue;
            }
            mesh_.back_side[t] = static_cast<std::uint32_t>(mesh_.side_triangle.size());
            mesh_.side_triangle.push_back(static_cast<std::uint32_t>(t));
            mesh_.base_colour.push_back(glm::vec3(mesh_.base_colour[t]));
            mesh_.emission.push_back(glm::vec3(mesh_.emission[t]));
            mesh_.coverage.push_back(float{mesh_.coverage[t]});
        }
    }

    void add_notices() {
        if (const auto notice = painter_.clamp_notice()) {
            scene_.notices.push_back(*notice);
        }
        if (invisible_ > 0) {
            scene_.notices.push_back(
                fmt::format("{} triangles wholly cut away by alpha MASK are left out", invisible_));
        }
    }

    Scene& scene_;
    std::optional<EdgeRefinement> refinement_;
    const JoinSettings& join_;
    PatchPainter painter_;
    std::vector<std::uint32_t> triangle_of_node_;  // no_patch: cut away, or split
    PatchMesh mesh_;
    std::optional<VertexWeld> weld_;
    std::vector<bool> two_sided_;  // by the mesh's triangle
    bool cut_ = false;             // alpha MASK has left less than the whole of some patch
    bool varied_ = false;          // metalness and roughness are kept by triangle
    std::size_t invisible_ = 0;
    JoinFaces faces_;                           // small triangles
    using Kind = std::array<std::uint32_t, 6>;  // object, material, sides, emission (bits)
    std::map<Kind, std::uint32_t> kinds_;
};

}  // namespace

PatchMesh build_mesh(Scene& scene, EdgeRefinement refinement, const JoinSettings& join) {
    return MeshBuilder(scene, std::move(refinement), join).build();
}

}  // namespace raybundle
