// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/scene_manifest.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/light/environment.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {

namespace {

using Json = nlohmann::ordered_json;

constexpr int format_version = 1;

Json to_json(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

template <typename T>
Json to_json(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json bounds_json(const Bounds& bounds) {
    return {{"min", to_json(bounds.min)}, {"max", to_json(bounds.max)}};
}

Json camera_json(const Camera& camera) {
    return {{"name", camera.name},
            {"eye", to_json(camera.eye)},
            {"target", to_json(camera.target)},
            {"up", to_json(camera.up)},
            {"verticalFov", camera.vertical_fov}};
}

Json material_json(const ManifestParts& parts, std::size_t index) {
    const Material& material = parts.scene.materials[index];
    return {{"name", material.name},
            {"baseColour", to_json(material.base_colour)},
            {"texture", to_json(parts.textures[index])},
            {"alphaCutoff", to_json(texture_alpha_cutoff(material))},
            {"albedo", to_json(parts.albedos[index])},
            {"transmittance", to_json(material.transmittance)},
            {"transparency", to_json(transparency(parts.scene, index))},
            {"unlit", material.unlit}};
}

Json chunk_json(const LightChunk& chunk, const ChunkPlaces& places) {
    return {{"material", chunk.material},
            {"vertexCount", chunk.positions.size()},
            {"indexCount", chunk.indices.size()},
            {"emission", to_json(chunk.emission)},
            {"vertices", places.vertices},
            {"indices", places.indices},
            {"uvs", to_json(places.uvs)},
            {"colours", to_json(places.colours)},
            {"front", places.front},
            {"back", to_json(places.back)},
            {"emissions", to_json(places.emissions)}};
}

/// The sun as GpuScene::set_background() shows it.
Json sun_json(const Environment& environment) {
    if (!environment.draws_sources() || environment.sources().empty()) {
        return nullptr;
    }
    const SkySource& sun = environment.sources().front();
    const float sine = std::max(std::sin(sun.angular_radius), 1e-4F);
    return {{"direction", to_json(glm::vec3(sun.direction))},
            {"cosine", std::sqrt(1.0F - sine * sine)},
            {"radiance", to_json(sun.illuminance / (glm::pi<float>() * sine * sine))}};
}

Json sky_json(const ManifestParts& parts) {
    const Sky sky = sky_of(parts.scene);
    return {{"uniform", to_json(sky.uniform)},
            {"texels", to_json(parts.sky)},
            {"width", sky_width},
            {"height", sky_height},
            {"sun", sky.environment ? sun_json(*sky.environment) : Json(nullptr)}};
}

template <typename T, typename Convert>
Json list(const T& values, Convert convert) {
    Json result = Json::array();
    for (const auto& value : values) {
        result.push_back(convert(value));
    }
    return result;
}

}  // namespace

Json scene_manifest(const ManifestParts& parts) {
    Json materials = Json::array();
    for (std::size_t i = 0; i < parts.scene.materials.size(); ++i) {
        materials.push_back(material_json(parts, i));
    }
    Json chunks = Json::array();
    for (std::size_t i = 0; i < parts.chunks.size(); ++i) {
        chunks.push_back(chunk_json(parts.chunks[i], parts.places[i]));
    }
    return {{"format", "raybundle-walkthrough"},
            {"version", format_version},
            {"name", parts.scene.name},
            {"solve", parts.solve},
            {"geometry", {{"file", "geometry.bin"}, {"bytes", parts.geometry_bytes}}},
            {"light",
             {{"file", "light.bin"}, {"bytes", parts.light_bytes}, {"unit", parts.light_unit}}},
            {"grid", {{"origin", to_json(parts.grid.origin)}, {"step", to_json(parts.grid.step)}}},
            {"bounds", bounds_json(parts.scene.bounds)},
            {"cameras", list(parts.scene.cameras, camera_json)},
            {"sky", sky_json(parts)},
            {"materials", materials},
            {"textures", list(parts.written,
                              [](const WrittenTexture& texture) {
                                  return Json{{"file", texture.file},
                                              {"repeatU", texture.repeat_u},
                                              {"repeatV", texture.repeat_v}};
                              })},
            {"chunks", chunks}};
}

}  // namespace raybundle
