// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/material/gltf_clear_coat.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf/file/gltf_image.h"
#include "scene/material/specular_surface.h"

namespace raybundle {

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
    constexpr const char* what = "clear coats";
    const float factor = number_or(*coat, "clearcoatFactor", 0.0F) *
                         mean_of_channel(document, *coat, "clearcoatTexture", 0, what);
    const float roughness = number_or(*coat, "clearcoatRoughnessFactor", 0.0F) *
                            mean_of_channel(document, *coat, "clearcoatRoughnessTexture", 1, what);
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
