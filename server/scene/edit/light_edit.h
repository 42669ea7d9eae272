// SPDX-License-Identifier: Apache-2.0
// Changes of lights while a scene is being shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// A light as it shall be; what is absent stays.
struct LightEdit {
    /// Light::id; punctual lights are numbered after the others, and the sky after these.
    std::uint32_t light = 0;
    /// >= 0: cd/m², or times intensity_unit() of a punctual light, or as SkyLight has it. Of full
    /// light: LightControl::dim does not count.
    std::optional<float> intensity;
    std::optional<glm::vec3> colour;  ///< linear, >= 0, not black; scaled to luminance 1
    std::optional<bool> on;
    std::optional<float> dim;                 ///< as in LightControl
    std::optional<std::string> group;         ///< likewise
    std::optional<float> maintenance_factor;  ///< likewise
    /// Likewise; 0: as the photometric file states it, also where that is exchanged.
    std::optional<float> colour_rendering;
    /// Of punctual lights that no object carries: in the world, m.
    std::optional<glm::vec3> position;
    std::optional<glm::vec3> aim;   ///< not 0
    std::optional<float> rotation;  ///< about the aim, as in LightPlace, degrees
    /// Of spots: half of the angles of the cones, degrees; the inner one is no wider.
    std::optional<float> inner_cone, outer_cone;
    /// Of points and spots: a file of Scene::folder, with the flux that it has; empty: as loaded.
    std::optional<std::string> photometry;
};

/// Why an edit cannot be made, e.g. "no light 7"; empty where it can. Numbers are taken to be in
/// range.
std::string problem_of(const Scene& scene, const LightEdit& edit);

/// Index of a punctual light by its number; nothing for other numbers.
std::optional<std::size_t> punctual_index(const Scene& scene, std::uint32_t light);

/// The number of a punctual light.
std::uint32_t punctual_number(const Scene& scene, std::size_t index);

/// Numbers of all lights that have not been removed. Those of the scene's file and its sky have
/// numbers from 1 on, others from first_added_light on.
std::vector<std::uint32_t> light_numbers(const Scene& scene);
constexpr std::uint32_t first_added_light = 1'000'001;
/// Whether some light has this number, or had it before it was removed.
bool has_light(const Scene& scene, std::uint32_t light);
/// Whether a number is the sky's.
bool is_sky_light(const Scene& scene, std::uint32_t light);

/// Of a light that is no surface.
constexpr std::uint32_t no_material = 0xffffffff;

/// Index of the material that emits a light's light, or no_material. light: a number without
/// problem.
std::uint32_t material_of_light(const Scene& scene, std::uint32_t light);

/// What a light has beside its light; null for the sky. light: a number without problem.
const LightControl* control_of(const Scene& scene, std::uint32_t light);

/// Whether a number is that of a light that can be changed, and neither the sky nor one of its
/// suns, which go by the day.
bool is_lamp(const Scene& scene, std::uint32_t light);
/// What a lamp shines with, dimmed and switched as it is: PunctualLight::intensity, or
/// Material::emission of the surface. light: a number for which is_lamp().
glm::vec3 lamp_output(const Scene& scene, std::uint32_t light);
/// Has a lamp shine otherwise, whatever it is set to.
void set_lamp_output(Scene& scene, std::uint32_t light, const glm::vec3& output);

/// Luminous flux in lm of an intensity of 1, in the light's own unit; 0 where lights have none, as
/// the sky. light: a number without problem.
double flux_per_intensity(const Scene& scene, std::uint32_t light);

/// Makes an edit without problem. Returns the index of the material that has changed, or
/// no_material.
std::uint32_t apply(Scene& scene, const LightEdit& edit);

/// Of each punctual light the cosine of its outer cone, 0 where it is no spot. A spot with another
/// one may need another kind of shadow map.
std::vector<float> outer_cones(const Scene& scene);
/// Whether lights that were there before have the cones that they had.
bool same_cones(const Scene& scene, const std::vector<float>& before);

/// A light's intensity as it shines, from how it is set, dimmed, switched and whether it is there.
void refresh_intensity(PunctualLight& light);

}  // namespace raybundle
