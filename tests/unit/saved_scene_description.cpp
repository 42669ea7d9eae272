// SPDX-License-Identifier: Apache-2.0
#include "saved_scene_description.h"

#include <fmt/format.h>

#include <cstring>
#include <map>

#include "scene/edit/light_edit.h"

namespace raybundle::test {
namespace {

Json numbers(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

Json numbers(const glm::mat4& m) {
    Json json = Json::array();
    for (int i = 0; i < 16; ++i) {
        json.push_back(m[i / 4][i % 4]);
    }
    return json;
}

Json control(const LightControl& control) {
    return {{"group", control.group},
            {"dim", control.dim},
            {"maintenanceFactor", control.maintenance_factor},
            {"colourRendering", control.colour_rendering.value_or(0.0F)}};
}

Json describe(const Scene& scene, const Object& object, std::size_t triangles) {
    return {{"name", object.name},
            {"movable", object.movable},
            {"kind", static_cast<int>(object.kind)},
            {"path", object.path},
            {"translation", numbers(object.transform.translation)},
            {"rotation",
             {object.transform.rotation.x, object.transform.rotation.y, object.transform.rotation.z,
              object.transform.rotation.w}},
            {"scale", numbers(object.transform.scale)},
            {"worldFromParent", numbers(object.world_from_parent)},
            {"low", numbers(object.bounds.min)},
            {"high", numbers(object.bounds.max)},
            {"triangles", triangles},
            {"origin", {scene.origin.x, scene.origin.y, scene.origin.z}}};
}

Json describe(const Material& m) {
    return {{"name", m.name},
            {"base", numbers(m.base_colour)},
            {"alpha", m.alpha},
            {"mask", m.alpha_mode == AlphaMode::mask},
            {"metallic", m.metallic},
            {"roughness", m.roughness},
            {"specular", m.specular},
            {"specularColour", numbers(m.specular_colour)},
            {"transmission", m.transmission},
            {"transmittance", numbers(m.transmittance)},
            {"clearCoat", m.clear_coat},
            {"textured", m.base_colour_texture.texture >= 0},
            {"twoSided", m.double_sided},
            {"emission", numbers(m.emission)}};
}

Json describe(const Scene& scene, const PunctualLight& light) {
    const PunctualSetting setting = setting_of(light);
    const bool carried = light.object != PunctualLight::no_object;
    Json axes = Json::array();
    for (int i = 0; i < 9; ++i) {
        axes.push_back(light.axes[i / 3][i % 3]);
    }
    return {{"name", light.name},
            {"kind", static_cast<int>(light.kind)},
            {"shining", numbers(light.intensity)},
            {"intensity", numbers(setting.intensity)},
            {"colour", numbers(setting.colour)},
            {"on", setting.on},
            {"control", control(light.control)},
            {"position", numbers(light.position)},
            {"axes", axes},
            {"inner", light.kind == PunctualKind::spot ? light.inner_cosine : 1.0F},
            {"outer", light.kind == PunctualKind::spot ? light.outer_cosine : 0.0F},
            {"photometry", light.photometry},
            {"flux", light.profile ? light.profile->flux() : 0.0},
            {"carrier", carried ? scene.objects[static_cast<std::size_t>(light.object)].name : ""}};
}

Json describe(const DaylightSetting& daylight) {
    const auto number = [](const std::optional<float>& value) {
        return value ? Json(*value) : Json();
    };
    return {{"sky", daylight.sky},
            {"elevation", daylight.sun_elevation},
            {"azimuth", daylight.sun_azimuth},
            {"zenith", number(daylight.zenith_luminance)},
            {"sun", number(daylight.sun_illuminance)},
            {"turbidity", number(daylight.turbidity)},
            {"place", daylight.place ? Json{daylight.place->x, daylight.place->y} : Json()},
            {"north", daylight.north},
            {"time", daylight.time}};
}

std::string light_name(const Scene& scene, std::uint32_t light) {
    if (const auto index = punctual_index(scene, light)) {
        return scene.punctual_lights[*index].name;
    }
    return light >= 1 && light <= scene.lights.size() ? scene.lights[light - 1].name : "?";
}

void describe_lights(const Scene& scene, Json& json) {
    for (const Light& light : scene.lights) {
        json["lights"].push_back({{"name", light.name},
                                  {"radiance", numbers(light.radiance)},
                                  {"colour", numbers(light.colour)},
                                  {"on", light.on},
                                  {"control", control(light.control)}});
    }
    for (const bool of_sky : {false, true}) {
        for (const PunctualLight& light : scene.punctual_lights) {
            const bool gone =
                light.removed || (light.object != PunctualLight::no_object &&
                                  scene.objects[static_cast<std::size_t>(light.object)].removed);
            if (light.of_sky == of_sky && !gone) {
                json["punctual"].push_back(describe(scene, light));
            }
        }
    }
    if (scene.sky_light) {
        json["sky"] = {numbers(scene.sky_light->intensity), numbers(scene.sky_light->colour),
                       scene.sky_light->on, numbers(scene.sky_light->loaded)};
    }
    for (const SavedLightingScene& lighting : scene.lighting_scenes) {
        Json lamps = Json::array();
        for (const SavedLightingScene::Lamp& lamp : lighting.lamps) {
            lamps.push_back({light_name(scene, lamp.light), numbers(lamp.colour), lamp.intensity,
                             lamp.dim, lamp.on});
        }
        json["lightingScenes"].push_back({lighting.name, lighting.by_name, lamps});
    }
}

std::uint32_t u32(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

}  // namespace

Json description_of(const Scene& scene) {
    std::map<std::uint32_t, std::size_t> triangles;
    for (const Triangle& triangle : scene.triangles) {
        ++triangles[triangle.object];
    }
    Json json;
    for (const Object& object : scene.objects) {
        if (!object.removed) {
            json["objects"].push_back(describe(scene, object, triangles[object.id - 1]));
        }
    }
    for (const Material& material : scene.materials) {
        json["materials"].push_back(describe(material));
    }
    describe_lights(scene, json);
    json["uniformSky"] = numbers(scene.sky_radiance);
    json["daylight"] = describe(scene.daylight);
    // Those that the file lacks frame the scene as it is when it is opened.
    const bool framed = has_notice(scene, "no usable camera");
    for (const Camera& camera : framed ? std::vector<Camera>() : scene.cameras) {
        json["cameras"].push_back({camera.name, numbers(camera.eye), numbers(camera.target)});
    }
    if (scene.medium) {
        json["air"] = {scene.medium->extinction, numbers(glm::vec3(scene.medium->albedo)),
                       scene.medium->anisotropy};
    }
    return json;
}

std::string saved_bytes(const Scene& scene) {
    return save_scene(scene_to_save(scene, scene.lighting_scenes)).bytes;
}

Scene saved_and_loaded(const Scene& scene, const TemporaryFolder& folder) {
    return load_gltf(folder.write("saved/scene.glb", saved_bytes(scene)));
}

std::string glb_problem(const std::string& bytes) {
    if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF" || u32(bytes, 4) != 2 ||
        u32(bytes, 8) != bytes.size() || bytes.size() % 4 != 0) {
        return "the header is wrong";
    }
    const std::size_t text = u32(bytes, 12);
    if (text % 4 != 0 || bytes.substr(16, 4) != "JSON") {
        return "the JSON chunk is wrong";
    }
    const Json json = Json::parse(bytes.substr(20, text));
    const std::size_t binary_at = 20 + text + 8;
    const std::size_t binary = bytes.size() > binary_at ? u32(bytes, 20 + text) : 0;
    if (binary > 0 && (json["buffers"][0]["byteLength"] != binary ||
                       json["buffers"][0].contains("uri") || binary_at + binary != bytes.size())) {
        return "the binary chunk is not the first buffer";
    }
    for (const Json& view : json.value("bufferViews", Json::array())) {
        const bool first = view["buffer"] == 0;
        const auto offset = view.value("byteOffset", std::size_t{0});
        if (first && (offset % 4 != 0 || offset + view["byteLength"].get<std::size_t>() > binary)) {
            return "a view is out of the buffer or not aligned: " + view.dump();
        }
    }
    for (const char* array : {"images", "buffers"}) {
        for (const Json& item : json.value(array, Json::array())) {
            if (item.contains("uri")) {
                return std::string(array) + " refer to other files";
            }
        }
    }
    return "";
}

}  // namespace raybundle::test
