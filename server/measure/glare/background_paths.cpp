// SPDX-License-Identifier: Apache-2.0
#include "measure/glare/background_paths.h"

#include <cmath>
#include <numbers>

#include "reference/sampling/directions.h"
#include "reference/sampling/pane_shares.h"
#include "reference/specular_walk.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

double luminance_of(const glm::dvec3& colour) {
    return static_cast<double>(luminance(glm::vec3(colour)));
}

}  // namespace

double background_luminance(const MeasuredScene& scene, const glm::dvec3& position,
                            const glm::dvec3& direction, Sampler& sampler) {
    const SpecularWalk met = walk_from_eye(scene.rays, position, direction, sampler);
    constexpr double straight = 1.0 - 1e-9;  // cosine: panes do not bend rays
    const bool by_mirror = met.passed && glm::dot(met.direction, direction) < straight;
    glm::dvec3 emission(0.0);
    if (met.luminaire) {
        emission = by_mirror ? *met.luminaire : glm::dvec3(0.0);
    } else if (!met.hit) {
        emission = sky_towards(scene.rays.scene(), met.direction);
    } else if (by_mirror) {
        emission = scene.rays.emission(*met.hit);
    }
    double light = luminance_of(met.weight * emission);
    if (const auto end = scene.paths.end_of(met, sampler)) {
        light += luminance_of(scene.paths.reflected(*end, sampler));
    }
    return std::isfinite(light) ? light : 0.0;
}

void for_each_sun(const MeasuredScene& scene, const glm::dvec3& position, Sampler& sampler,
                  const std::function<void(const PlacedLight&, const SampledLight&)>& take) {
    for (const PlacedLight& light : scene.punctual) {
        if (light.kind != PunctualKind::directional) {
            continue;
        }
        const glm::dvec2 u = sampler.next_pair();
        const double aside = std::sin(light.angular_radius) * std::sqrt(u.y);
        const double azimuth = 2.0 * std::numbers::pi * u.x;
        const glm::dvec3 direction =
            Frame(-light.direction())
                .to_world({aside * std::cos(azimuth), aside * std::sin(azimuth),
                           std::sqrt(1.0 - aside * aside)});
        const glm::dvec3 share = share_through_panes_from_sky(scene.rays, position, direction);
        take(light, {direction, luminance_of(light.intensity * share)});
    }
}

}  // namespace raybundle
