// SPDX-License-Identifier: Apache-2.0
#include "scene/alpha_blend.h"

#include <cstddef>
#include <cstdint>

#include "scene/base_colour.h"
#include "scene/specular_surface.h"

namespace raybundle {
namespace {

constexpr float opaque = 0.999F;  // coverage
constexpr float half_covered = 0.5F;
constexpr std::uint8_t whole = 255;

bool has_alpha(std::span<const Texture> textures, const TextureSlot& slot) {
    if (slot.texture < 0) {
        return false;
    }
    const std::vector<std::uint8_t>& rgba = textures[static_cast<std::size_t>(slot.texture)].rgba;
    for (std::size_t i = 3; i < rgba.size(); i += 4) {
        if (rgba[i] != whole) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::optional<std::string> read_alpha_blend(std::span<const Texture> textures, Material& material) {
    if (material.unlit || material.max_phong || transmits(material) ||
        material.transmission > 0.0F) {
        return std::nullopt;
    }
    if (has_alpha(textures, material.base_colour_texture)) {
        material.alpha_mode = AlphaMode::mask;
        material.alpha_cutoff = half_covered;
        return "materials with alpha BLEND and a texture of alpha are cut out where it is below a "
               "half";
    }
    if (material.alpha >= opaque) {
        return std::nullopt;
    }
    const float through = 1.0F - material.alpha;
    material.metallic = 0.0F;
    material.metallic_roughness_texture = {};
    if (material.alpha < half_covered && material.emission == glm::vec3(0.0F)) {
        material.base_colour = glm::vec3(through);
        material.base_colour_texture = {};
        material.transmission = 1.0F;
        material.ior = 1.0F;
        material.roughness = 0.0F;
        material.thickness = 0.0F;
        return "materials with alpha BLEND below a half are clear panes that let 1 - alpha through";
    }
    material.transmittance = glm::vec3(max_albedo * through);
    material.base_colour *= material.alpha;
    material.specular = 0.0F;
    material.double_sided = true;
    return "materials with alpha BLEND of a half or more let 1 - alpha through diffusely, like a "
           "veil";
}

}  // namespace raybundle
