// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

std::string error_text(const std::string& file, const std::string& json_path,
                       const std::string& reason) {
    return json_path.empty() ? file + ": " + reason : file + ": " + json_path + ": " + reason;
}

}  // namespace

SceneError::SceneError(std::string file, std::string json_path, std::string reason)
    : std::runtime_error(error_text(file, json_path, reason)),
      file_(std::move(file)),
      json_path_(std::move(json_path)),
      reason_(std::move(reason)) {}

glm::mat4 Transform::matrix() const {
    const glm::mat4 moved = glm::translate(glm::mat4(1.0F), translation);
    return glm::scale(moved * glm::mat4_cast(rotation), scale);
}

glm::mat4 Object::world_from_object() const {
    if (!removed) {
        return placement();
    }
    glm::mat4 point(0.0F);
    point[3] = placement() * glm::vec4(bounds.empty() ? glm::vec3(0.0F) : bounds.centre(), 1.0F);
    return point;
}

PlacedLight place_light(const Scene& scene, const PunctualLight& light) {
    if (light.object == PunctualLight::no_object) {
        return place_light(light, glm::mat4(1.0F));
    }
    const Object& carrier = scene.objects[static_cast<std::size_t>(light.object)];
    PlacedLight placed = place_light(light, carrier.placement());
    placed.intensity *= carrier.removed ? 0.0 : 1.0;
    return placed;
}

bool has_emitter(const Scene& scene) {
    const auto emits = [](const Light& light) { return light.radiance != glm::vec3(0.0F); };
    const auto shines = [](const PunctualLight& light) {
        return light.intensity != glm::vec3(0.0F);
    };
    return std::any_of(scene.lights.begin(), scene.lights.end(), emits) ||
           std::any_of(scene.punctual_lights.begin(), scene.punctual_lights.end(), shines);
}

}  // namespace raybundle
