// SPDX-License-Identifier: Apache-2.0
#include "measure/solid_test.h"

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

}  // namespace raybundle
