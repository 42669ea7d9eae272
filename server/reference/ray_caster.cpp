// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_caster.h"

#include "reference/specular_walk.h"
#include "scene/environment.h"

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
        sum += sampled(*seen.hit, scattering, sampler);
        if (!scattering.is_lambert()) {
            sum += met(*seen.hit, scattering, sampler);
        }
    }
    return seen.weight * sum;
}

/// Reflection of light from a point chosen on the lights.
glm::dvec3 RayCaster::sampled(const SurfacePoint& point, const Scattering& scattering,
                              PixelSampler& sampler) const {
    const double choice = sampler.next();
    const std::optional<LightSample> light =
        lights_.sample(point, scattering.frame(), choice, sampler.next_pair());
    if (!light) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 value = scattering.evaluate(light->direction) * light->radiance;
    if (value == glm::dvec3(0.0) || !lights_.arrives(point, *light)) {
        return glm::dvec3(0.0);
    }
    const double other = scattering.is_lambert() ? 0.0 : scattering.density(light->direction);
    return value * (light->weight(other) / light->density);
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
