// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/surface_albedo.h"

#include "scene/material/reflectance_table.h"
#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {

namespace {

/// Area-blind means of metalness and roughness over the triangles of each material.
std::vector<glm::vec2> mean_details(const Scene& scene, const PatchMesh& mesh) {
    std::vector<glm::vec2> sums(scene.materials.size());
    std::vector<float> counts(scene.materials.size());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::uint32_t material = mesh.triangle_material[t];
        sums[material] += mesh.metallic_roughness[t];
        counts[material] += 1.0F;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = counts[i] > 0.0F ? sums[i] / counts[i] : glm::vec2(0.0F, 1.0F);
    }
    return sums;
}

/// The same with all that view rays would show.
Material with_all_lobes(Material material) {
    material.clear_coat_traced = false;
    material.lobe_traced = false;
    return material;
}

AlbedoRow row_of(const ReflectanceModel& model) {
    const Brdf black = make_brdf(model, glm::vec3(0.0F));
    const Brdf white = make_brdf(model, glm::vec3(1.0F));
    const ReflectanceTable table(white);
    constexpr float white_colour = 0.999F;  // of what make_brdf() takes
    AlbedoRow row;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const glm::vec3 own = table.albedo(black, albedo_cosine(i));
        const glm::vec3 all = table.albedo(white, albedo_cosine(i));
        row[i] = glm::vec4(own, glm::max(all.g - own.g, 0.0F) / white_colour);
    }
    return row;
}

/// Glass reflects as a surface without a colour.
AlbedoRow glass_row(const SpecularSurface& glass) {
    AlbedoRow row;
    for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = glm::vec4(pane_shares(glass, albedo_cosine(i)).reflected, 0.0F);
    }
    return row;
}

std::optional<AlbedoRow> row_of(const Scene& scene, std::size_t index,
                                const std::vector<glm::vec2>& details) {
    const Material material = with_all_lobes(scene.materials[index]);
    if (material.unlit) {
        return std::nullopt;
    }
    if (is_glass(material)) {
        return glass_row(specular_surface(material, mean_base_colour(scene, material)));
    }
    const bool own = !details.empty() && material.metallic_roughness_texture.texture >= 0;
    const ReflectanceModel model =
        own ? reflectance_model(material, details[index]) : reflectance_model(material);
    return model.lobe.kind != LobeKind::none ? std::optional(row_of(model)) : std::nullopt;
}

std::vector<glm::vec2> details_of(const Scene& scene, const PatchMesh& mesh) {
    return mesh.metallic_roughness.empty() ? std::vector<glm::vec2>() : mean_details(scene, mesh);
}

}  // namespace

std::vector<std::optional<AlbedoRow>> surface_albedos(const Scene& scene, const PatchMesh& mesh) {
    const std::vector<glm::vec2> details = details_of(scene, mesh);
    std::vector<std::optional<AlbedoRow>> rows(scene.materials.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i] = row_of(scene, i, details);
    }
    return rows;
}

std::optional<AlbedoRow> surface_albedo(const Scene& scene, const PatchMesh& mesh,
                                        std::size_t material) {
    return row_of(scene, material, details_of(scene, mesh));
}

glm::vec3 transparency(const Scene& scene, std::size_t material) {
    const Material& m = scene.materials[material];
    if (!is_glass(m)) {
        return glm::vec3(0.0F);
    }
    const SpecularSurface glass = specular_surface(m, mean_base_colour(scene, m));
    const bool absorbs = glass.kind == SpecularKind::glass && glass.absorption != glm::vec3(0.0F);
    const float chord = absorbs ? mean_chord(scene, material) : 0.0F;
    return pane_shares(glass, 1.0F).transmitted * glm::exp(-0.5F * chord * glass.absorption);
}

}  // namespace raybundle
