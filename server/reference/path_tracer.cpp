// SPDX-License-Identifier: Apache-2.0
#include "reference/path_tracer.h"

#include <algorithm>

namespace raybundle {
namespace {

/// Russian roulette on the largest channel (ch. 3): whether the path goes on, and its throughput
/// then.
bool survives(glm::dvec3& throughput, double u) {
    const double chance = std::max({throughput.r, throughput.g, throughput.b});
    if (chance >= 1.0) {
        return true;
    }
    throughput /= chance;
    return u < chance;
}

}  // namespace

glm::dvec3 PathTracer::radiance(const glm::dvec3& origin, const glm::dvec3& direction,
                                PixelSampler& sampler) const {
    const std::optional<SurfacePoint> hit = scene_.trace(origin, direction);
    const glm::dvec3 sum = emitted(hit);
    if (!hit || hit->absorbs()) {
        return sum;
    }
    return sum +
           reflected(*hit, Scattering(scene_, *hit, NormalKind::shading, -direction), sampler);
}

glm::dvec3 PathTracer::irradiance(const SurfacePoint& point, PixelSampler& sampler) const {
    return glm::pi<double>() * reflected(point, Scattering::white(point), sampler);
}

glm::dvec3 PathTracer::emitted(const std::optional<SurfacePoint>& hit) const {
    return hit ? scene_.emission(*hit) : glm::dvec3(scene_.scene().sky_radiance);
}

glm::dvec3 PathTracer::reflected(SurfacePoint point, Scattering scattering,
                                 PixelSampler& sampler) const {
    glm::dvec3 sum(0.0);
    glm::dvec3 throughput(1.0);
    for (int bounce = 0; bounce < settings_.max_bounces; ++bounce) {
        sum += throughput * next_event(point, scattering, sampler);
        const glm::dvec2 u = sampler.next_pair();
        const std::optional<ScatterSample> next = scattering.sample(u, sampler.next());
        if (!next) {
            break;
        }
        throughput *= next->weight;
        if (bounce >= settings_.certain_bounces && !survives(throughput, sampler.next())) {
            break;
        }
        const std::optional<SurfacePoint> hit = scene_.trace_from(point, next->direction);
        const glm::dvec3 emission = emitted(hit);
        if (emission != glm::dvec3(0.0)) {
            const double other = settings_.next_event ? lights_.density(point, scattering.frame(),
                                                                        next->direction, hit)
                                                      : 0.0;
            sum += throughput * emission * (next->density / (next->density + other));
        }
        if (!hit || hit->absorbs()) {
            break;
        }
        point = *hit;
        scattering = Scattering(scene_, point, NormalKind::geometric, -next->direction);
    }
    return sum;
}

glm::dvec3 PathTracer::next_event(const SurfacePoint& point, const Scattering& scattering,
                                  PixelSampler& sampler) const {
    if (!settings_.next_event || lights_.empty()) {
        return glm::dvec3(0.0);
    }
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
    return value / (light->density + scattering.density(light->direction));
}

}  // namespace raybundle
