// SPDX-License-Identifier: Apache-2.0
// What a saved scene says beside glTF, in `extras.raybundle` of its scene, nodes and materials.
// Other programs may have written the file since, and keep extras that no longer hold: what
// disagrees with glTF's own values is left out, and so is what has a wrong type.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/gltf/file/gltf_json.h"
#include "scene/scene.h"

namespace raybundle {

constexpr const char* saved_key = "raybundle";

/// The objects `extras.raybundle` of a file's nodes, materials and shown scene.
struct SavedState {
    std::unordered_map<int, Json> nodes;
    std::unordered_map<int, Json> materials;
    Json scene = Json::object();
};
SavedState read_saved_state(const Json& json);

/// How a node was an object. Where a file has such nodes, these are its objects.
struct SavedObject {
    static constexpr std::size_t last = std::numeric_limits<std::size_t>::max();

    std::size_t number = last;  ///< place among the objects
    std::optional<std::string> name;
    std::optional<bool> movable;
    std::optional<ObjectKind> kind;
    std::optional<std::vector<std::string>> path;
    bool whole = false;  ///< not to be divided into its parts
};
std::optional<SavedObject> saved_object(const SavedState& state, int node);

/// How a light of a node was set: where it is in `extras.raybundle`, by the extension that the node
/// has the light by.
struct SavedLight {
    static constexpr const char* punctual = "light";
    static constexpr const char* photometric = "photometricLight";
};
/// Its place among the lights; SavedObject::last where it has none.
std::size_t saved_light_number(const SavedState& state, int node, const char* key);
/// Gives a light as read from glTF what it was besides.
void restore_light(const SavedState& state, int node, const char* key, PunctualLight& light);
/// The same for the lights of Scene::lights.
void restore_area_lights(const SavedState& state, Scene& scene);
/// The same for a material; `base`, `metallic` and `roughness` are glTF's own values.
void restore_surface(const SavedState& state, int material, const glm::vec3& base, float metallic,
                     float roughness, Material& result);
/// Daylight that was set, and how sky and suns were dimmed.
void restore_daylight(const SavedState& state, Scene& scene);

/// m; 1 where the file does not say.
float saved_metres_per_unit(const SavedState& state);
/// Of a uniform sky, cd/m².
std::optional<float> saved_sky_luminance(const SavedState& state);

// Both directions of the values above.
Json setting_json(const glm::vec3& intensity, const glm::vec3& colour, bool on);
Json control_json(const LightControl& control);
Json numbers_json(const glm::vec3& v);
const char* kind_name(ObjectKind kind);

}  // namespace raybundle
