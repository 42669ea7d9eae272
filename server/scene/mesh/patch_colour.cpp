// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/patch_colour.h"

#include <optional>

#include "scene/material/base_colour.h"
#include "scene/material/texture_mean.h"

namespace raybundle {
namespace {

const Texture* texture_of(const Scene& scene, const TextureSlot& slot) {
    return slot.texture < 0 ? nullptr : &scene.textures[static_cast<std::size_t>(slot.texture)];
}

glm::vec2 patch_metallic_roughness(const Scene& scene, const Material& material,
                                   const std::array<glm::vec2, 3>& mesh_uv) {
    const glm::vec2 factors(material.metallic, material.roughness);
    const TextureSlot& slot = material.metallic_roughness_texture;
    const Texture* texture = texture_of(scene, slot);
    if (texture == nullptr) {
        return factors;
    }
    const glm::vec3 mean = texture_data_mean(*texture, slot.uv_from_mesh_uv, mesh_uv);
    return factors * glm::vec2(mean.b, mean.g);
}

}  // namespace

std::optional<float> texture_alpha_cutoff(const Material& material) {
    if (material.alpha_mode != AlphaMode::mask) {
        return std::nullopt;
    }
    return material.alpha > 0.0F ? material.alpha_cutoff / material.alpha : 2.0F;
}

PatchColour patch_colour(const Scene& scene, const Material& material,
                         const std::array<glm::vec2, 3>& mesh_uv, const glm::vec3& factor) {
    PatchColour result;
    glm::vec3 colour = material.base_colour * factor;
    const std::optional<float> cutoff = texture_alpha_cutoff(material);
    if (const Texture* texture = texture_of(scene, material.base_colour_texture)) {
        const TextureMean mean =
            texture_mean(*texture, material.base_colour_texture.uv_from_mesh_uv, mesh_uv, cutoff);
        colour *= mean.colour;
        result.coverage = mean.coverage;
    } else if (cutoff && *cutoff > 1.0F) {
        result.coverage = 0.0F;
    }
    result.metallic_roughness = patch_metallic_roughness(scene, material, mesh_uv);
    if (material.unlit) {
        return result;
    }
    result.base_colour = clamped_base_colour(colour);
    result.was_clamped = exceeds_max_albedo(colour);
    result.emission = patch_emission(scene, material, mesh_uv);
    return result;
}

bool varies_by_texture(const Material& material) {
    return material.base_colour_texture.texture >= 0 || material.emission_texture.texture >= 0 ||
           material.metallic_roughness_texture.texture >= 0;
}

glm::vec3 mean_base_colour(const Scene& scene, const Material& material) {
    const Texture* texture = texture_of(scene, material.base_colour_texture);
    if (texture == nullptr) {
        return material.base_colour;
    }
    // The image is two triangles.
    const glm::mat3 whole(1.0F);
    const std::optional<float> cutoff = texture_alpha_cutoff(material);
    const TextureMean lower =
        texture_mean(*texture, whole, {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}, cutoff);
    const TextureMean upper =
        texture_mean(*texture, whole, {glm::vec2(1, 1), glm::vec2(0, 1), glm::vec2(1, 0)}, cutoff);
    const float covered = lower.coverage + upper.coverage;
    if (covered <= 0.0F) {
        return material.base_colour;
    }
    return material.base_colour *
           ((lower.colour * lower.coverage + upper.colour * upper.coverage) / covered);
}

glm::vec3 patch_emission(const Scene& scene, const Material& material,
                         const std::array<glm::vec2, 3>& mesh_uv) {
    const Texture* texture = texture_of(scene, material.emission_texture);
    if (texture == nullptr || material.emission == glm::vec3(0.0F)) {
        return material.emission;
    }
    return material.emission *
           texture_mean(*texture, material.emission_texture.uv_from_mesh_uv, mesh_uv).colour;
}

}  // namespace raybundle
