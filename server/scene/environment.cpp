// SPDX-License-Identifier: Apache-2.0
#include "scene/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace raybundle {

glm::dvec3 sky_towards(const Scene& scene, const glm::dvec3& direction) {
    const glm::dvec3 uniform(scene.sky_radiance);
    return scene.environment ? uniform + scene.environment->radiance(direction) : uniform;
}

glm::dvec3 background_towards(const Scene& scene, const glm::dvec3& direction) {
    const glm::dvec3 uniform(scene.sky_radiance);
    return scene.environment ? uniform + scene.environment->shown(direction) : uniform;
}

glm::dvec3 mean_sky(const Scene& scene) {
    const glm::dvec3 uniform(scene.sky_radiance);
    return scene.environment ? uniform + scene.environment->mean() : uniform;
}

bool has_sky(const Scene& scene) {
    return mean_sky(scene) != glm::dvec3(0.0);
}

void set_environment(std::shared_ptr<const Environment> environment, Scene& scene) {
    remove_environment(scene);
    scene.environment = std::move(environment);
    std::size_t number = 0;
    for (const SkySource& source : scene.environment->sources()) {
        PunctualLight light;
        light.name = number == 0 ? "sun" : fmt::format("sun {}", number + 1);
        ++number;
        light.kind = PunctualKind::directional;
        light.intensity = source.illuminance;
        light.angular_radius = source.angular_radius;
        light.of_sky = true;
        const glm::vec3 z(source.direction);
        const glm::vec3 other = std::abs(z.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        const glm::vec3 x = glm::normalize(glm::cross(other, z));
        light.axes = {x, glm::cross(z, x), z};
        scene.punctual_lights.push_back(light);
    }
}

void remove_environment(Scene& scene) {
    scene.environment.reset();
    std::erase_if(scene.punctual_lights, [](const PunctualLight& light) { return light.of_sky; });
}

}  // namespace raybundle
