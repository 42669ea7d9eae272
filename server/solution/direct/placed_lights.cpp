// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/placed_lights.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace raybundle {

static_assert(static_cast<unsigned>(LuminousOpening::Shape::point) == OPENING_POINT &&
              static_cast<unsigned>(LuminousOpening::Shape::rectangle) == OPENING_RECTANGLE &&
              static_cast<unsigned>(LuminousOpening::Shape::ellipse) == OPENING_ELLIPSE &&
              static_cast<unsigned>(LuminousOpening::Shape::quarter) == OPENING_QUARTER);

IesProfiles profiles_of(std::span<const PunctualLight> lights) {
    IesProfiles profiles;
    for (const PunctualLight& light : lights) {
        if (light.profile &&
            std::find(profiles.begin(), profiles.end(), light.profile) == profiles.end()) {
            profiles.push_back(light.profile);
        }
    }
    return profiles;
}

std::vector<layout::PunctualData> placed_lights(const GpuScene& scene,
                                                const IesProfiles& profiles) {
    constexpr float margin = 1.01F;  // round what a map has to show
    const Bounds bounds = scene.bounds();
    const float radius = 0.5F * margin * std::max(glm::length(bounds.extent()), 1e-6F);
    std::unordered_map<const IesProfile*, unsigned> number;
    for (const auto& profile : profiles) {
        number.emplace(profile.get(), static_cast<unsigned>(number.size()));
    }
    std::vector<layout::PunctualData> result;
    result.reserve(scene.punctual_lights().size());
    for (std::size_t i = 0; i < scene.punctual_lights().size(); ++i) {
        const PunctualLight& light = scene.punctual_lights()[i];
        const PlacedLight placed = scene.placed_light(i);
        const bool directional = light.kind == PunctualKind::directional;
        const float cosine = light.outer_cosine;
        const float tangent = std::sqrt(std::max(1.0F - cosine * cosine, 0.0F)) / cosine;
        layout::PunctualData data{};
        data.position = directional ? glm::vec4(bounds.centre(), radius)
                                    : glm::vec4(glm::vec3(placed.position), margin * tangent);
        data.axis_x = glm::vec4(glm::vec3(placed.axes[0]), light.inner_cosine);
        data.axis_y = glm::vec4(glm::vec3(placed.axes[1]), light.outer_cosine);
        data.axis_z = glm::vec4(glm::vec3(placed.axes[2]), placed.opening.reach());
        data.intensity = glm::vec4(glm::vec3(placed.intensity) / scene.radiance_unit(), 0.0F);
        data.map = {0U, 0U, static_cast<unsigned>(light.kind), 0U};
        data.profile = {light.profile ? number.at(light.profile.get()) : NO_PROFILE,
                        light.of_sky ? 1U : 0U, static_cast<unsigned>(placed.opening.shape), 0U};
        data.opening = glm::vec4(placed.opening.middle, placed.opening.half);
        result.push_back(data);
    }
    return result;
}

}  // namespace raybundle
