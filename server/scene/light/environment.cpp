// SPDX-License-Identifier: Apache-2.0
#include "scene/light/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace raybundle {

glm::dvec3 Sky::towards(const glm::dvec3& direction) const {
    const glm::dvec3 sum(uniform);
    return environment ? sum + environment->radiance(direction) : sum;
}

glm::dvec3 Sky::mean() const {
    const glm::dvec3 sum(uniform);
    return environment ? sum + environment->mean() : sum;
}

Sky sky_of(const Scene& scene) {
    return {scene.sky_radiance, scene.environment};
}

glm::dvec3 sky_towards(const Scene& scene, const glm::dvec3& direction) {
    const glm::dvec3 uniform(scene.sky_radiance);
    return scene.environment ? uniform + scene.environment->radiance(direction) : uniform;
}

glm::dvec3 background_towards(const Scene& scene, const glm::dvec3& direction) {
    const glm::dvec3 uniform(scene.sky_radiance);
    return scene.environment ? uniform + scene.environment->shown(direction) : uniform;
}

glm::dvec3 mean_sky(const Scene& scene) {
    return sky_of(scene).mean();
}

bool has_sky(const Scene& scene) {
    return scene.sky_light || scene.environment || scene.sky_radiance != glm::vec3(0.0F);
}

std::optional<SkyLight> find_sky_light(const Scene& scene) {
    const glm::vec3 mean(mean_sky(scene));
    const double illuminance = scene.environment ? scene.environment->illuminance() : 0.0;
    SkyLight light;
    light.image = scene.environment && scene.environment->is_image();
    light.in_lux = illuminance > 0.0;
    light.loaded = light.in_lux ? glm::vec3(static_cast<float>(illuminance)) : mean;
    if (!(luminance(light.loaded) > 0.0F)) {
        return std::nullopt;
    }
    light.intensity = light.loaded;
    light.colour = light.loaded / luminance(light.loaded);
    light.uniform = scene.sky_radiance;
    return light;
}

void refresh_sky(Scene& scene) {
    glm::dvec3 factor(1.0);
    if (scene.sky_light) {
        const SkyLight& light = *scene.sky_light;
        for (int c = 0; c < 3; ++c) {
            const double loaded{light.loaded[c]};
            factor[c] = light.on && loaded > 0.0 ? double{light.intensity[c]} / loaded : 0.0;
        }
        scene.sky_radiance = glm::vec3(factor) * light.uniform;
    }
    if (!scene.environment) {
        return;
    }
    std::vector<glm::dvec3> suns;
    for (const PunctualLight& light : scene.punctual_lights) {
        if (light.of_sky) {
            const glm::vec3 loaded = setting_of(light).loaded;
            glm::dvec3 sun(0.0);
            for (int c = 0; c < 3; ++c) {
                sun[c] = loaded[c] > 0.0F ? double{light.intensity[c]} / double{loaded[c]} : 0.0;
            }
            suns.push_back(sun);
        }
    }
    scene.environment = scene.environment->dimmed(factor, suns);
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
