// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/effect_removal.h"

#include <cmath>

#include "scene/material/specular_surface.h"

namespace raybundle {
namespace {

void remove_gloss(Scene& scene) {
    for (Material& material : scene.materials) {
        material.max_phong.reset();
        material.clear_coat = 0.0F;
        material.metallic = 0.0F;
        material.specular = 0.0F;
    }
}

/// Mirrors and polished surfaces become the glossy ones next to them.
void remove_mirrors(Scene& scene) {
    for (Material& material : scene.materials) {
        const SpecularKind kind = specular_kind(material);
        if (kind == SpecularKind::mirror ||
            (kind == SpecularKind::coat && shows_smooth_lobe(material))) {
            material.roughness = std::nextafter(mirror_roughness, 1.0F);
        }
    }
}

void remove_normal_maps(Scene& scene) {
    for (Material& material : scene.materials) {
        material.normal_texture.texture = -1;
    }
}

void remove_textures(Scene& scene, PatchMesh& mesh) {
    scene.textures.clear();
    remove_normal_maps(scene);
    mesh.metallic_roughness.clear();
    for (Material& material : scene.materials) {
        material.base_colour_texture.texture = -1;
        material.emission_texture.texture = -1;
        material.metallic_roughness_texture.texture = -1;
        material.alpha_mode = AlphaMode::opaque;
    }
    mesh.coverage.clear();
}

}  // namespace

bool remove_effect(std::string_view name, Scene& scene, PatchMesh& mesh) {
    if (name == "glossy") {
        remove_gloss(scene);
    } else if (name == "specular-reflection" && !has_glass(scene)) {
        remove_mirrors(scene);
    } else if (name == "refraction") {
        for (Material& material : scene.materials) {
            material.transmission = 0.0F;
        }
    } else if (name == "textures") {
        remove_textures(scene, mesh);
    } else if (name == "normal-maps") {
        remove_normal_maps(scene);
    } else if (name == "diffuse-transmission") {
        for (Material& material : scene.materials) {
            material.transmittance = glm::vec3(0.0F);
        }
    } else if (name == "clear-coat") {
        for (Material& material : scene.materials) {
            material.clear_coat = 0.0F;
        }
    } else if (name == "punctual-lights") {
        std::erase_if(scene.punctual_lights,
                      [](const PunctualLight& light) { return !light.of_sky; });
    } else if (name == "ies") {
        for (PunctualLight& light : scene.punctual_lights) {
            light.profile.reset();
        }
    } else if (name == "sun") {
        std::erase_if(scene.punctual_lights,
                      [](const PunctualLight& light) { return light.of_sky; });
    } else if (name == "medium") {
        scene.medium.reset();
    } else if (name == "sky" || name == "environment") {
        scene.sky_radiance = glm::vec3(0.0F);
        scene.environment.reset();
        scene.sky_light.reset();
    } else {
        return false;
    }
    return true;
}

}  // namespace raybundle
