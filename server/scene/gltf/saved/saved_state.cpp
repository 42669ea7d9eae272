// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/saved_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/edit/daylight_edit.h"
#include "scene/edit/light_edit.h"
#include "scene/gltf/saved/saved_values.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

constexpr std::size_t max_saved_path = 128;

/// What single precision and other programs' decimals leave of a value.
constexpr float kept_precision = 1e-4F;

bool nearly(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) <= kept_precision * std::max(glm::length(a), glm::length(b));
}

const Json* part_of(const std::unordered_map<int, Json>& states, int index, const char* key) {
    const auto state = states.find(index);
    const Json* found = state == states.end() ? nullptr : find_member(state->second, key);
    return found != nullptr && found->is_object() ? found : nullptr;
}

void restore_control(const Json& json, LightControl& control) {
    control.group = text_of(json, "group").value_or(control.group);
    control.dim = number_in(json, "dim", 0.0F, 1.0F).value_or(control.dim);
    control.maintenance_factor =
        number_in(json, "maintenanceFactor", 0.0F, 1.0F).value_or(control.maintenance_factor);
    if (const auto set = number_in(json, "colourRendering", 0.0F, 100.0F); set && *set > 0.0F) {
        control.colour_rendering = set;
    }
}

/// Intensity, colour and whether it is on.
struct SavedSetting {
    glm::vec3 intensity, colour;
    bool on;
};

std::optional<SavedSetting> setting_of(const Json& json) {
    const auto intensity = vector_of(json, "intensity", 0.0F, max_saved_number);
    const auto colour = vector_of(json, "colour", 0.0F, max_saved_number);
    const auto on = flag_of(json, "on");
    if (!intensity || !colour || !on || !(luminance(*colour) > 0.0F)) {
        return std::nullopt;
    }
    return SavedSetting{*intensity, *colour, *on};
}

void restore_place(const Json& json, PunctualLight& light) {
    const auto position = vector_of(json, "position", -max_saved_number, max_saved_number);
    const auto axes = numbers_of<9>(json, "axes", -max_saved_number, max_saved_number);
    if (!position || !axes) {
        return;
    }
    glm::mat3 turned;
    bool same = glm::length(*position - light.position) <=
                kept_precision * std::max(1.0F, glm::length(*position));
    for (int i = 0; i < 9; ++i) {
        turned[i / 3][i % 3] = (*axes)[static_cast<std::size_t>(i)];
    }
    for (int column = 0; column < 3; ++column) {
        same = same && nearly(turned[column], light.axes[column]);
    }
    if (same) {
        light.position = *position;
        light.axes = turned;
    }
}

void restore_cones(const Json& json, PunctualLight& light) {
    const auto inner = number_in(json, "innerCosine", -1.0F, 1.0F);
    const auto outer = number_in(json, "outerCosine", -1.0F, 1.0F);
    if (light.kind == PunctualKind::spot && inner && outer && *outer < *inner &&
        std::abs(*inner - light.inner_cosine) <= kept_precision &&
        std::abs(*outer - light.outer_cosine) <= kept_precision) {
        light.inner_cosine = *inner;
        light.outer_cosine = *outer;
    }
}

void restore_suns(const Json& json, Scene& scene) {
    const Json& suns = array_or_empty(json, "suns");
    std::size_t next = 0;
    for (PunctualLight& light : scene.punctual_lights) {
        if (!light.of_sky || !suns.is_array() || next >= suns.size()) {
            continue;
        }
        const Json& sun = suns[next++];
        const auto setting = sun.is_object() ? setting_of(sun) : std::nullopt;
        if (setting) {
            PunctualSetting of_light = setting_of(light);
            of_light.intensity = setting->intensity;
            of_light.colour = setting->colour;
            of_light.on = setting->on;
            restore_control(sun, light.control);
            light.setting = of_light;
            refresh_intensity(light);
        }
    }
}

}  // namespace

SavedState read_saved_state(const Json& json) {
    SavedState state;
    const auto saved = [](const Json& item) -> const Json* {
        const Json* extras = item.is_object() ? find_member(item, "extras") : nullptr;
        const Json* found =
            extras != nullptr && extras->is_object() ? find_member(*extras, saved_key) : nullptr;
        return found != nullptr && found->is_object() ? found : nullptr;
    };
    const auto collect = [&](const char* array, std::unordered_map<int, Json>& into) {
        const Json& items = array_or_empty(json, array);
        for (std::size_t i = 0; items.is_array() && i < items.size(); ++i) {
            if (const Json* found = saved(items[i])) {
                into.emplace(static_cast<int>(i), *found);
            }
        }
    };
    collect("nodes", state.nodes);
    collect("materials", state.materials);
    const Json& scenes = array_or_empty(json, "scenes");
    const auto shown = value_or<std::size_t>(json, "scene", 0);
    if (const Json* found = shown < scenes.size() ? saved(scenes[shown]) : nullptr) {
        state.scene = *found;
    }
    return state;
}

std::optional<SavedObject> saved_object(const SavedState& state, int node) {
    const Json* json = part_of(state.nodes, node, "object");
    if (json == nullptr) {
        return std::nullopt;
    }
    SavedObject object;
    if (const auto number_of = number_in(*json, "number", 1.0F, 1e7F)) {
        object.number = static_cast<std::size_t>(*number_of);
    }
    object.name = text_of(*json, "name");
    object.movable = flag_of(*json, "movable");
    object.whole = flag_of(*json, "whole").value_or(false);
    const std::string kind = text_of(*json, "kind").value_or("");
    for (const ObjectKind known : {ObjectKind::thing, ObjectKind::structure, ObjectKind::door}) {
        object.kind = kind == kind_name(known) ? known : object.kind;
    }
    const Json* path = find_member(*json, "path");
    if (path != nullptr && path->is_array() && path->size() <= max_saved_path) {
        object.path.emplace();
        for (const Json& name : *path) {
            object.path->push_back(name.is_string() ? name.get<std::string>() : "");
        }
    }
    return object;
}

std::size_t saved_light_number(const SavedState& state, int node, const char* key) {
    const Json* json = part_of(state.nodes, node, key);
    const auto found = json == nullptr ? std::nullopt : number_in(*json, "number", 1.0F, 1e7F);
    return found ? static_cast<std::size_t>(*found) : SavedObject::last;
}

void restore_light(const SavedState& state, int node, const char* key, PunctualLight& light) {
    const Json* json = part_of(state.nodes, node, key);
    if (json == nullptr) {
        return;
    }
    light.name = text_of(*json, "name").value_or(light.name);
    restore_control(*json, light.control);
    if (light.profile) {
        light.photometry = text_of(*json, "photometry").value_or(light.photometry);
    }
    restore_place(*json, light);
    restore_cones(*json, light);
    const auto setting = setting_of(*json);
    const glm::vec3 shining =
        setting && setting->on ? light.control.dim * setting->intensity : glm::vec3(0.0F);
    if (setting && nearly(shining, light.intensity)) {
        light.setting = {setting->intensity, setting->colour, setting->on, setting->intensity};
        light.dark_colour = setting->colour;
        refresh_intensity(light);
    } else {
        light.control.dim = 1.0F;  // what glTF says is the whole of it
    }
}

void restore_area_lights(const SavedState& state, Scene& scene) {
    for (Light& light : scene.lights) {
        const Json* json = part_of(state.materials, light.material, "light");
        if (json == nullptr) {
            continue;
        }
        restore_control(*json, light.control);
        const auto setting = setting_of(*json);
        const glm::vec3 shining =
            setting && setting->on ? light.control.dim * setting->intensity : glm::vec3(0.0F);
        if (!setting || !nearly(shining, light.radiance)) {
            light.control.dim = 1.0F;
            continue;
        }
        light.radiance = setting->intensity;
        light.loaded = setting->intensity;
        light.colour = setting->colour;
        light.on = setting->on;
        LightEdit none;
        none.light = light.id;
        apply(scene, none);
    }
}

void restore_surface(const SavedState& state, int material, const glm::vec3& base, float metallic,
                     float roughness, Material& result) {
    const Json* json = part_of(state.materials, material, "surface");
    const Json* of = json == nullptr ? nullptr : find_member(*json, "of");
    if (of == nullptr || !of->is_object()) {
        return;
    }
    const auto base_of = vector_of(*of, "baseColour", 0.0F, 1.0F);
    const auto metallic_of = number_in(*of, "metallic", 0.0F, 1.0F);
    const auto roughness_of = number_in(*of, "roughness", 0.0F, 1.0F);
    const bool same = base_of && metallic_of && roughness_of && nearly(*base_of, base) &&
                      std::abs(*metallic_of - metallic) <= kept_precision &&
                      std::abs(*roughness_of - roughness) <= kept_precision;
    if (same) {
        result.base_colour =
            vector_of(*json, "baseColour", 0.0F, 1.0F).value_or(result.base_colour);
        result.metallic = number_in(*json, "metallic", 0.0F, 1.0F).value_or(result.metallic);
        result.roughness = number_in(*json, "roughness", 0.0F, 1.0F).value_or(result.roughness);
    }
}

void restore_daylight(const SavedState& state, Scene& scene) {
    if (const Json* json = find_member(state.scene, "daylightSetting");
        json != nullptr && json->is_object()) {
        DaylightSetting setting;
        setting.sky = text_of(*json, "sky").value_or(setting.sky);
        setting.sun_elevation =
            number_in(*json, "sunElevation", -90.0F, 90.0F).value_or(setting.sun_elevation);
        setting.sun_azimuth =
            number_in(*json, "sunAzimuth", -360.0F, 360.0F).value_or(setting.sun_azimuth);
        setting.zenith_luminance = number_in(*json, "zenithLuminance", 0.0F, 1e9F);
        setting.sun_illuminance = number_in(*json, "sunIlluminance", 0.0F, 1e9F);
        setting.turbidity = number_in(*json, "turbidity", 1.0F, 100.0F);
        if (const auto place = numbers_of<2>(*json, "place", -180.0F, 180.0F)) {
            setting.place = glm::vec2((*place)[0], (*place)[1]);
        }
        setting.north = number_in(*json, "north", -360.0F, 360.0F).value_or(0.0F);
        setting.time = text_of(*json, "time").value_or("");
        if (problem_of(setting).empty()) {
            apply(scene, setting);
        }
    }
    const Json* sky = find_member(state.scene, "skyLight");
    if (scene.sky_light && sky != nullptr && sky->is_object()) {
        if (const auto setting = setting_of(*sky)) {
            scene.sky_light->intensity = setting->intensity;
            scene.sky_light->colour = setting->colour;
            scene.sky_light->on = setting->on;
        }
    }
    restore_suns(state.scene, scene);
    if (find_member(state.scene, "skyLight") != nullptr ||
        find_member(state.scene, "suns") != nullptr) {
        refresh_sky(scene);
    }
}

float saved_metres_per_unit(const SavedState& state) {
    return number_in(state.scene, "metresPerUnit", 1e-6F, 1e6F).value_or(1.0F);
}

std::optional<float> saved_sky_luminance(const SavedState& state) {
    return number_in(state.scene, "skyLuminance", 0.0F, 1e9F);
}

Json numbers_json(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

Json setting_json(const glm::vec3& intensity, const glm::vec3& colour, bool on) {
    return {{"intensity", numbers_json(intensity)}, {"colour", numbers_json(colour)}, {"on", on}};
}

Json control_json(const LightControl& control) {
    Json json = {{"group", control.group},
                 {"dim", control.dim},
                 {"maintenanceFactor", control.maintenance_factor}};
    if (control.colour_rendering) {
        json["colourRendering"] = *control.colour_rendering;
    }
    return json;
}

const char* kind_name(ObjectKind kind) {
    return kind == ObjectKind::door        ? "door"
           : kind == ObjectKind::structure ? "structure"
                                           : "thing";
}

}  // namespace raybundle
