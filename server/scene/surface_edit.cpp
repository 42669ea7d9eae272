// SPDX-License-Identifier: Apache-2.0
#include "scene/surface_edit.h"

#include <algorithm>
#include <array>

#include "scene/light/environment.h"
#include "scene/material/base_colour.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

/// What the light's material emits.
glm::vec3 emission_of(const Light& light) {
    glm::vec3 emission(0.0F);
    for (int c = 0; c < 3 && light.on; ++c) {
        emission[c] = light.texture[c] > 0.0F ? light.radiance[c] / light.texture[c] : 0.0F;
    }
    return emission;
}

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

void apply(PunctualLight& light, const LightEdit& edit) {
    PunctualSetting setting = setting_of(light);
    if (edit.colour) {
        setting.colour = *edit.colour / std::max(luminance(*edit.colour), 1e-30F);
    }
    if (edit.intensity || edit.colour) {
        const float intensity =
            edit.intensity ? *edit.intensity / intensity_unit(light) : luminance(setting.intensity);
        setting.intensity = intensity * setting.colour;
    }
    setting.on = edit.on.value_or(setting.on);
    light.intensity = setting.on ? setting.intensity : glm::vec3(0.0F);
    light.setting = setting;
}

void apply(SkyLight& light, const LightEdit& edit) {
    if (edit.colour) {
        light.colour = *edit.colour / std::max(luminance(*edit.colour), 1e-30F);
    }
    if (edit.intensity || edit.colour) {
        light.intensity = edit.intensity.value_or(luminance(light.intensity)) * light.colour;
    }
    light.on = edit.on.value_or(light.on);
}

}  // namespace

std::size_t light_count(const Scene& scene) {
    return scene.lights.size() + scene.punctual_lights.size() + (scene.sky_light ? 1 : 0);
}

bool is_sky_light(const Scene& scene, std::uint32_t light) {
    return scene.sky_light && light == light_count(scene);
}

std::optional<std::size_t> punctual_index(const Scene& scene, std::uint32_t light) {
    const std::size_t first = scene.lights.size() + 1;
    const bool known = light >= first && light - first < scene.punctual_lights.size();
    return known ? std::optional(light - first) : std::nullopt;
}

std::uint32_t material_of_light(const Scene& scene, std::uint32_t light) {
    return light >= 1 && light <= scene.lights.size()
               ? static_cast<std::uint32_t>(scene.lights[light - 1].material)
               : no_material;
}

std::string problem_of(const Scene& scene, const LightEdit& edit) {
    if (punctual_index(scene, edit.light) || is_sky_light(scene, edit.light)) {
        return {};
    }
    if (edit.light < 1 || edit.light > scene.lights.size()) {
        return "no light " + std::to_string(edit.light);
    }
    const Light& light = scene.lights[edit.light - 1];
    return light.material >= 0 ? "" : "light " + std::to_string(edit.light) + " cannot be changed";
}

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

std::uint32_t apply(Scene& scene, const LightEdit& edit) {
    if (const auto punctual = punctual_index(scene, edit.light)) {
        apply(scene.punctual_lights[*punctual], edit);
        if (scene.punctual_lights[*punctual].of_sky) {
            refresh_sky(scene);
        }
        return no_material;
    }
    if (is_sky_light(scene, edit.light)) {
        apply(*scene.sky_light, edit);
        refresh_sky(scene);
        return no_material;
    }
    Light& light = scene.lights[edit.light - 1];
    const float intensity = edit.intensity.value_or(luminance(light.radiance));
    if (edit.colour) {
        light.colour = *edit.colour / std::max(luminance(*edit.colour), 1e-30F);
    }
    if (edit.intensity || edit.colour) {
        light.radiance = intensity * light.colour;
    }
    light.on = edit.on.value_or(light.on);
    const auto material = static_cast<std::uint32_t>(light.material);
    scene.materials[material].emission = emission_of(light);
    return material;
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
    for (std::size_t i = 0; i < mesh.side_count(); ++i) {
        const std::uint32_t index = mesh.triangle_material[mesh.side_triangle[i]];
        if (std::find(materials.begin(), materials.end(), index) == materials.end()) {
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
