// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/material/gltf_transmission.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf/file/gltf_image.h"
#include "scene/material/base_colour.h"
#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {

void read_transmission(GltfDocument& document, const tinygltf::Material& source,
                       Material& material) {
    if (const auto* transmission =
            find_extension(source.extensions, "KHR_materials_transmission")) {
        const float factor =
            std::clamp(number_or(*transmission, "transmissionFactor", 0.0F), 0.0F, 1.0F);
        material.transmission =
            factor > 0.0F ? factor * mean_of_channel(document, *transmission, "transmissionTexture",
                                                     0, "transmission")
                          : 0.0F;
    }
    if (const auto* volume = find_extension(source.extensions, "KHR_materials_volume")) {
        material.thickness = std::max(number_or(*volume, "thicknessFactor", 0.0F), 0.0F);
        material.attenuation_colour = vector_or(*volume, "attenuationColor", glm::vec3(1.0F));
        material.attenuation_distance = number_or(*volume, "attenuationDistance", 0.0F);
    }
    if (!is_glass(material)) {
        return;
    }
    if (material.roughness > mirror_roughness) {
        document.note("glass is read as smooth");
    }
    if (material.transmission < 1.0F) {
        document.note(
            "glass that transmits a part of the light, at least half, does not scatter the rest");
    }
}

void read_diffuse_transmission(GltfDocument& document, const tinygltf::Material& source,
                               Material& material) {
    const auto* extension = find_extension(source.extensions, "KHR_materials_diffuse_transmission");
    if (extension == nullptr || material.unlit || material.max_phong) {
        return;
    }
    const float factor = number_or(*extension, "diffuseTransmissionFactor", 0.0F);
    const glm::vec3 colour =
        vector_or(*extension, "diffuseTransmissionColorFactor", glm::vec3(1.0F));
    if (extension->Has("diffuseTransmissionTexture") ||
        extension->Has("diffuseTransmissionColorTexture")) {
        document.note(
            "textures of KHR_materials_diffuse_transmission are ignored, its factors are used");
    }
    if (factor <= 0.0F || colour == glm::vec3(0.0F)) {
        return;
    }
    document.note("surfaces that transmit light diffusely are thin, without gloss");
    material.transmittance = max_albedo * factor * glm::clamp(colour, 0.0F, 1.0F);
    material.base_colour =
        glm::min((1.0F - factor) * material.base_colour, max_albedo - material.transmittance);
    material.metallic = 0.0F;
    material.specular = 0.0F;
    material.metallic_roughness_texture = {};
    material.double_sided = true;
}

void spread_part_transmission(GltfDocument& document, const Scene& scene, Material& material) {
    const float share = material.transmission * (1.0F - std::clamp(material.metallic, 0.0F, 1.0F));
    if (share <= 0.0F || is_glass(material) || transmits(material) || material.unlit ||
        material.max_phong) {
        return;
    }
    document.note(
        "materials that transmit less than half of the light send it diffusely from their other "
        "side, like a veil, without gloss");
    SpecularSurface pane;
    pane.kind = SpecularKind::pane;
    pane.ior = std::max(material.ior, 1.0F);
    const glm::vec3 colour = glm::clamp(mean_base_colour(scene, material), 0.0F, 1.0F);
    glm::vec3 passing = share * pane_shares(pane, 1.0F).transmitted * colour;
    if (material.thickness > 0.0F) {
        passing = glm::sqrt(passing);  // through a body light passes two boundaries
    }
    material.transmittance = max_albedo * passing;
    material.base_colour =
        glm::min((1.0F - share) * material.base_colour, max_albedo - material.transmittance);
    material.transmission = 0.0F;
    material.metallic = 0.0F;
    material.specular = 0.0F;
    material.metallic_roughness_texture = {};
    material.double_sided = true;
}

}  // namespace raybundle
