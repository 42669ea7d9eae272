// SPDX-License-Identifier: Apache-2.0
#include "scene/edit/light_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <numeric>

#include "scene/edit/luminaire_edit.h"
#include "scene/light/environment.h"
#include "scene/light/light_place.h"
#include "scene/object_limits.h"

namespace raybundle {
namespace {

/// What the light's material emits.
glm::vec3 emission_of(const Light& light) {
    glm::vec3 emission(0.0F);
    for (int c = 0; c < 3 && light.on; ++c) {
        emission[c] = light.texture[c] > 0.0F
                          ? light.control.dim * light.radiance[c] / light.texture[c]
                          : 0.0F;
    }
    return emission;
}

void apply_control(LightControl& control, const LightEdit& edit) {
    control.dim = edit.dim.value_or(control.dim);
    control.group = edit.group.value_or(control.group);
    control.maintenance_factor = edit.maintenance_factor.value_or(control.maintenance_factor);
    if (edit.colour_rendering || edit.photometry) {
        const float set = edit.colour_rendering.value_or(0.0F);
        control.colour_rendering = set > 0.0F ? std::optional(set) : std::nullopt;
    }
}

/// What angles lose on their way through a message: a light that is set to what it is keeps its
/// bits.
constexpr float rounding = 1e-6F;
constexpr float rounding_degrees = 1e-3F;

bool differs(const std::optional<float>& cone, float cosine) {
    return cone && std::abs(*cone - glm::degrees(std::acos(cosine))) > rounding_degrees;
}

void apply_place(PunctualLight& light, const LightEdit& edit) {
    if (!edit.position && !edit.aim && !edit.rotation) {
        return;
    }
    const LightPlace now = place_of(light);
    LightPlace place = now;
    place.position = edit.position.value_or(now.position);
    place.aim = edit.aim ? glm::normalize(*edit.aim) : now.aim;
    place.rotation = edit.rotation.value_or(now.rotation);
    const bool turned = glm::length(place.aim - now.aim) > rounding ||
                        std::abs(place.rotation - now.rotation) > rounding_degrees;
    if (turned || place.position != now.position) {
        set_place(place, light);
    }
}

/// A hard edge has both cones at once: it falls within 16 roundings of a cosine.
void apply_cones(PunctualLight& light, const LightEdit& edit) {
    constexpr float min_gap = 16.0F * std::numeric_limits<float>::epsilon();
    if (differs(edit.outer_cone, light.outer_cosine)) {
        light.outer_cosine = std::min(std::cos(glm::radians(*edit.outer_cone)), 1.0F - min_gap);
    }
    if (differs(edit.inner_cone, light.inner_cosine)) {
        light.inner_cosine = std::cos(glm::radians(*edit.inner_cone));
    }
    if (edit.inner_cone || edit.outer_cone) {
        light.inner_cosine = std::max(light.inner_cosine, light.outer_cosine + min_gap);
    }
}

/// Why something that has no place of its own cannot be placed; empty where that is not asked for.
std::string place_problem(const LightEdit& edit, const std::string& subject) {
    if (edit.position || edit.aim || edit.rotation) {
        return subject + " has the place, which cannot be changed here";
    }
    if (edit.photometry) {
        return subject + " shines by no photometric file";
    }
    return edit.inner_cone || edit.outer_cone ? "only spots have cones" : "";
}

std::string problem_of(const Scene& scene, const PunctualLight& light, const LightEdit& edit) {
    if ((edit.inner_cone || edit.outer_cone) &&
        (light.kind != PunctualKind::spot || light.profile)) {
        return "only spots have cones";
    }
    if (edit.photometry) {
        if (const std::string problem = exchange_problem(scene, light, *edit.photometry);
            !problem.empty()) {
            return problem;
        }
    }
    if (!edit.position && !edit.aim && !edit.rotation) {
        return "";
    }
    if (light.of_sky) {
        return "the sky has the place of its suns";
    }
    if (light.object != PunctualLight::no_object) {
        const Object& carrier = scene.objects[static_cast<std::size_t>(light.object)];
        return fmt::format("light {} is carried by object {} ('{}'): move that", edit.light,
                           carrier.id, carrier.name);
    }
    if (edit.position && light.kind == PunctualKind::directional) {
        return "a directional light has an aim, but no position";
    }
    const double limit = farthest_place(scene);
    const glm::dvec3 far = edit.position ? glm::abs(glm::dvec3(*edit.position)) : glm::dvec3(0.0);
    return std::max({far.x, far.y, far.z}) <= limit
               ? ""
               : fmt::format("its position may be {:.0f} m away from zero at most", limit);
}

void apply(const Scene& scene, PunctualLight& light, const LightEdit& edit) {
    if (edit.photometry) {
        exchange_photometry(scene, light, *edit.photometry);
    }
    apply_place(light, edit);
    apply_cones(light, edit);
    apply_control(light.control, edit);
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
    light.setting = setting;
    refresh_intensity(light);
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

void refresh_intensity(PunctualLight& light) {
    const PunctualSetting setting = setting_of(light);
    light.setting = setting;
    light.intensity =
        setting.on && !light.removed ? light.control.dim * setting.intensity : glm::vec3(0.0F);
}

namespace {

/// How many lights have numbers from 1 on: all but those that have been added.
std::size_t numbered_lights(const Scene& scene) {
    const auto of_file = std::count_if(scene.punctual_lights.begin(), scene.punctual_lights.end(),
                                       [](const PunctualLight& light) { return !light.added; });
    return scene.lights.size() + static_cast<std::size_t>(of_file) + (scene.sky_light ? 1 : 0);
}

}  // namespace

std::vector<std::uint32_t> light_numbers(const Scene& scene) {
    std::vector<std::uint32_t> numbers(scene.lights.size());
    std::iota(numbers.begin(), numbers.end(), 1U);
    std::vector<std::uint32_t> added;
    auto next = static_cast<std::uint32_t>(numbers.size()) + 1;
    for (const PunctualLight& light : scene.punctual_lights) {
        const std::uint32_t number = light.added ? light.added->number : next++;
        if (!light.removed) {
            (light.added ? added : numbers).push_back(number);
        }
    }
    if (scene.sky_light) {
        numbers.push_back(next);
    }
    numbers.insert(numbers.end(), added.begin(), added.end());
    return numbers;
}

bool has_light(const Scene& scene, std::uint32_t light) {
    return light >= 1 && (light <= numbered_lights(scene) || punctual_index(scene, light));
}

bool is_sky_light(const Scene& scene, std::uint32_t light) {
    return scene.sky_light && light == numbered_lights(scene);
}

std::optional<std::size_t> punctual_index(const Scene& scene, std::uint32_t light) {
    std::size_t number = scene.lights.size();
    for (std::size_t i = 0; i < scene.punctual_lights.size(); ++i) {
        const PunctualLight& punctual = scene.punctual_lights[i];
        number += punctual.added ? 0 : 1;
        if (light == (punctual.added ? punctual.added->number : number)) {
            return i;
        }
    }
    return std::nullopt;
}

std::uint32_t punctual_number(const Scene& scene, std::size_t index) {
    const PunctualLight& light = scene.punctual_lights[index];
    const auto of_file =
        std::count_if(scene.punctual_lights.begin(),
                      scene.punctual_lights.begin() + static_cast<std::ptrdiff_t>(index),
                      [](const PunctualLight& other) { return !other.added; });
    return light.added ? light.added->number
                       : static_cast<std::uint32_t>(scene.lights.size()) +
                             static_cast<std::uint32_t>(of_file) + 1;
}

std::uint32_t material_of_light(const Scene& scene, std::uint32_t light) {
    return light >= 1 && light <= scene.lights.size()
               ? static_cast<std::uint32_t>(scene.lights[light - 1].material)
               : no_material;
}

std::string problem_of(const Scene& scene, const LightEdit& edit) {
    const std::string number = std::to_string(edit.light);
    if (!has_light(scene, edit.light)) {
        return "no light " + number;
    }
    if (is_sky_light(scene, edit.light)) {
        const bool plain =
            !edit.dim && !edit.group && !edit.maintenance_factor && !edit.colour_rendering;
        return plain ? place_problem(edit, "the sky") : "the sky belongs to no group";
    }
    if (const auto punctual = punctual_index(scene, edit.light)) {
        return problem_of(scene, scene.punctual_lights[*punctual], edit);
    }
    if (scene.lights[edit.light - 1].material < 0) {
        return "light " + number + " cannot be changed";
    }
    return place_problem(edit, "light " + number + " is a surface: its object");
}

const LightControl* control_of(const Scene& scene, std::uint32_t light) {
    if (const auto punctual = punctual_index(scene, light)) {
        return &scene.punctual_lights[*punctual].control;
    }
    return is_sky_light(scene, light) ? nullptr : &scene.lights[light - 1].control;
}

bool is_lamp(const Scene& scene, std::uint32_t light) {
    if (const auto punctual = punctual_index(scene, light)) {
        return !scene.punctual_lights[*punctual].of_sky;
    }
    return light >= 1 && light <= scene.lights.size() && scene.lights[light - 1].material >= 0;
}

glm::vec3 lamp_output(const Scene& scene, std::uint32_t light) {
    const auto punctual = punctual_index(scene, light);
    return punctual ? scene.punctual_lights[*punctual].intensity
                    : scene.materials[material_of_light(scene, light)].emission;
}

void set_lamp_output(Scene& scene, std::uint32_t light, const glm::vec3& output) {
    const auto punctual = punctual_index(scene, light);
    (punctual ? scene.punctual_lights[*punctual].intensity
              : scene.materials[material_of_light(scene, light)].emission) = output;
}

double flux_per_intensity(const Scene& scene, std::uint32_t light) {
    if (const auto punctual = punctual_index(scene, light)) {
        PunctualLight one = scene.punctual_lights[*punctual];
        if (one.kind == PunctualKind::directional) {
            return 0.0;
        }
        one.intensity = glm::vec3(1.0F / intensity_unit(one));
        return place_light(one, glm::mat4(1.0F)).flux().g;
    }
    return is_sky_light(scene, light) ? 0.0 : glm::pi<double>() * scene.lights[light - 1].area;
}

std::uint32_t apply(Scene& scene, const LightEdit& edit) {
    if (const auto punctual = punctual_index(scene, edit.light)) {
        apply(scene, scene.punctual_lights[*punctual], edit);
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
    apply_control(light.control, edit);
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

std::vector<float> outer_cones(const Scene& scene) {
    std::vector<float> cosines;
    for (const PunctualLight& light : scene.punctual_lights) {
        cosines.push_back(light.kind == PunctualKind::spot ? light.outer_cosine : 0.0F);
    }
    return cosines;
}

bool same_cones(const Scene& scene, const std::vector<float>& before) {
    const std::vector<float> now = outer_cones(scene);
    return before.size() <= now.size() && std::equal(before.begin(), before.end(), now.begin());
}

}  // namespace raybundle
