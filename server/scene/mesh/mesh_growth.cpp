// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/mesh_growth.h"

#include <algorithm>
#include <utility>

namespace raybundle {
namespace {

constexpr std::uint32_t none = PatchMesh::no_patch;

/// Numbers that a part gives to what it takes of a whole; none for the rest.
using Numbers = std::vector<std::uint32_t>;

template <typename T>
void insert(std::vector<T>& to, std::size_t at, const std::vector<T>& from, std::size_t first,
            std::size_t end) {
    to.insert(to.begin() + static_cast<std::ptrdiff_t>(at),
              from.begin() + static_cast<std::ptrdiff_t>(first),
              from.begin() + static_cast<std::ptrdiff_t>(end));
}

/// What one mesh has for each item and the other has not is filled up first.
template <typename T>
void fill(std::vector<T>& values, std::size_t count, const T& value) {
    if (values.empty()) {
        values.assign(count, value);
    }
}

FacetNode with_triangles(FacetNode node, const Numbers& triangle) {
    node.first = triangle[node.first];
    return node;
}

/// Copies a tree below a root, its triangles by other numbers.
FacetNode copy_tree(const std::vector<FacetNode>& from, const FacetNode& root,
                    const Numbers& triangle, std::vector<FacetNode>& to) {
    if ((root.code & FacetNode::leaf_bit) != 0) {
        return with_triangles(root, triangle);
    }
    const FacetNode copy{root.code, static_cast<std::uint32_t>(to.size())};
    to.resize(to.size() + FacetNode::exits);
    for (std::uint32_t exit = 0; exit < FacetNode::exits; ++exit) {
        const FacetNode below = copy_tree(from, from[root.first + exit], triangle, to);
        to[copy.first + exit] = below;
    }
    return copy;
}

/// Patches as sets of sides, also where each side is one.
PatchSets sets_of(const PatchMesh& mesh) {
    if (!mesh.patch_sets.empty()) {
        return mesh.patch_sets;
    }
    PatchSets sets;
    sets.front_count = mesh.triangle_count();
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        sets.side_patch.push_back(side);
        sets.members.push_back(side);
        sets.first.push_back(side);
    }
    sets.first.push_back(static_cast<std::uint32_t>(mesh.side_count()));
    return sets;
}

/// Members of each patch by the patches of sides, the largest first as they are in `order`.
PatchSets gathered(std::vector<std::uint32_t> side_patch, std::size_t fronts,
                   const std::vector<std::uint32_t>& order) {
    PatchSets sets;
    const std::uint32_t count =
        side_patch.empty() ? 0 : *std::max_element(side_patch.begin(), side_patch.end()) + 1;
    std::vector<std::vector<std::uint32_t>> members(count);
    for (const std::uint32_t side : order) {
        members[side_patch[side]].push_back(side);
    }
    for (const auto& own : members) {
        sets.first.push_back(static_cast<std::uint32_t>(sets.members.size()));
        sets.members.insert(sets.members.end(), own.begin(), own.end());
    }
    sets.first.push_back(static_cast<std::uint32_t>(sets.members.size()));
    sets.side_patch = std::move(side_patch);
    sets.front_count = fronts;
    return sets;
}

/// Sides of the whole mesh that the addition's and the mesh's own ones become.
struct SideNumbers {
    std::size_t fronts, added_fronts, backs;

    [[nodiscard]] std::uint32_t own(std::uint32_t side) const {
        return side < fronts ? side : static_cast<std::uint32_t>(side + added_fronts);
    }
    [[nodiscard]] std::uint32_t added(std::uint32_t side) const {
        return static_cast<std::uint32_t>(side < added_fronts ? fronts + side
                                                              : fronts + backs + side);
    }
};

void append_patches(const PatchMesh& addition, const SideNumbers& sides, PatchMesh& mesh) {
    if (mesh.patch_sets.empty() && addition.patch_sets.empty()) {
        return;
    }
    const PatchSets own = sets_of(mesh);
    const PatchSets more = sets_of(addition);
    const SideNumbers patches{own.front_count, more.front_count,
                              own.first.size() - 1 - own.front_count};
    std::vector<std::uint32_t> of_side(own.side_patch.size() + more.side_patch.size());
    std::vector<std::uint32_t> order;
    for (const std::uint32_t side : own.members) {
        order.push_back(sides.own(side));
        of_side[sides.own(side)] = patches.own(own.side_patch[side]);
    }
    for (const std::uint32_t side : more.members) {
        order.push_back(sides.added(side));
        of_side[sides.added(side)] = patches.added(more.side_patch[side]);
    }
    mesh.patch_sets = gathered(std::move(of_side), own.front_count + more.front_count, order);
}

void append_vertices(const PatchMesh& addition, PatchMesh& mesh) {
    if (!mesh.colours.empty() || !addition.colours.empty()) {
        fill(mesh.colours, mesh.positions.size(), glm::vec3(1.0F));
        std::vector<glm::vec3> colours = addition.colours;
        fill(colours, addition.positions.size(), glm::vec3(1.0F));
        insert(mesh.colours, mesh.colours.size(), colours, 0, colours.size());
    }
    const std::size_t count = addition.positions.size();
    insert(mesh.positions, mesh.positions.size(), addition.positions, 0, count);
    insert(mesh.normals, mesh.normals.size(), addition.normals, 0, count);
    insert(mesh.uvs, mesh.uvs.size(), addition.uvs, 0, count);
    insert(mesh.vertex_object, mesh.vertex_object.size(), addition.vertex_object, 0, count);
}

/// Facets of a mesh: its triangles where it has no others.
void make_facets(PatchMesh& mesh) {
    if (mesh.facets.empty()) {
        mesh.facets = mesh.triangles;
        mesh.facet_material = mesh.triangle_material;
        for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
            mesh.facet_roots.push_back(FacetNode::leaf(t));
        }
    }
}

/// Adds the corners of an addition, whose vertices come behind those that are there.
void append_corners(const std::vector<glm::uvec3>& corners, std::uint32_t first_vertex,
                    std::vector<glm::uvec3>& to) {
    for (const glm::uvec3& corner : corners) {
        to.push_back(corner + first_vertex);
    }
}

void append_facets(PatchMesh addition, std::uint32_t first_vertex, std::uint32_t first_triangle,
                   PatchMesh& mesh) {
    if (mesh.facets.empty() && addition.facets.empty()) {
        return;
    }
    make_facets(mesh);
    make_facets(addition);
    append_corners(addition.facets, first_vertex, mesh.facets);
    insert(mesh.facet_material, mesh.facet_material.size(), addition.facet_material, 0,
           addition.facet_material.size());
    Numbers triangle(addition.triangle_count());
    for (std::uint32_t t = 0; t < triangle.size(); ++t) {
        triangle[t] = first_triangle + t;
    }
    for (const FacetNode& root : addition.facet_roots) {
        mesh.facet_roots.push_back(copy_tree(addition.facet_tree, root, triangle, mesh.facet_tree));
    }
}

/// Of triangles of a mesh without textures of it.
std::vector<glm::vec2> metallic_roughness_of(const PatchMesh& mesh, const Scene& scene) {
    std::vector<glm::vec2> values;
    for (const std::uint32_t material : mesh.triangle_material) {
        values.emplace_back(scene.materials[material].metallic,
                            scene.materials[material].roughness);
    }
    return values;
}

/// Sides: new fronts come behind the old ones, new backs behind the old ones.
void append_sides(const PatchMesh& addition, const SideNumbers& sides, PatchMesh& mesh) {
    const std::size_t added = addition.side_count();
    const std::size_t fronts = sides.added_fronts;
    const auto append_values = [&](auto& to, const auto& from) {
        insert(to, to.size(), from, fronts, added);
        insert(to, sides.fronts, from, 0, fronts);
    };
    if (!mesh.coverage.empty() || !addition.coverage.empty()) {
        fill(mesh.coverage, mesh.side_count(), 1.0F);
        std::vector<float> coverage = addition.coverage;
        fill(coverage, added, 1.0F);
        append_values(mesh.coverage, coverage);
    }
    append_values(mesh.base_colour, addition.base_colour);
    append_values(mesh.emission, addition.emission);
    std::vector<std::uint32_t> triangles = addition.side_triangle;
    for (std::uint32_t& triangle : triangles) {
        triangle += static_cast<std::uint32_t>(sides.fronts);
    }
    append_values(mesh.side_triangle, triangles);
    for (std::uint32_t& back : mesh.back_side) {
        back = back == none ? none : sides.own(back);
    }
    for (const std::uint32_t back : addition.back_side) {
        mesh.back_side.push_back(back == none ? none : sides.added(back));
    }
}

}  // namespace

void append(const PatchMesh& addition, const Scene& scene, PatchMesh& mesh) {
    const SideNumbers sides{mesh.triangle_count(), addition.triangle_count(),
                            mesh.side_count() - mesh.triangle_count()};
    const auto first_vertex = static_cast<std::uint32_t>(mesh.positions.size());
    const auto first_triangle = static_cast<std::uint32_t>(mesh.triangle_count());
    append_patches(addition, sides, mesh);
    append_facets(addition, first_vertex, first_triangle, mesh);
    if (!mesh.metallic_roughness.empty() || !addition.metallic_roughness.empty()) {
        if (mesh.metallic_roughness.empty()) {
            mesh.metallic_roughness = metallic_roughness_of(mesh, scene);
        }
        const std::vector<glm::vec2> more = addition.metallic_roughness.empty()
                                                ? metallic_roughness_of(addition, scene)
                                                : addition.metallic_roughness;
        insert(mesh.metallic_roughness, mesh.metallic_roughness.size(), more, 0, more.size());
    }
    append_sides(addition, sides, mesh);
    append_vertices(addition, mesh);
    append_corners(addition.triangles, first_vertex, mesh.triangles);
    insert(mesh.triangle_material, mesh.triangle_material.size(), addition.triangle_material, 0,
           addition.triangle_material.size());
}

PatchMesh part_of(const PatchMesh& mesh, std::uint32_t object) {
    PatchMesh part;
    Numbers vertex(mesh.positions.size(), none);
    const auto corners_of = [&](const glm::uvec3& corners) {
        glm::uvec3 own;
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& number = vertex[corners[k]];
            if (number == none) {
                number = static_cast<std::uint32_t>(part.positions.size());
                part.positions.push_back(mesh.positions[corners[k]]);
                part.normals.push_back(mesh.normals[corners[k]]);
                part.uvs.push_back(mesh.uvs[corners[k]]);
                part.vertex_object.push_back(object);
                if (!mesh.colours.empty()) {
                    part.colours.push_back(mesh.colours[corners[k]]);
                }
            }
            own[k] = number;
        }
        return own;
    };
    Numbers triangle(mesh.triangle_count(), none);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        if (mesh.vertex_object[mesh.triangles[t].x] == object) {
            triangle[t] = static_cast<std::uint32_t>(part.triangles.size());
            part.triangles.push_back(corners_of(mesh.triangles[t]));
            part.triangle_material.push_back(mesh.triangle_material[t]);
            if (!mesh.metallic_roughness.empty()) {
                part.metallic_roughness.push_back(mesh.metallic_roughness[t]);
            }
        }
    }
    part.back_side.assign(part.triangle_count(), none);
    Numbers patch(mesh.patch_count(), none);
    Numbers side_number(mesh.side_count(), none);
    std::vector<std::uint32_t> of_side, order;
    std::uint32_t patches = 0;
    std::size_t fronts = 0;
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        if (side == mesh.triangle_count()) {
            fronts = patches;
        }
        const std::uint32_t own = triangle[mesh.side_triangle[side]];
        if (own == none) {
            continue;
        }
        if (side >= mesh.triangle_count()) {
            part.back_side[own] = static_cast<std::uint32_t>(part.side_count());
        }
        side_number[side] = static_cast<std::uint32_t>(part.side_count());
        part.side_triangle.push_back(own);
        part.base_colour.push_back(mesh.base_colour[side]);
        part.emission.push_back(mesh.emission[side]);
        if (!mesh.coverage.empty()) {
            part.coverage.push_back(mesh.coverage[side]);
        }
        std::uint32_t& number = patch[mesh.patch_of(side)];
        number = number == none ? patches++ : number;
        of_side.push_back(number);
    }
    fronts = mesh.side_count() == mesh.triangle_count() ? patches : fronts;
    if (!mesh.patch_sets.empty()) {
        for (const std::uint32_t side : mesh.patch_sets.members) {
            if (side_number[side] != none) {
                order.push_back(side_number[side]);
            }
        }
        part.patch_sets = gathered(std::move(of_side), fronts, order);
    }
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        if (mesh.vertex_object[mesh.facets[f].x] == object) {
            part.facets.push_back(corners_of(mesh.facets[f]));
            part.facet_material.push_back(mesh.facet_material[f]);
            part.facet_roots.push_back(
                copy_tree(mesh.facet_tree, mesh.facet_roots[f], triangle, part.facet_tree));
        }
    }
    return part;
}

}  // namespace raybundle
