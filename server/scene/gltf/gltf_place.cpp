// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/neighbourhood.h"

namespace raybundle {
namespace {

constexpr double half_unit_in_last_place = 0x1.0p-24;  // of single precision

struct Box {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};

    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

/// Where a piece comes from. An instance of many is one piece.
struct PieceSource {
    std::uint32_t geometry = 0, instance = 0, primitive = 0, triangle = 0;
};

class Pieces {
  public:
    Pieces(const GltfNodeTree& tree, const std::vector<NodeGeometry>& geometries,
           const std::vector<Material>& materials)
        : materials_(materials) {
        for (std::uint32_t g = 0; g < geometries.size(); ++g) {
            const NodeGeometry& geometry = geometries[g];
            for (std::uint32_t i = 0; i < geometry.node_from_mesh.size(); ++i) {
                const glm::dmat4 world =
                    geometry.in_world
                        ? glm::dmat4(1.0)
                        : tree.nodes[static_cast<std::size_t>(geometry.node)].world_from_node *
                              geometry.node_from_mesh[i];
                add(geometry, {g, i, 0, 0}, world);
            }
        }
    }

    [[nodiscard]] const std::vector<ScenePiece>& pieces() const { return pieces_; }
    [[nodiscard]] const std::vector<PieceSource>& sources() const { return sources_; }

  private:
    void add(const NodeGeometry& geometry, PieceSource source, const glm::dmat4& world) {
        const bool whole = geometry.node_from_mesh.size() > 1;
        Box all;
        ScenePiece sum;
        for (source.primitive = 0; source.primitive < geometry.primitives.size();
             ++source.primitive) {
            const PrimitiveData& data = geometry.primitives[source.primitive];
            const auto emission =
                data.material < 0
                    ? 0.0F
                    : luminance(materials_[static_cast<std::size_t>(data.material)].emission);
            for (source.triangle = 0; source.triangle < data.triangles.size(); ++source.triangle) {
                Box box;
                const ScenePiece piece = piece_of(data, source.triangle, world, emission, box);
                if (!whole) {
                    push(piece, source);
                    continue;
                }
                all.add(box.low);
                all.add(box.high);
                sum.area += piece.area;
                sum.emission += piece.emission;
            }
        }
        if (whole && sum.area > 0.0F) {
            enclose(all, sum);
            push(sum, source);
        }
    }

    ScenePiece piece_of(const PrimitiveData& data, std::uint32_t triangle, const glm::dmat4& world,
                        float emission, Box& box) {
        glm::dvec3 p[3];
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& at = data.positions[data.triangles[triangle][k]];
            p[k] = glm::dvec3(world * glm::dvec4(glm::dvec3(at), 1.0));
            box.add(p[k]);
        }
        ScenePiece piece;
        piece.area = static_cast<float>(0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
        piece.emission = emission * piece.area;
        enclose(box, piece);
        return piece;
    }

    /// Single precision is enough for distances, counted from the first piece.
    void enclose(const Box& box, ScenePiece& piece) {
        if (pieces_.empty()) {
            base_ = box.low;
        }
        piece.centre = glm::vec3(0.5 * (box.low + box.high) - base_);
        piece.radius = static_cast<float>(0.5 * glm::length(box.high - box.low));
    }

    void push(const ScenePiece& piece, const PieceSource& source) {
        pieces_.push_back(piece);
        sources_.push_back(source);
    }

    const std::vector<Material>& materials_;
    glm::dvec3 base_{0.0};
    std::vector<ScenePiece> pieces_;
    std::vector<PieceSource> sources_;
};

std::string name_of(const GltfDocument& document, const GltfNodeTree& tree,
                    const NodeGeometry& geometry) {
    const std::string& node = tree.nodes[static_cast<std::size_t>(geometry.node)].name;
    const std::string& mesh = item(document.model().meshes, geometry.mesh).name;
    return !node.empty()   ? "'" + node + "'"
           : !mesh.empty() ? "'" + mesh + "'"
                           : item_path("nodes", geometry.node);
}

/// Removes the marked triangles and instances, and geometries of which nothing is left.
void remove(const std::vector<PieceSource>& strays, std::vector<NodeGeometry>& geometries) {
    // Last ones first, so that the numbers of the others stay.
    for (auto stray = strays.rbegin(); stray != strays.rend(); ++stray) {
        NodeGeometry& geometry = geometries[stray->geometry];
        if (geometry.node_from_mesh.size() > 1) {
            geometry.node_from_mesh[stray->instance] = glm::dmat4(0.0);  // marked
            continue;
        }
        std::vector<glm::uvec3>& triangles = geometry.primitives[stray->primitive].triangles;
        triangles[stray->triangle] = glm::uvec3(NodeGeometry::no_vertex);
    }
    for (NodeGeometry& geometry : geometries) {
        std::erase(geometry.node_from_mesh, glm::dmat4(0.0));
        for (PrimitiveData& data : geometry.primitives) {
            std::erase(data.triangles, glm::uvec3(NodeGeometry::no_vertex));
        }
    }
    std::erase_if(geometries,
                  [](const NodeGeometry& geometry) { return geometry.triangle_count() == 0; });
}

/// Names the nodes of what is left out: a handful.
void note_strays(GltfDocument& document, const GltfNodeTree& tree, const Pieces& all,
                 const std::vector<std::size_t>& strays,
                 const std::vector<NodeGeometry>& geometries) {
    constexpr std::size_t most_names = 5;
    std::vector<std::string> names;
    for (const std::size_t i : strays) {
        const std::string name = name_of(document, tree, geometries[all.sources()[i].geometry]);
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(name);
        }
    }
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    const std::string more =
        names.size() > most_names ? fmt::format(" and {} more", names.size() - most_names) : "";
    const ScenePiece& first = all.pieces()[strays.front()];
    std::size_t kept = 0;  // a piece that is not stray
    while (kept < strays.size() && strays[kept] == kept) {
        ++kept;
    }
    document.note(fmt::format(
        "left out, too far away and too small to matter: {} of {} pieces, in {}{}; the first is "
        "{:.3g} m away",
        strays.size(), all.pieces().size(), text, more,
        glm::distance(first.centre, all.pieces()[kept].centre)));
}

void leave_out_strays(GltfDocument& document, const GltfNodeTree& tree, const Scene& scene,
                      std::vector<NodeGeometry>& geometries) {
    const Pieces all(tree, geometries, scene.materials);
    const std::vector<std::size_t> strays = find_neighbourhood(all.pieces()).strays;
    if (strays.empty()) {
        return;
    }
    note_strays(document, tree, all, strays, geometries);
    std::vector<PieceSource> sources;
    for (const std::size_t i : strays) {
        sources.push_back(all.sources()[i]);
    }
    remove(sources, geometries);
}

/// Of all vertices in use, in double precision.
Box world_box(const GltfNodeTree& tree, const std::vector<NodeGeometry>& geometries) {
    Box box;
    for (const NodeGeometry& geometry : geometries) {
        const Bounds local = geometry.local_bounds();
        for (const glm::dmat4& node_from_mesh : geometry.node_from_mesh) {
            const glm::dmat4 world =
                geometry.in_world
                    ? glm::dmat4(1.0)
                    : tree.nodes[static_cast<std::size_t>(geometry.node)].world_from_node *
                          node_from_mesh;
            for (unsigned corner = 0; corner < 8; ++corner) {
                const glm::dvec3 point((corner & 1U) != 0 ? local.max.x : local.min.x,
                                       (corner & 2U) != 0 ? local.max.y : local.min.y,
                                       (corner & 4U) != 0 ? local.max.z : local.min.z);
                box.add(glm::dvec3(world * glm::dvec4(point, 1.0)));
            }
        }
    }
    return box;
}

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Meshes whose own vertices single precision has moved: the one that it has moved most.
void note_rounded_vertices(GltfDocument& document, const GltfNodeTree& tree, double tie,
                           const std::vector<NodeGeometry>& geometries) {
    std::size_t count = 0;
    double farthest = 0.0;
    const NodeGeometry* worst = nullptr;
    for (const NodeGeometry& geometry : geometries) {
        const Bounds local = geometry.local_bounds();
        const glm::dmat3 world(
            geometry.in_world
                ? glm::dmat4(1.0)
                : tree.nodes[static_cast<std::size_t>(geometry.node)].world_from_node);
        const double scale = std::cbrt(std::abs(glm::determinant(world)));
        const double away = scale * std::max(largest(local.min), largest(local.max));
        if (away * half_unit_in_last_place > tie) {
            ++count;
            if (away > farthest) {
                farthest = away;
                worst = &geometry;
            }
        }
    }
    if (worst != nullptr) {
        document.note(fmt::format(
            "the vertices of {}{} are stored {:.3g} m away from the mesh's own zero: single "
            "precision has rounded them to {:.1g} m",
            name_of(document, tree, *worst),
            count > 1 ? fmt::format(" and {} more", count - 1) : std::string(), farthest,
            2.0 * farthest * half_unit_in_last_place));
    }
}

}  // namespace

std::vector<NodeGeometry> read_placed_geometry(GltfDocument& document, GltfNodeTree& tree,
                                               float metres_per_unit, Scene& scene) {
    std::vector<NodeGeometry> geometries = read_geometry(document, tree, metres_per_unit);
    leave_out_strays(document, tree, scene, geometries);
    const Box box = world_box(tree, geometries);
    const double tie = coincidence_share * glm::length(box.high - box.low);
    const double away = std::max(largest(box.low), largest(box.high));
    if (away * half_unit_in_last_place > tie) {
        scene.origin = glm::round(0.5 * (box.low + box.high));
        take_out_offset(scene.origin, tree);
        document.note(fmt::format(
            "coordinates are counted from ({:.0f}, {:.0f}, {:.0f}) m of the file's, "
            "where single precision would move surfaces by {:.1g} m",
            scene.origin.x, scene.origin.y, scene.origin.z, away * half_unit_in_last_place));
        // Skinned vertices are in world space.
        geometries = read_geometry(document, tree, metres_per_unit);
        leave_out_strays(document, tree, scene, geometries);
    }
    note_rounded_vertices(document, tree, tie, geometries);
    return geometries;
}

}  // namespace raybundle
