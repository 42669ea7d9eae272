// SPDX-License-Identifier: Apache-2.0
#include "measure/solid_test.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raybundle {

bool inside_solid(const RayScene& scene, const glm::dvec3& position) {
    constexpr int rays = 64;
    int backs = 0;
    for (int i = 0; i < rays; ++i) {  // a spiral of equal steps of height and golden angles
        const double y = 1.0 - (2.0 * i + 1.0) / rays;
        const double azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(1.0 - y * y);
        const auto hit = scene.trace(position, {r * std::cos(azimuth), y, r * std::sin(azimuth)});
        backs += hit && hit->absorbs() ? 1 : 0;
    }
    return 2 * backs > rays;
}

glm::dvec3 in_front_of_surface(const RayScene& scene, const glm::dvec3& position,
                               const glm::dvec3& axis) {
    constexpr double rounding = 4e-6;     // of the diameter: rays start 1e-6 in front of surfaces
    constexpr double model_share = 1e-4;  // of the diameter: in scenes below ten metres
    constexpr double most_metres = 1e-3;
    const double least = rounding * scene.diameter();
    const double reach = std::max(least, std::min(most_metres / std::sqrt(scene.square_metres()),
                                                  model_share * scene.diameter()));
    const glm::dvec3 start = position + reach * axis;
    const auto hit = scene.trace(start, -axis);
    if (!hit || hit->absorbs() || glm::dot(start - hit->position, axis) > reach + least) {
        return position;
    }
    return glm::dvec3(scene.departure(*hit));
}

}  // namespace raybundle
