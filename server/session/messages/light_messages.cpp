// SPDX-License-Identifier: Apache-2.0
#include "session/messages/light_messages.h"

#include <cmath>
#include <map>

#include "scene/edit/luminaire_edit.h"
#include "scene/light/colour_temperature.h"
#include "scene/light/light_figures.h"
#include "scene/light/light_place.h"
#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

void describe_figures(const LightFigures& figures, v1::Light* out) {
    if (figures.flux > 0.0) {
        out->set_flux(static_cast<float>(figures.flux));
    }
    if (figures.peak > 0.0) {
        out->set_peak(static_cast<float>(figures.peak));
    }
    if (figures.watts > 0.0) {
        out->set_watts(static_cast<float>(figures.watts));
    }
}

/// Message: v1::Light or v1::SetLight.
template <class Message>
void describe_control(const LightControl& control, Message* out) {
    out->set_group(control.group);
    out->set_dim(control.dim);
    out->set_maintenance_factor(control.maintenance_factor);
}

void describe_colour_rendering(const std::optional<ColourRendering>& known, v1::Light* out) {
    if (!known) {
        return;
    }
    out->set_colour_rendering(known->least);
    if (known->most > known->least) {
        out->set_colour_rendering_most(known->most);
    }
}

/// Likewise. Where it is, and how its beam is shaped, of what has a place of its own.
template <class Message>
void describe_own_place(const PunctualLight& light, Message* out) {
    const LightPlace place = place_of(light);
    if (light.kind != PunctualKind::directional) {
        to_message(place.position, out->mutable_position());
    }
    to_message(place.aim, out->mutable_aim());
    out->set_rotation(place.rotation);
}

template <class Message>
void describe_cones(const PunctualLight& light, Message* out) {
    if (light.kind == PunctualKind::spot && !light.profile) {
        out->set_inner_cone(glm::degrees(std::acos(light.inner_cosine)));
        out->set_outer_cone(glm::degrees(std::acos(light.outer_cosine)));
    }
}

bool has_own_place(const PunctualLight& light) {
    return light.object == PunctualLight::no_object && !light.of_sky;
}

void describe_place(const PunctualLight& light, v1::Light* out) {
    describe_cones(light, out);
    if (has_own_place(light)) {
        describe_own_place(light, out);
    } else if (!light.of_sky) {
        out->set_carrier(static_cast<std::uint32_t>(light.object) + 1);
    }
}

void describe_light(const PunctualLight& light, std::uint32_t id, v1::Scene* message) {
    v1::Light* out = message->add_lights();
    const bool directional = light.kind == PunctualKind::directional;
    const PunctualSetting setting = setting_of(light);
    const float unit = intensity_unit(light);
    const float loaded = luminance(setting.loaded);
    out->set_id(id);
    out->set_name(light.name);
    out->set_kind(directional                        ? v1::Light::DIRECTIONAL
                  : light.kind == PunctualKind::spot ? v1::Light::SPOT
                                                     : v1::Light::POINT);
    out->set_intensity(unit * luminance(setting.intensity));
    out->set_unit(directional ? v1::Light::LX : light.profile ? v1::Light::LM : v1::Light::CD);
    to_message(setting.colour, out->mutable_colour());
    out->set_on(setting.on);
    out->set_loaded_intensity(unit * loaded);
    to_message(loaded > 0.0F ? setting.loaded / loaded : light.dark_colour,
               out->mutable_loaded_colour());
    describe_figures(loaded_figures(light), out);
    describe_control(light.control, out);
    describe_colour_rendering(colour_rendering_of(light), out);
    describe_place(light, out);
    out->set_photometry(light.photometry);
    out->set_added(light.added != nullptr);
}

void describe_light(const SkyLight& light, std::uint32_t id, v1::Scene* message) {
    v1::Light* out = message->add_lights();
    out->set_id(id);
    out->set_name(light.image ? "surroundings" : "sky");
    out->set_kind(light.image ? v1::Light::ENVIRONMENT : v1::Light::SKY);
    out->set_intensity(luminance(light.intensity));
    out->set_unit(light.in_lux ? v1::Light::LX : v1::Light::CD_PER_M2);
    to_message(light.colour, out->mutable_colour());
    out->set_on(light.on);
    out->set_loaded_intensity(luminance(light.loaded));
    const float loaded = luminance(light.loaded);
    to_message(loaded > 0.0F ? light.loaded / loaded : light.colour, out->mutable_loaded_colour());
}

/// A direction that may be given in any length.
glm::vec3 unit_direction(const v1::Vec3& v) {
    return glm::vec3(glm::normalize(glm::dvec3(from_message(v))));
}

void read_place(const v1::SetLight& light, LightEdit& edit) {
    if (light.has_position()) {
        edit.position = from_message(light.position());
    }
    if (light.has_aim()) {
        edit.aim = unit_direction(light.aim());
    }
    if (light.has_rotation()) {
        edit.rotation = light.rotation();
    }
    if (light.has_inner_cone()) {
        edit.inner_cone = light.inner_cone();
    }
    if (light.has_outer_cone()) {
        edit.outer_cone = light.outer_cone();
    }
}

}  // namespace

LightEdit from_message(const v1::SetLight& light) {
    LightEdit edit;
    edit.light = light.light();
    if (light.has_intensity()) {
        edit.intensity = light.intensity();
    }
    if (light.has_colour()) {
        edit.colour = from_message(light.colour());
    }
    if (light.has_on()) {
        edit.on = light.on();
    }
    if (light.has_dim()) {
        edit.dim = light.dim();
    }
    if (light.has_group()) {
        edit.group = light.group();
    }
    if (light.has_maintenance_factor()) {
        edit.maintenance_factor = light.maintenance_factor();
    }
    if (light.has_colour_rendering()) {
        edit.colour_rendering = light.colour_rendering();
    }
    if (light.has_photometry()) {
        edit.photometry = light.photometry();
    }
    read_place(light, edit);
    return edit;
}

v1::SetLight resolved(const Scene& scene, const v1::SetLight& light) {
    v1::SetLight result = light;
    if (light.has_flux()) {
        // A photometric file comes with lm for its unit.
        const double lumens =
            light.photometry().empty() ? flux_per_intensity(scene, light.light()) : 1.0;
        result.set_intensity(static_cast<float>(light.flux() / lumens));
        result.clear_flux();
    }
    if (light.has_colour_temperature()) {
        to_message(colour_of_temperature(light.colour_temperature()), result.mutable_colour());
        result.clear_colour_temperature();
    }
    return result;
}

std::string problem_of(const Scene& scene, const v1::SetLight& light) {
    if (const auto index = punctual_index(scene, light.light()); index && light.has_photometry()) {
        const std::string wrong =
            exchange_problem(scene, scene.punctual_lights[*index], light.photometry());
        if (!wrong.empty()) {
            return "photometry: " + wrong;
        }
    }
    const std::string problem = problem_of(scene, from_message(light));
    if (!problem.empty()) {
        return "light: " + problem;
    }
    if (light.fade_seconds() > 0.0F && !is_lamp(scene, light.light())) {
        return "fadeSeconds: the sky and its suns do not fade";
    }
    if (light.has_flux() && light.photometry().empty() &&
        !(flux_per_intensity(scene, light.light()) > 0.0)) {
        return "flux: light " + std::to_string(light.light()) + " has none: needs intensity";
    }
    return "";
}

v1::SetLight state_of_light(const Scene& scene, std::uint32_t id) {
    v1::SetLight state;
    state.set_light(id);
    if (const LightControl* control = control_of(scene, id)) {
        describe_control(*control, &state);
        state.set_colour_rendering(control->colour_rendering.value_or(0.0F));
    }
    if (const auto punctual = punctual_index(scene, id)) {
        const PunctualLight& light = scene.punctual_lights[*punctual];
        const PunctualSetting setting = setting_of(light);
        state.set_intensity(intensity_unit(light) * luminance(setting.intensity));
        state.set_on(setting.on);
        to_message(setting.colour, state.mutable_colour());
        describe_cones(light, &state);
        if (light.kind != PunctualKind::directional) {
            state.set_photometry(light.as_loaded ? light.photometry : "");
        }
        if (has_own_place(light)) {
            describe_own_place(light, &state);
        }
        return state;
    }
    if (is_sky_light(scene, id)) {
        state.set_intensity(luminance(scene.sky_light->intensity));
        state.set_on(scene.sky_light->on);
        to_message(scene.sky_light->colour, state.mutable_colour());
        return state;
    }
    const Light& light = scene.lights[id - 1];
    state.set_intensity(luminance(light.radiance));
    state.set_on(light.on);
    to_message(light.colour, state.mutable_colour());
    return state;
}

void describe_lights(const Scene& scene, v1::Scene* message) {
    for (const Light& light : scene.lights) {
        v1::Light* out = message->add_lights();
        const float intensity = luminance(light.radiance);
        out->set_id(light.id);
        out->set_name(light.name);
        out->set_kind(v1::Light::AREA);
        out->set_intensity(intensity);
        out->set_unit(v1::Light::CD_PER_M2);
        to_message(light.colour, out->mutable_colour());
        out->set_on(light.on);
        const float loaded = luminance(light.loaded);
        out->set_loaded_intensity(loaded);
        to_message(loaded > 0.0F ? light.loaded / loaded : light.colour,
                   out->mutable_loaded_colour());
        describe_figures(loaded_figures(light), out);
        describe_control(light.control, out);
        describe_colour_rendering(colour_rendering_of(light.control), out);
    }
    // Those of the file come before the sky, added ones after it.
    auto next = static_cast<std::uint32_t>(scene.lights.size()) + 1;
    for (const bool added : {false, true}) {
        for (const PunctualLight& light : scene.punctual_lights) {
            if ((light.added != nullptr) != added) {
                continue;
            }
            const std::uint32_t id = added ? light.added->number : next++;
            if (!light.removed) {
                describe_light(light, id, message);
            }
        }
        if (!added && scene.sky_light) {
            describe_light(*scene.sky_light, next, message);
        }
    }
    std::map<std::string, v1::LightGroup> groups;
    for (const v1::Light& light : message->lights()) {
        if (!light.group().empty()) {
            groups[light.group()].add_lights(light.id());
        }
    }
    for (auto& [name, group] : groups) {
        group.set_name(name);
        *message->add_groups() = group;
    }
}

}  // namespace raybundle
