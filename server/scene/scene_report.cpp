// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "scene/significant.h"

namespace raybundle {
namespace {

constexpr float largest_plausible = 1000.0F;  // m
constexpr float largest_building = 100.0F;    // m, its height too
constexpr float smallest_building = 2.0F;     // m, so that one can stand in it
constexpr float smallest_plausible = 0.01F;   // m

struct Unit {
    const char* name;
    float metres;
};
constexpr Unit smaller_units[] = {{"ft", 0.3048F}, {"in", 0.0254F}, {"cm", 0.01F}, {"mm", 0.001F}};

double triangle_area(const Scene& scene, const Triangle& triangle, const glm::dmat4& world) {
    glm::dvec3 p[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = world * glm::dvec4(glm::dvec3(scene.vertices[triangle.vertex[k]].position), 1.0);
    }
    return 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
}

}  // namespace

std::optional<std::string> unit_hint(const Bounds& bounds) {
    const glm::vec3 extent = bounds.extent();
    const float size = std::max({extent.x, extent.y, extent.z});
    if (size > largest_plausible || extent.y > largest_building) {
        // Its size alone does not tell a hall drawn in centimetres from a room in millimetres.
        std::string units;
        for (const Unit& unit : smaller_units) {
            const float metres = size * unit.metres;
            const bool fits = metres <= largest_building && metres >= smallest_building;
            if (fits || (units.empty() && &unit == std::end(smaller_units) - 1)) {
                units += fmt::format("{}--unit {} ({:.4g} m)", units.empty() ? "" : ", ", unit.name,
                                     metres);
            }
        }
        return fmt::format(
            "the scene is {} m large and {} m high: if it was drawn in another unit, try {}",
            significant(static_cast<double>(size), 4),
            significant(static_cast<double>(extent.y), 4), units);
    }
    if (size < smallest_plausible && size > 0.0F) {
        return fmt::format(
            "the scene is only {:.4g} m large: if its file is not in the unit that "
            "--unit names, try --unit m",
            size);
    }
    return std::nullopt;
}

SceneReport make_scene_report(const Scene& scene, const PatchMesh& mesh) {
    SceneReport report;
    std::vector<bool> referenced(scene.vertices.size(), false);
    std::vector<glm::dmat4> world;
    for (const Object& object : scene.objects) {
        world.emplace_back(object.world_from_object());
    }
    for (const Triangle& triangle : scene.triangles) {
        for (const std::uint32_t vertex : triangle.vertex) {
            report.referenced_vertices += referenced[vertex] ? 0 : 1;
            referenced[vertex] = true;
        }
        report.area += triangle_area(scene, triangle, world[triangle.object]);
    }
    for (const Material& material : scene.materials) {
        report.textured_materials += material.base_colour_texture.texture >= 0 ? 1 : 0;
        report.double_sided_materials += material.double_sided ? 1 : 0;
    }
    for (const Texture& texture : scene.textures) {
        report.texture_bytes += texture.rgba.size();
    }
    report.edges = count_edge_defects(scene);
    report.unit_hint = unit_hint(scene.bounds);
    report.enclosed = find_enclosed_lights(scene);
    report.patches = mesh.patch_count();
    report.patch_triangles = mesh.triangle_count();
    report.patch_vertices = mesh.positions.size();
    for (std::uint32_t patch = 0; patch < mesh.front_patch_count(); ++patch) {
        const std::size_t sides = mesh.sides_of(patch).size();
        report.joined_triangles += sides > 1 ? sides : 0;
        report.joined_patches += sides > 1 ? 1 : 0;
    }
    return report;
}

}  // namespace raybundle
