// SPDX-License-Identifier: Apache-2.0
#include "trace/air/air_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace raybundle {
namespace {

double light_of(const glm::dvec3& colour) {
    return static_cast<double>(luminance(glm::vec3(colour)));
}

}  // namespace

AirLights::AirLights(const AirScene& scene, std::span<const glm::vec3> emission,
                     std::vector<PlacedLight> punctual, float diameter)
    : punctual_(std::move(punctual)) {
    constexpr double pi = glm::pi<double>();
    double sum = 0.0;
    const auto add = [&](double flux) {
        sum += flux;
        chances_.push_back(sum);
    };
    for (std::uint32_t i = 0; i < scene.side_count(); ++i) {
        if (emission[i] == glm::vec3(0.0F)) {
            continue;
        }
        emitters_.push_back({scene.side(i), emission[i]});
        add(pi * light_of(emission[i]) * static_cast<double>(emitters_.back().side.area));
    }
    const double disc = 0.25 * pi * static_cast<double>(diameter) * static_cast<double>(diameter);
    for (const PlacedLight& light : punctual_) {
        add(light.kind == PunctualKind::directional ? disc * light_of(light.intensity)
                                                    : light_of(light.flux()));
    }
    for (double& chance : chances_) {
        chance /= std::max(sum, 1e-300);
    }
    if (!(sum > 0.0)) {
        chances_.clear();
    }
}

AirLight AirLights::choose(AirRandom& random) const {
    const auto found = std::upper_bound(chances_.begin(), chances_.end(), random.next());
    const auto at =
        std::min(static_cast<std::size_t>(found - chances_.begin()), chances_.size() - 1);
    const double chance = chances_[at] - (at == 0 ? 0.0 : chances_[at - 1]);
    AirLight light;
    light.density = chance;
    if (at < emitters_.size()) {
        const Emitter& emitter = emitters_[at];
        const auto root = static_cast<float>(std::sqrt(random.next()));
        const float along = root * static_cast<float>(random.next());
        light.position =
            emitter.side.a + (root - along) * emitter.side.e1 + along * emitter.side.e2;
        light.direction = emitter.side.normal;
        light.radiance = emitter.radiance;
        light.density =
            emitter.side.area > 0.0F ? chance / static_cast<double>(emitter.side.area) : 0.0;
        return light;
    }
    light.punctual = &punctual_[at - emitters_.size()];
    light.distant = light.punctual->kind == PunctualKind::directional;
    light.position = glm::vec3(light.punctual->position);
    if (light.punctual->has_opening()) {
        const double along = random.next();
        light.position = glm::vec3(light.punctual->point({along, random.next()}));
    }
    light.direction = light.distant ? glm::vec3(-light.punctual->direction()) : glm::vec3(0.0F);
    return light;
}

}  // namespace raybundle
