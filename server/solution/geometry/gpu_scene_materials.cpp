// SPDX-License-Identifier: Apache-2.0
// Materials and what patches have of them: base colour, emission and textures, gloss, and what is
// not lit or is transmitted.
#include <algorithm>
#include <array>
#include <bit>

#include "scene/material/ggx_albedo.h"
#include "scene/material/normal_map.h"
#include "scene/mesh/patch_colour.h"
#include "scene/mesh/patch_means.h"
#include "solution/geometry/gpu_scene.h"
#include "solution/geometry/texture_levels.h"

namespace raybundle {
namespace {

// One fact, two languages.
static_assert(min_roughness == static_cast<float>(MIN_ROUGHNESS));
static_assert(least_view_cosine == LEAST_VIEW_COSINE && least_map_height == LEAST_MAP_HEIGHT);
static_assert(unlit_white == static_cast<float>(UNLIT_WHITE));

bool has_details(const Material& material) {
    return has_reflectance_grid(material) || material.normal_texture.texture >= 0 || material.unlit;
}

/// Rows of the slot's transform.
std::array<glm::vec4, 2> uv_rows(const TextureSlot& slot) {
    const glm::mat3& m = slot.uv_from_mesh_uv;
    return {glm::vec4(m[0][0], m[1][0], m[2][0], 0.0F), glm::vec4(m[0][1], m[1][1], m[2][1], 0.0F)};
}

}  // namespace

layout::MaterialData GpuScene::material_data(const Scene& scene, std::size_t index) const {
    const Material& material = scene.materials[index];
    layout::MaterialData data{};
    const bool transparent = is_glass(material);
    const BundleGlass glass = bundle_glass(scene, index);
    data.base_colour = glm::vec4(transparent ? glm::vec3(0.0F) : material.base_colour, 0.0F);
    data.emission = glm::vec4(material.emission / radiance_unit_, transparent ? glass.tint : 0.0F);
    const TextureSlot& slot = material.base_colour_texture;
    if (slot.texture >= 0) {
        const auto rows = uv_rows(slot);
        data.uv_row0 = rows[0];
        data.uv_row1 = rows[1];
        data.base_colour.w = texture_alpha_cutoff(material).value_or(0.0F);
        data.texture_info = texture_info_[static_cast<std::size_t>(slot.texture)];
    }
    data.uv_row0.w = glass.ior;
    data.uv_row1.w = 1.0F / glass.surfaces;
    return data;
}

layout::MaterialDetails GpuScene::material_details(const Scene& scene, std::size_t material) const {
    const Material& source = scene.materials[material];
    layout::MaterialDetails details{};
    details.factors = glm::vec4(source.metallic, source.roughness, source.normal_scale,
                                source.unlit ? 1.0F : 0.0F);
    if (const std::optional<ReflectanceGrid>& grid = reflectance_.grid(material)) {
        const TextureSlot& slot = source.metallic_roughness_texture;
        const auto rows = uv_rows(slot);
        details.grid = grid->parameters();
        details.grid_levels = glm::uvec4(grid->roughness_levels, grid->metallic_levels, 0, 0);
        details.reflectance_row0 = rows[0];
        details.reflectance_row1 = rows[1];
        details.reflectance_info = texture_info_[static_cast<std::size_t>(slot.texture)];
    }
    if (const TextureSlot& slot = source.normal_texture; slot.texture >= 0) {
        const auto rows = uv_rows(slot);
        details.normal_row0 = rows[0];
        details.normal_row1 = rows[1];
        details.normal_info = texture_info_[static_cast<std::size_t>(slot.texture)];
    }
    return details;
}

void GpuScene::upload_surfaces(const PatchMesh& mesh) {
    std::vector<layout::PatchSurface> surfaces;
    surfaces.reserve(patch_count_);
    const std::vector<glm::vec3> base_colour = patch_means(mesh, mesh.base_colour);
    const std::vector<glm::vec3> emission = patch_means(mesh, mesh.emission);
    const std::vector<float> coverage = patch_means(mesh, mesh.coverage);
    const std::vector<std::uint32_t> records = reflectance_records(mesh);
    for (std::size_t i = 0; i < patch_count_; ++i) {
        surfaces.push_back({glm::vec4(reflectance_.mean_albedo(records[i], base_colour[i]),
                                      coverage.empty() ? 1.0F : coverage[i]),
                            glm::vec4(emission[i] / radiance_unit_, 0.0F)});
    }
    if (surfaces_.bytes() == 0) {
        surfaces_ = Buffer::from<layout::PatchSurface>("surfaces", surfaces);
    } else {
        surfaces_.write<layout::PatchSurface>(surfaces, 0);
    }
}

glm::vec2 GpuScene::opening_of(const Material& material) {
    const bool textured = material.base_colour_texture.texture >= 0;
    return {is_glass(material) ? 1.0F : 0.0F,
            textured ? texture_alpha_cutoff(material).value_or(0.0F) : 0.0F};
}

void GpuScene::upload_materials(const Scene& scene, const PatchMesh& mesh) {
    upload_surfaces(mesh);
    openings_.clear();
    for (const Material& material : scene.materials) {
        openings_.push_back(opening_of(material));
    }
    std::vector<bool> colours(scene.textures.size(), false);
    for (const Material& material : scene.materials) {
        if (material.base_colour_texture.texture >= 0) {
            colours[static_cast<std::size_t>(material.base_colour_texture.texture)] = true;
        }
    }
    std::vector<std::uint32_t> texels;
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& texture = scene.textures[i];
        texture_info_.emplace_back(texels.size(), texture.width, texture.height,
                                   (texture.repeat_u ? 1U : 0U) | (texture.repeat_v ? 2U : 0U));
        if (colours[i]) {
            append_colour_levels(texture, texels);
        } else {
            append_texels(texture, texels);
        }
    }
    std::vector<layout::MaterialData> materials;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        materials.push_back(material_data(scene, i));
    }
    materials_ = Buffer::from<layout::MaterialData>("materials", materials);
    texels_ = Buffer::from<std::uint32_t>("texels", texels);
}

void GpuScene::upload_reflectors(const PatchMesh& mesh) {
    if (!reflectance_.any_glossy()) {
        return;
    }
    std::vector<glm::vec4> reflectors;
    reflectors.reserve(patch_count_);
    const std::vector<glm::vec3> base_colour = patch_means(mesh, mesh.base_colour);
    const std::vector<std::uint32_t> records = reflectance_records(mesh);
    for (std::uint32_t i = 0; i < patch_count_; ++i) {
        const std::uint32_t material = mesh.triangle_material[mesh.triangle_of(i)];
        const bool glossy = reflectance_.glossy(material) && !is_bent(mesh, i);
        const std::uint32_t record = glossy ? records[i] : NOT_GLOSSY;
        reflectors.emplace_back(base_colour[i], std::bit_cast<float>(record));
    }
    if (reflectors_.bytes() > 0) {
        reflectors_.write<glm::vec4>(reflectors, 0);
        return;
    }
    reflectors_ = Buffer::from<glm::vec4>("reflectors", reflectors);
    reflector_texture_ = create_buffer_texture("reflectors", GL_RGBA32F, reflectors_);
}

void GpuScene::upload_details(const Scene& scene) {
    if (std::none_of(scene.materials.begin(), scene.materials.end(), has_details)) {
        return;
    }
    std::vector<layout::MaterialDetails> details;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        details.push_back(material_details(scene, i));
    }
    if (details_.bytes() > 0) {
        details_.write<layout::MaterialDetails>(details, 0);
        return;
    }
    details_ = Buffer::from<layout::MaterialDetails>("material details", details);
    details_texture_ = create_buffer_texture("material details", GL_RGBA32F, details_);
}

void GpuScene::upload_transmittance(const Scene& scene, const PatchMesh& mesh) {
    if (std::none_of(scene.materials.begin(), scene.materials.end(), transmits)) {
        return;
    }
    std::vector<glm::vec4> values;
    values.reserve(patch_count_);
    for (std::uint32_t i = 0; i < patch_count_; ++i) {
        const std::uint32_t triangle = mesh.triangle_of(i);
        const Material& material = scene.materials[mesh.triangle_material[triangle]];
        const std::uint32_t other =
            i < mesh.front_patch_count() ? mesh.back_side[triangle] : triangle;
        const bool through = transmits(material) && other != PatchMesh::no_patch;
        values.emplace_back(through ? material.transmittance : glm::vec3(0.0F),
                            std::bit_cast<float>(through ? mesh.patch_of(other) : NO_PATCH));
    }
    transmittance_ = Buffer::from<glm::vec4>("transmittance", values);
}

/// Of all patches.
std::vector<std::uint32_t> GpuScene::reflectance_records(const PatchMesh& mesh) const {
    const std::vector<glm::vec2> places = patch_metallic_roughness(mesh);
    std::vector<std::uint32_t> records;
    records.reserve(patch_count_);
    for (std::uint32_t i = 0; i < patch_count_; ++i) {
        const std::uint32_t material = mesh.triangle_material[mesh.triangle_of(i)];
        records.push_back(static_cast<std::uint32_t>(
            reflectance_.patch_record(material, places.empty() ? glm::vec2(0.0F) : places[i])));
    }
    return records;
}

}  // namespace raybundle
