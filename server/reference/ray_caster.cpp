// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_caster.h"

#include "reference/sampling/next_event.h"
#include "reference/specular_walk.h"
#include "scene/light/environment.h"

namespace raybundle {

glm::dvec3 RayCaster::radiance(const glm::dvec3& origin, const glm::dvec3& direction,
                               PixelSampler& sampler) const {
    const SpecularWalk seen = walk_specular(scene_, scene_.trace(origin, direction), direction,
                                            Carried::radiance, sampler);
    if (!seen.hit) {
        return seen.weight * background_towards(scene_.scene(), seen.direction);
    }
    glm::dvec3 sum = scene_.shown_emission(*seen.hit);
    if (!seen.hit->absorbs() && !lights_.empty()) {
        const Scattering scattering(scene_, *seen.hit, NormalKind::shading, -seen.direction);
        sum += next_event(lights_, *seen.hit, scattering, scattering.is_lambert() ? 0.0 : 1.0,
                          sampler);
        if (!scattering.is_lambert()) {
            sum += met(*seen.hit, scattering, sampler);
        }
    }
    return seen.weight * sum;
}

/// Reflection of light that a direction of the lobe meets.
glm::dvec3 RayCaster::met(const SurfacePoint& point, const Scattering& scattering,
                          PixelSampler& sampler) const {
    const glm::dvec2 u = sampler.next_pair();
    const std::optional<ScatterSample> drawn = scattering.sample(u, sampler.next());
    if (!drawn) {
        return glm::dvec3(0.0);
    }
    const std::optional<SurfacePoint> hit = scene_.trace_from(point, drawn->direction);
    const glm::dvec3 emitted =
        hit ? scene_.emission(*hit) : sky_towards(scene_.scene(), drawn->direction);
    if (emitted == glm::dvec3(0.0)) {
        return emitted;
    }
    const double other = lights_.density(point, scattering.frame(), drawn->direction, hit);
    return drawn->weight * emitted * power_heuristic(drawn->density, other);
}

}  // namespace raybundle
