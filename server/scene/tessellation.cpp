// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "scene/edge_refinement.h"
#include "scene/gltf_loader.h"
#include "scene/near_field.h"
#include "scene/patch_colour.h"
#include "scene/patch_mesh.h"
#include "scene/point_index.h"
#include "scene/reflectance_grid.h"

namespace raybundle {
namespace {

// Longest-edge bisection leaves edges between about half the target and the target; measured on
// boxes, the mean patch area is this many squared target edges.
constexpr double mean_area = 0.18;
constexpr int max_search_steps = 7;
constexpr double close_enough = 0.05;  // relative, of the patch count
constexpr std::size_t max_named_materials = 8;
constexpr double misplaced_share = 1e-6;     // of the direct flux, that a patch may misplace
constexpr std::size_t flux_samples = 1'000;  // patches that it is found from
constexpr int max_rounds = 12;               // of splitting them

/// Area of all patches, m².
double total_area(const Scene& scene) {
    double area = 0.0;
    for (const Triangle& triangle : scene.triangles) {
        const glm::dmat4 world(scene.objects[triangle.object].world_from_object());
        glm::dvec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = world * glm::dvec4(glm::dvec3(scene.vertices[triangle.vertex[k]].position), 1.0);
        }
        const double sides = two_sided(scene, triangle) ? 2.0 : 1.0;
        area += sides * 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    }
    return area;
}

/// Patches to aim for. A file whose triangles alone use up the target still gets half as many on
/// top, so that its large walls are not left whole.
std::size_t goal_of(const TessellationSettings& settings, std::size_t unrefined) {
    const std::size_t target = settings.target_patches;
    return std::min(settings.max_patches, std::max(target, unrefined + target / 2));
}

/// Finds the target edge whose patch count comes closest to the goal, by a bracketed search that
/// takes the number of added patches as proportional to edge^-2.
EdgeRefinement refine_to_count(const Scene& scene, const EdgeRefinement& unrefined,
                               std::size_t goal_count) {
    const auto base = static_cast<double>(unrefined.patch_count());
    const auto goal = static_cast<double>(goal_count);
    const std::size_t give_up = goal_count + goal_count / 2;
    double too_fine = 0.0;
    double too_coarse = 1e30;
    double edge = std::sqrt(total_area(scene) / (mean_area * goal));
    EdgeRefinement best = unrefined;
    double best_error = std::abs(std::log(base / goal));
    for (int step = 0; step < max_search_steps && best_error > close_enough; ++step) {
        EdgeRefinement attempt = unrefined;
        const bool finished = attempt.refine(edge, give_up);
        const auto count = static_cast<double>(attempt.patch_count());
        (count > goal ? too_fine : too_coarse) = edge;
        if (finished && std::abs(std::log(count / goal)) < best_error) {
            best_error = std::abs(std::log(count / goal));
            best = std::move(attempt);
        }
        edge *= std::sqrt(std::clamp((count - base) / std::max(goal - base, 1.0), 0.1, 10.0));
        if (edge <= too_fine || edge >= too_coarse) {
            edge = std::sqrt(too_fine * too_coarse);
        }
    }
    return best;
}

/// Cuts the scene's triangles where others stand on them.
void cut_at_contacts(const Scene& scene, const TessellationSettings& settings,
                     EdgeRefinement& refinement) {
    const auto goal = static_cast<double>(goal_of(settings, refinement.patch_count()));
    const double edge = settings.patch_size > 0.0F
                            ? double{settings.patch_size}
                            : std::sqrt(total_area(scene) / (mean_area * goal));
    refinement.cut(find_contact_lines(scene, edge), contact_resolution * edge);
}

NearField::Face face_of(const EdgeRefinement& refinement,
                        const EdgeRefinement::RefinedTriangle& triangle) {
    return {refinement.world_corners(triangle), triangle.material, triangle.two_sided};
}

/// Direct flux on all patches, lm, from some of them.
double direct_flux(const EdgeRefinement& refinement, const NearField& field) {
    const auto& triangles = refinement.triangles();
    const std::size_t stride = std::max<std::size_t>(triangles.size() / flux_samples, 1);
    double sum = 0.0;
    for (std::size_t t = 0; t < triangles.size(); t += stride) {
        sum += field.direct_flux(face_of(refinement, triangles[t]));
    }
    return sum * static_cast<double>(stride);
}

/// Splits patches on which light changes, as surfaces close by see, the worst first where not all
/// can be.
void refine_near_field(const Scene& scene, const TessellationSettings& settings,
                       EdgeRefinement& refinement) {
    const NearField field(scene);
    const auto& triangles = refinement.triangles();
    const std::size_t most_patches =
        std::min(settings.max_patches, refinement.patch_count() + refinement.patch_count() / 2);
    const double least = misplaced_share * direct_flux(refinement, field);
    double threshold = least;      // lm
    std::vector<float> misplaced;  // lm, by node; below zero: not known yet
    for (int round = 0; least > 0.0 && round < max_rounds; ++round) {
        misplaced.resize(refinement.nodes().size(), -1.0F);
        tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
            float& value = misplaced[triangles[t].node];
            if (value < 0.0F) {
                value = static_cast<float>(
                    field.misplaced_flux(face_of(refinement, triangles[t]), least));
            }
        });
        std::vector<bool> chosen(triangles.size());
        do {
            std::transform(triangles.begin(), triangles.end(), chosen.begin(),
                           [&](const auto& t) { return double{misplaced[t.node]} > threshold; });
            if (std::find(chosen.begin(), chosen.end(), true) == chosen.end()) {
                return;
            }
            threshold *= 2.0;
        } while (!refinement.split(chosen, most_patches));
        threshold *= 0.5;
    }
}

EdgeRefinement refine(const Scene& scene, const TessellationSettings& settings) {
    EdgeRefinement refinement(scene);
    if (refinement.patch_count() > settings.max_patches) {
        throw SceneError(scene.path, "",
                         fmt::format("{} patches without any tessellation; the limit is {}",
                                     refinement.patch_count(), settings.max_patches));
    }
    cut_at_contacts(scene, settings, refinement);
    if (!(settings.patch_size > 0.0F)) {
        refinement =
            refine_to_count(scene, refinement, goal_of(settings, refinement.patch_count()));
    } else if (!refinement.refine(double{settings.patch_size}, settings.max_patches)) {
        throw SceneError(scene.path, "",
                         fmt::format("patch size {} m gives more than {} patches",
                                     settings.patch_size, settings.max_patches));
    }
    refine_near_field(scene, settings, refinement);
    return refinement;
}

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

/// Colours of patches; those of materials without textures are computed once.
class PatchPainter {
  public:
    explicit PatchPainter(const Scene& scene)
        : scene_(scene),
          constant_(scene.materials.size()),
          clamped_(scene.materials.size(), false) {}

    PatchColour colour_of(const EdgeRefinement::RefinedTriangle& triangle) {
        const Material& material = scene_.materials[triangle.material];
        const std::array<glm::vec2, 3> uv = {triangle.corners[0].uv, triangle.corners[1].uv,
                                             triangle.corners[2].uv};
        const glm::vec3 factor =
            (triangle.corners[0].colour + triangle.corners[1].colour + triangle.corners[2].colour) /
            3.0F;
        if (varies_by_texture(material) || factor != glm::vec3(1.0F)) {
            const PatchColour colour = patch_colour(scene_, material, uv, factor);
            clamped_[triangle.material] = clamped_[triangle.material] || colour.was_clamped;
            return colour;
        }
        std::optional<PatchColour>& known = constant_[triangle.material];
        if (!known) {
            known = patch_colour(scene_, material, uv);
            clamped_[triangle.material] = known->was_clamped;
        }
        return *known;
    }

    /// Names the materials whose albedo was cut down, if any.
    [[nodiscard]] std::optional<std::string> clamp_notice() const {
        std::string names;
        std::size_t count = 0;
        for (std::size_t m = 0; m < clamped_.size(); ++m) {
            if (clamped_[m] && ++count <= max_named_materials) {
                names += fmt::format("{}\"{}\"", count > 1 ? ", " : "", scene_.materials[m].name);
            }
        }
        if (count == 0) {
            return std::nullopt;
        }
        if (count > max_named_materials) {
            names += fmt::format(" and {} more", count - max_named_materials);
        }
        return fmt::format("albedo clamped to 0.999 for {} {}",
                           count > 1 ? "materials" : "material", names);
    }

  private:
    const Scene& scene_;
    std::vector<std::optional<PatchColour>> constant_;
    std::vector<bool> clamped_;
};

/// Fills a PatchMesh from refined triangles: welds corners to vertices, adds patches.
class MeshBuilder {
  public:
    MeshBuilder(Scene& scene, const EdgeRefinement& refinement)
        : scene_(scene),
          refinement_(refinement),
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
                add_triangle(triangle, colour);
            } else {
                ++invisible_;
            }
        }
        add_facets();
        add_back_patches();
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

    void add_back_patches() {
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
    PatchPainter painter_;
    std::vector<std::uint32_t> triangle_of_node_;  // no_patch: cut away, or split
    PatchMesh mesh_;
    std::vector<bool> two_sided_;  // by the mesh's triangle
    bool coloured_ = false;        // some vertex is not white
    bool cut_ = false;             // alpha MASK has left less than the whole of some patch
    std::unordered_map<EdgeRefinement::Corner, std::uint32_t, CornerHash, CornerEqual> vertices_;
    std::size_t invisible_ = 0;
};

}  // namespace

PatchMesh tessellate(Scene& scene, const TessellationSettings& settings) {
    const EdgeRefinement refinement = refine(scene, settings);
    return MeshBuilder(scene, refinement).build();
}

}  // namespace raybundle
