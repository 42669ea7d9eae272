// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scene/gltf/gltf_loader.h"
#include "scene/gltf/saved/glb_parts.h"
#include "scene/gltf/saved/light_writer.h"
#include "scene/gltf/saved/material_writer.h"
#include "scene/gltf/saved/object_writer.h"
#include "scene/gltf/saved/saved_state.h"
#include "scene/gltf/saved/scene_to_save.h"

namespace raybundle {
namespace {

Json daylight_json(const Daylight& daylight) {
    Json json = Json::object();
    const auto put = [&](const char* key, const auto& value) {
        if (value) {
            json[key] = *value;
        }
    };
    put("sky", daylight.sky);
    put("zenithLuminance", daylight.zenith_luminance);
    put("sunElevation", daylight.sun_elevation);
    put("sunAzimuth", daylight.sun_azimuth);
    put("sunIlluminance", daylight.sun_illuminance);
    put("sunDiameter", daylight.sun_diameter);
    put("groundAlbedo", daylight.ground_albedo);
    put("environmentRotation", daylight.environment_rotation);
    put("environmentScale", daylight.environment_scale);
    if (daylight.environment) {
        json["environment"] = data_uri(daylight.environment_bytes);
    }
    return json;
}

Json daylight_setting_json(const DaylightSetting& setting) {
    Json json = {{"sky", setting.sky},
                 {"sunElevation", setting.sun_elevation},
                 {"sunAzimuth", setting.sun_azimuth},
                 {"north", setting.north},
                 {"time", setting.time}};
    const auto put = [&](const char* key, const std::optional<float>& value) {
        if (value) {
            json[key] = *value;
        }
    };
    put("zenithLuminance", setting.zenith_luminance);
    put("sunIlluminance", setting.sun_illuminance);
    put("turbidity", setting.turbidity);
    if (setting.place) {
        json["place"] = {setting.place->x, setting.place->y};
    }
    return json;
}

Json air_json(const Medium& medium) {
    const glm::vec3 albedo(medium.albedo);
    return {{"extinction", medium.extinction},
            {"albedo", numbers_json(albedo)},
            {"anisotropy", medium.anisotropy}};
}

Json lighting_json(const SavedLightingScene& lighting, const std::map<std::uint32_t, Json>& names) {
    Json lamps = Json::array();
    for (const SavedLightingScene::Lamp& lamp : lighting.lamps) {
        if (const auto name = names.find(lamp.light); name != names.end()) {
            Json& json = lamps.emplace_back(name->second);
            json["intensity"] = lamp.intensity;
            json["colour"] = numbers_json(lamp.colour);
            json["on"] = lamp.on;
            json["dim"] = lamp.dim;
        }
    }
    return {{"name", lighting.name}, {"byName", lighting.by_name}, {"lamps", std::move(lamps)}};
}

void write_sky(const SceneToSave& scene, Json& saved) {
    if (scene.source->daylight.given()) {
        saved["daylight"] = daylight_json(scene.source->daylight);
    } else {  // also where there is none: lamps may be off
        saved["skyLuminance"] = scene.source->sky_luminance;
    }
    if (scene.daylight) {
        saved["daylightSetting"] = daylight_setting_json(*scene.daylight);
    }
    if (!scene.daylight_dimmed) {
        return;
    }
    if (scene.sky_light) {
        const SkyLight& sky = *scene.sky_light;
        saved["skyLight"] = setting_json(sky.intensity, sky.colour, sky.on);
    }
    for (const PunctualLight& light : scene.punctual_lights) {
        if (light.of_sky) {
            const PunctualSetting setting = setting_of(light);
            Json sun = setting_json(setting.intensity, setting.colour, setting.on);
            sun.update(control_json(light.control));
            saved["suns"].push_back(std::move(sun));
        }
    }
}

/// What is of the scene as a whole.
void write_scene(const SceneToSave& scene, std::map<std::uint32_t, Json> names, Json& json) {
    for (const Light& light : scene.lights) {
        names[light.id] = {{"material", light.material}};
    }
    constexpr std::array written = {"metresPerUnit", "skyLuminance", "daylight", "daylightSetting",
                                    "skyLight",      "suns",         "air",      "lightingScenes"};
    for (const char* key : written) {
        drop_saved(json, key);
    }
    Json saved = Json::object();
    write_sky(scene, saved);
    if (scene.source->metres_per_unit != 1.0F) {
        saved["metresPerUnit"] = scene.source->metres_per_unit;
    }
    if (scene.medium) {
        saved["air"] = air_json(*scene.medium);
    }
    for (const SavedLightingScene& lighting : scene.lighting_scenes) {
        saved["lightingScenes"].push_back(lighting_json(lighting, names));
    }
    if (!saved.empty()) {
        saved_extras(json).update(saved);
    }
}

}  // namespace

SavedFile save_scene(const SceneToSave& scene) {
    if (!scene.source) {
        throw SceneError(scene.path, "", "the scene is from no file and cannot be saved");
    }
    if (std::all_of(scene.objects.begin(), scene.objects.end(),
                    [](const Object& object) { return object.removed; })) {
        throw SceneError(scene.path, "", "all objects have been removed: nothing is left to save");
    }
    GltfContainer container = read_gltf_container(scene.path);
    if (container.mark != scene.source->file) {
        throw SceneError(scene.path, "",
                         "the file has changed since the scene was opened: open it again");
    }
    SavedFile file;
    GlbParts parts = embed(scene.path, std::move(container));
    write_materials(scene, parts);
    NodeWriter nodes(parts, scene.source->metres_per_unit, scene.origin);
    ObjectWriter objects(scene, nodes, parts, file.notes);
    objects.write();
    LightWriter lights(scene, objects, nodes, parts);
    lights.write();
    write_scene(scene, lights.names(), nodes.scene());
    file.bytes = glb_bytes(std::move(parts));
    return file;
}

}  // namespace raybundle
