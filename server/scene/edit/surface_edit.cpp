// SPDX-License-Identifier: Apache-2.0
#include "scene/edit/surface_edit.h"

#include <array>
#include <vector>

#include "scene/material/base_colour.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

PatchColour colour_of(const Scene& scene, const Material& material, const PatchMesh& mesh,
                      std::size_t patch) {
    const bool coloured = !mesh.colours.empty();
    if (!varies_by_texture(material) && !coloured && !material.unlit) {
        PatchColour plain;
        plain.base_colour = clamped_base_colour(material.base_colour);
        plain.emission = material.emission;
        plain.metallic_roughness = glm::vec2(material.metallic, material.roughness);
        return plain;
    }
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[patch]];
    const glm::vec3 factor =
        coloured ? (mesh.colours[t.x] + mesh.colours[t.y] + mesh.colours[t.z]) / 3.0F
                 : glm::vec3(1.0F);
    return patch_colour(scene, material, {mesh.uvs[t.x], mesh.uvs[t.y], mesh.uvs[t.z]}, factor);
}

}  // namespace

std::string problem_of(const Scene& scene, const MaterialEdit& edit) {
    if (edit.material < 1 || edit.material > scene.materials.size()) {
        return "no material " + std::to_string(edit.material);
    }
    const Material& material = scene.materials[edit.material - 1];
    if (material.max_phong && (edit.roughness || edit.metallic)) {
        return "material " + std::to_string(edit.material) +
               " has a Phong lobe: neither roughness nor metallic";
    }
    if (transmits(material) && (edit.roughness || edit.metallic)) {
        return "material " + std::to_string(edit.material) +
               " transmits light: neither roughness nor metallic";
    }
    return {};
}

std::uint32_t apply(Scene& scene, const MaterialEdit& edit) {
    Material& material = scene.materials[edit.material - 1];
    material.base_colour = edit.base_colour.value_or(material.base_colour);
    if (transmits(material)) {
        material.base_colour = glm::min(material.base_colour, max_albedo - material.transmittance);
    }
    material.roughness = edit.roughness.value_or(material.roughness);
    material.metallic = edit.metallic.value_or(material.metallic);
    return edit.material - 1;
}

void refresh_surfaces(const Scene& scene, std::span<const std::uint32_t> materials,
                      PatchMesh& mesh) {
    std::vector<bool> changed(scene.materials.size(), false);
    for (const std::uint32_t material : materials) {
        changed[material] = true;
    }
    for (std::size_t i = 0; i < mesh.side_count(); ++i) {
        const std::uint32_t index = mesh.triangle_material[mesh.side_triangle[i]];
        if (!changed[index]) {
            continue;
        }
        const PatchColour colour = colour_of(scene, scene.materials[index], mesh, i);
        mesh.base_colour[i] = colour.base_colour;
        mesh.emission[i] = colour.emission;
        if (!mesh.metallic_roughness.empty()) {
            mesh.metallic_roughness[mesh.side_triangle[i]] = colour.metallic_roughness;
        }
    }
}

}  // namespace raybundle
