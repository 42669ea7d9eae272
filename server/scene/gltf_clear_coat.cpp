// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_clear_coat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/gltf_image.h"
#include "scene/gltf_loader.h"
#include "scene/specular_surface.h"

namespace raybundle {
namespace {

/// Mean of a channel of a coat's texture over all its texels, 0 to 1; 1 without one that can be
/// read.
float texture_factor(GltfDocument& document, const tinygltf::Value& coat, const char* name,
                     std::size_t channel) {
    if (!coat.Has(name)) {
        return 1.0F;
    }
    try {
        const int image = image_of(document, integer_or(coat.Get(name), "index", -1));
        if (image < 0) {
            return 1.0F;
        }
        const DecodedImage decoded = decode_image(document, image);
        double sum = 0.0;
        for (std::size_t i = channel; i < decoded.rgba.size(); i += 4) {
            sum += decoded.rgba[i];
        }
        document.note("textures of clear coats are read as their means");
        const std::size_t texels = decoded.rgba.size() / 4;
        return static_cast<float>(sum / (255.0 * static_cast<double>(texels)));
    } catch (const SceneError& error) {
        document.note(fmt::format("a texture of a clear coat is ignored: {}: {}", error.json_path(),
                                  error.reason()));
        return 1.0F;
    }
}

}  // namespace

void read_clear_coat(GltfDocument& document, const tinygltf::Material& source, Material& material) {
    const auto* coat = find_extension(source.extensions, "KHR_materials_clearcoat");
    if (coat == nullptr || number_or(*coat, "clearcoatFactor", 0.0F) <= 0.0F) {
        return;
    }
    if (material.unlit || material.max_phong || material.emission != glm::vec3(0.0F) ||
        transmits(material) || is_glass(material) || source.alphaMode == "BLEND") {
        document.note(
            "clear coats over what emits, transmits light, is unlit or max-Phong are left out");
        return;
    }
    const float factor = number_or(*coat, "clearcoatFactor", 0.0F) *
                         texture_factor(document, *coat, "clearcoatTexture", 0);
    const float roughness = number_or(*coat, "clearcoatRoughnessFactor", 0.0F) *
                            texture_factor(document, *coat, "clearcoatRoughnessTexture", 1);
    material.clear_coat = std::clamp(factor, 0.0F, 1.0F);
    material.clear_coat_roughness = std::clamp(roughness, 0.0F, 1.0F);
    if (coat->Has("clearcoatNormalTexture")) {
        document.note("normal maps of clear coats are ignored: a coat follows the geometry");
    }
    // View rays do not see what alpha cuts out.
    if (material.alpha_mode == AlphaMode::mask && has_smooth_coat(material)) {
        material.clear_coat_roughness = std::nextafter(mirror_roughness, 1.0F);
        document.note("clear coats of what alpha cuts out have a roughness of 0.1 at least");
    }
}

}  // namespace raybundle
