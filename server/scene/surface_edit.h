// SPDX-License-Identifier: Apache-2.0
// Changes of lights and materials while a scene is being shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// A light as it shall be; what is absent stays.
struct LightEdit {
    /// Light::id; punctual lights are numbered after the others, and the sky after these.
    std::uint32_t light = 0;
    /// >= 0: cd/m², or times intensity_unit() of a punctual light, or as SkyLight has it.
    std::optional<float> intensity;
    std::optional<glm::vec3> colour;  ///< linear, >= 0, not black; scaled to luminance 1
    std::optional<bool> on;
};

/// A material as it shall be; what is absent stays.
struct MaterialEdit {
    std::uint32_t material = 0;            ///< index into Scene::materials plus one
    std::optional<glm::vec3> base_colour;  ///< factor of the texture where there is one, linear
    std::optional<float> roughness;        ///< 0..1
    std::optional<float> metallic;         ///< 0..1
};

/// Why an edit cannot be made, e.g. "no light 7"; empty where it can. Numbers are taken to be in
/// range.
std::string problem_of(const Scene& scene, const LightEdit& edit);
std::string problem_of(const Scene& scene, const MaterialEdit& edit);

/// Index of a punctual light by its number; nothing for other numbers.
std::optional<std::size_t> punctual_index(const Scene& scene, std::uint32_t light);

/// How many lights have numbers, from 1 on.
std::size_t light_count(const Scene& scene);
/// Whether a number is the sky's.
bool is_sky_light(const Scene& scene, std::uint32_t light);

/// Of a light that is no surface.
constexpr std::uint32_t no_material = 0xffffffff;

/// Index of the material that emits a light's light, or no_material. light: a number without
/// problem.
std::uint32_t material_of_light(const Scene& scene, std::uint32_t light);

/// Makes an edit without problem. Returns the index of the material that has changed, or
/// no_material.
std::uint32_t apply(Scene& scene, const LightEdit& edit);
std::uint32_t apply(Scene& scene, const MaterialEdit& edit);

/// Gives the patches of some materials the colours that these have now.
void refresh_surfaces(const Scene& scene, std::span<const std::uint32_t> materials,
                      PatchMesh& mesh);

}  // namespace raybundle
