// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/scene_manifest.h"

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

Json matrix_json(const glm::mat4& matrix) {
    Json numbers = Json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            numbers.push_back(matrix[column][row]);
        }
    }
    return numbers;
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

Json sun_json(const Environment& environment) {
    const std::optional<SunDisc> sun = sun_disc(environment);
    if (!sun) {
        return nullptr;
    }
    return {{"direction", to_json(sun->direction)},
            {"cosine", sun->cosine},
            {"radiance", to_json(sun->radiance)}};
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
        Json& chunk = chunks.emplace_back(chunk_json(parts.chunks[i], parts.places[i]));
        if (parts.live) {
            chunk["object"] = parts.chunks[i].object;
            chunk["emissionAt"] = to_json(parts.places[i].emission);
        }
    }
    Json manifest = {
        {"format", "raybundle-walkthrough"},
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
    if (parts.live) {
        manifest["light"]["file"] = nullptr;
        manifest["objects"] = list(parts.scene.objects, [](const Object& object) {
            return Json{{"worldFromObject", matrix_json(object.world_from_object())}};
        });
    }
    return manifest;
}

}  // namespace raybundle
