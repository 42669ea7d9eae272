// SPDX-License-Identifier: Apache-2.0
#include "scene/material/alpha_blend.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "scene/material/base_colour.h"
#include "scene/material/specular_surface.h"

namespace raybundle {
namespace {

constexpr float opaque = 0.999F;  // coverage
constexpr float half_covered = 0.5F;

/// The alpha of a texture, times a factor, as one value or as a hole with an edge.
struct AlphaStatistics {
    double mean = 1.0;
    double variance = 0.0;   ///< mean squared error of the mean
    double cut_error = 0.0;  ///< of 1 from a half on, and 0 below
};

AlphaStatistics alpha_statistics(const Texture& texture, float factor) {
    std::array<std::size_t, 256> counts{};
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4) {
        ++counts[texture.rgba[i]];
    }
    const std::size_t texels = texture.rgba.size() / 4;
    AlphaStatistics result{0.0, 0.0, 0.0};
    double squares = 0.0;
    for (std::size_t value = 0; value < counts.size(); ++value) {
        const double alpha = static_cast<double>(factor) * static_cast<double>(value) / 255.0;
        const double share = static_cast<double>(counts[value]) / static_cast<double>(texels);
        const double cut = alpha >= half_covered ? alpha - 1.0 : alpha;
        result.mean += share * alpha;
        squares += share * alpha * alpha;
        result.cut_error += share * cut * cut;
    }
    result.variance = std::max(squares - result.mean * result.mean, 0.0);
    return result;
}

}  // namespace

std::optional<std::string> read_alpha_blend(std::span<const Texture> textures, Material& material) {
    if (material.unlit || material.max_phong || transmits(material) ||
        material.transmission > 0.0F) {
        return std::nullopt;
    }
    const int texture = material.base_colour_texture.texture;
    const AlphaStatistics alpha =
        texture < 0 ? AlphaStatistics{static_cast<double>(material.alpha)}
                    : alpha_statistics(textures[static_cast<std::size_t>(texture)], material.alpha);
    if (alpha.variance > alpha.cut_error) {
        material.alpha_mode = AlphaMode::mask;
        material.alpha_cutoff = half_covered;
        return "materials with alpha BLEND and a texture of alpha are cut out where it is below a "
               "half";
    }
    material.alpha = static_cast<float>(alpha.mean);
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
