// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <unordered_map>
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

struct CornerHash {
    std::size_t operator()(const EdgeRefinement::Corner& c) const {
        const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
        std::uint64_t hash = mix_bits(bits(c.normal.x) << 32U | bits(c.normal.y));
        hash = mix_bits(hash ^ (bits(c.uv.x) << 32U | bits(c.uv.y)));
        hash = mix_bits(hash ^ (bits(c.colour.x) << 32U | (bits(c.colour.y) ^ bits(c.colour.z))));
        return mix_bits(hash ^ (bits(c.normal.z) << 32U | c.point));
    }
};

struct CornerEqual {
    bool operator()(const EdgeRefinement::Corner& a, const EdgeRefinement::Corner& b) const {
        return a.point == b.point && a.normal == b.normal && a.uv == b.uv && a.colour == b.colour;
    }
};

/// Fills a PatchMesh from refined triangles: welds corners to vertices, adds patches.
class MeshBuilder {
  public:
    MeshBuilder(Scene& scene, const EdgeRefinement& refinement, const JoinSettings& join)
        : scene_(scene),
          refinement_(refinement),
          join_(join),
          painter_(scene),
          triangle_of_node_(refinement.nodes().size(), PatchMesh::no_patch) {
        vertices_.reserve(refinement.points().size() * 2);
    }

    PatchMesh build() {
        for (const EdgeRefinement::RefinedTriangle& triangle : refinement_.triangles()) {
            const PatchColour colour = painter_.colour_of(triangle);
            if (colour.coverage > 0.0F) {
                triangle_of_node_[triangle.node] =
                    static_cast<std::uint32_t>(mesh_.triangles.size());
                if (triangle.small) {
                    small_.push_back(static_cast<std::uint32_t>(mesh_.triangles.size()));
                    faces_.push_back(face_of(triangle, colour));
                }
                add_triangle(triangle, colour);
            } else {
                ++invisible_;
            }
        }
        add_facets();
        add_back_sides();
        join();
        add_notices();
        if (!cut_) {
            mesh_.coverage.clear();
        }
        if (!coloured_) {
            mesh_.colours.clear();
        }
        if (std::none_of(scene_.materials.begin(), scene_.materials.end(), has_reflectance_grid)) {
            mesh_.metallic_roughness.clear();
        }
        if (mesh_.triangles.empty()) {
            throw SceneError(scene_.path, "", "everything in the scene is cut away by alpha MASK");
        }
        return std::move(mesh_);
    }

  private:
    void add_triangle(const EdgeRefinement::RefinedTriangle& triangle, const PatchColour& colour) {
        glm::uvec3 corners;
        for (int k = 0; k < 3; ++k) {
            corners[k] = vertex_of(triangle.corners[static_cast<std::size_t>(k)], triangle.object);
        }
        mesh_.side_triangle.push_back(static_cast<std::uint32_t>(mesh_.triangles.size()));
        mesh_.triangles.push_back(corners);
        mesh_.triangle_material.push_back(triangle.material);
        two_sided_.push_back(triangle.two_sided);
        mesh_.base_colour.push_back(colour.base_colour);
        mesh_.emission.push_back(colour.emission);
        mesh_.coverage.push_back(colour.coverage);
        mesh_.metallic_roughness.push_back(colour.metallic_roughness);
        cut_ = cut_ || colour.coverage < 1.0F;
    }

    JoinFace face_of(const EdgeRefinement::RefinedTriangle& triangle, const PatchColour& colour) {
        JoinFace face;
        face.corners = refinement_.world_corners(triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            face.points[k] = triangle.corners[k].point;
        }
        const glm::vec3& light = colour.emission;
        const Kind kind{triangle.object,
                        triangle.material,
                        triangle.two_sided ? 1U : 0U,
                        std::bit_cast<std::uint32_t>(light.r),
                        std::bit_cast<std::uint32_t>(light.g),
                        std::bit_cast<std::uint32_t>(light.b)};
        const auto number_of = [this](const Kind& of) {
            return kinds_.try_emplace(of, static_cast<std::uint32_t>(kinds_.size())).first->second;
        };
        face.kind = number_of(kind);
        face.rough_kind = number_of({kind[0], kind[1], kind[2], 0U, 0U, 0U});
        face.colour = colour.base_colour;
        face.widest = scene_.materials[triangle.material].metallic >= metal ? widest_of_metals
                                                                            : widest_of_others;
        face.two_sided = triangle.two_sided;
        return face;
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
        mesh_.patch_sets = make_patch_sets(mesh_, small_, sets);
    }

    [[nodiscard]] std::size_t sides_of_faces() const {
        return static_cast<std::size_t>(std::accumulate(faces_.begin(), faces_.end(),
                                                        std::size_t{0},
                                                        [](std::size_t sum, const JoinFace& face) {
                                                            return sum + (face.two_sided ? 2U : 1U);
                                                        }));
    }

    std::uint32_t vertex_of(const EdgeRefinement::Corner& corner, std::uint32_t object) {
        const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto [it, inserted] = vertices_.try_emplace(corner, next);
        if (inserted) {
            mesh_.positions.push_back(refinement_.points()[corner.point]);
            mesh_.normals.push_back(corner.normal);
            mesh_.uvs.push_back(corner.uv);
            mesh_.colours.push_back(corner.colour);
            coloured_ = coloured_ || corner.colour != glm::vec3(1.0F);
            mesh_.vertex_object.push_back(object);
        }
        return it->second;
    }

    /// The scene's triangles; in the place of one that alpha MASK has cut holes into, what is left.
    void add_facets() {
        for (const EdgeRefinement::RefinedTriangle& whole : refinement_.unrefined()) {
            const std::vector<std::uint32_t> pieces = triangles_below(whole.node);
            const bool complete =
                std::find(pieces.begin(), pieces.end(), PatchMesh::no_patch) == pieces.end();
            if (complete) {
                glm::uvec3 corners;
                for (int k = 0; k < 3; ++k) {
                    corners[k] =
                        vertex_of(whole.corners[static_cast<std::size_t>(k)], whole.object);
                }
                mesh_.facets.push_back(corners);
                mesh_.facet_material.push_back(whole.material);
                mesh_.facet_roots.push_back(pack_facet(refinement_.nodes(), whole.node,
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
            const EdgeRefinement::Node& node = refinement_.nodes()[at];
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
    const EdgeRefinement& refinement_;
    const JoinSettings& join_;
    PatchPainter painter_;
    std::vector<std::uint32_t> triangle_of_node_;  // no_patch: cut away, or split
    PatchMesh mesh_;
    std::vector<bool> two_sided_;  // by the mesh's triangle
    bool coloured_ = false;        // some vertex is not white
    bool cut_ = false;             // alpha MASK has left less than the whole of some patch
    std::unordered_map<EdgeRefinement::Corner, std::uint32_t, CornerHash, CornerEqual> vertices_;
    std::size_t invisible_ = 0;
    std::vector<JoinFace> faces_;               // small triangles
    std::vector<std::uint32_t> small_;          // their numbers in the mesh
    using Kind = std::array<std::uint32_t, 6>;  // object, material, sides, emission (bits)
    std::map<Kind, std::uint32_t> kinds_;
};

}  // namespace

PatchMesh build_mesh(Scene& scene, const EdgeRefinement& refinement, const JoinSettings& join) {
    return MeshBuilder(scene, refinement, join).build();
}

}  // namespace raybundle
