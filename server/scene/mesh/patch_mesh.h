// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/contact/facet_tree.h"
#include "scene/mesh/patch_sets.h"
#include "scene/scene.h"

namespace raybundle {

/// The tessellated scene: what is rasterised (triangles) and what carries radiance (patches).
/// Sides [0, triangles) are the fronts of the triangles, in their order; the backs of doubleSided
/// triangles follow. A patch is a side, or several that share their light (patch_sets).
struct PatchMesh {
    static constexpr std::uint32_t no_patch = 0xffffffffU;

    // Vertices, welded: equal position, normal, uv, colour and object are one vertex, so that the
    // patches round a vertex are the ones to interpolate over (a smoothing group).
    std::vector<glm::vec3> positions;          ///< object space, metres
    std::vector<glm::vec3> normals;            ///< object space, unit
    std::vector<glm::vec2> uvs;                ///< mesh uv, before the slot's transform
    std::vector<glm::vec3> colours;            ///< factors of the base colour; empty: all white
    std::vector<std::uint32_t> vertex_object;  ///< index into Scene::objects

    // Triangles.
    std::vector<glm::uvec3> triangles;  ///< vertex indices, counter-clockwise from the front
    std::vector<std::uint32_t> triangle_material;
    std::vector<std::uint32_t> back_side;  ///< side that is the back, or no_patch

    // Facets: the flat triangles that bundles and pictures rasterise, tiled by `triangles`. Which
    // triangle a point of a facet belongs to, facet_tree tells. A mesh without any rasterises its
    // triangles.
    std::vector<glm::uvec3> facets;  ///< vertex indices, counter-clockwise from the front
    std::vector<std::uint32_t> facet_material;
    std::vector<FacetNode> facet_roots;
    std::vector<FacetNode> facet_tree;

    // Sides.
    std::vector<std::uint32_t> side_triangle;
    /// Linear, area mean over the side, <= 0.999; what is reflected of it, scene/material/brdf.h
    /// says.
    std::vector<glm::vec3> base_colour;
    std::vector<glm::vec3> emission;  ///< radiance, cd/m², area mean over the side
    /// Metalness and roughness of triangles, area means; empty where no material has a texture of
    /// them.
    std::vector<glm::vec2> metallic_roughness;
    /// Share of the side that alpha MASK leaves; empty where nothing is cut.
    std::vector<float> coverage;

    PatchSets patch_sets;

    [[nodiscard]] std::size_t triangle_count() const { return triangles.size(); }
    [[nodiscard]] std::size_t side_count() const { return side_triangle.size(); }
    [[nodiscard]] std::size_t patch_count() const {
        return patch_sets.empty() ? side_count() : patch_sets.first.size() - 1;
    }
    /// Patches that are fronts; those that are backs follow.
    [[nodiscard]] std::size_t front_patch_count() const {
        return patch_sets.empty() ? triangle_count() : patch_sets.front_count;
    }
    [[nodiscard]] std::uint32_t patch_of(std::uint32_t side) const {
        return patch_sets.empty() ? side : patch_sets.side_patch[side];
    }
    [[nodiscard]] PatchSides sides_of(std::uint32_t patch) const {
        return patch_sets.empty() ? PatchSides(patch) : PatchSides(patch_sets, patch);
    }
    /// Triangle of the patch's largest side.
    [[nodiscard]] std::uint32_t triangle_of(std::uint32_t patch) const {
        return side_triangle[sides_of(patch).front()];
    }
};

struct TessellationSettings {
    float patch_size = 0.0F;  ///< target edge, metres; 0: chosen for target_patches
    /// Before patches are split further near other surfaces (scene/contact/near_field.h).
    std::size_t target_patches = 25'000;
    std::size_t max_patches = 4'000'000;  ///< a larger result is an error, not a hang
    bool join_triangles = true;  ///< small ones, where there are more than target_patches / 2
};

/// Splits longest edges until none is longer than the target edge (in world space, at the objects'
/// initial transforms), and further where direct light changes beside other surfaces, without
/// T-junctions inside a mesh; joins what is smaller (scene/mesh/joins/triangle_joins.h); welds;
/// averages textures over patches. Appends to scene.notices what it did to odd input.
/// Deterministic. Throws SceneError if too large.
PatchMesh tessellate(Scene& scene, const TessellationSettings& settings = {});

}  // namespace raybundle
