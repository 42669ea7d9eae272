// SPDX-License-Identifier: Apache-2.0
#include "reference/path_tracer.h"

#include <algorithm>

#include "reference/roulette.h"
#include "reference/specular_walk.h"
#include "scene/environment.h"

namespace raybundle {

PathTracer::PathTracer(const RayScene& scene, const LightSampling& lights,
                       const PathSettings& settings)
    : scene_(scene), lights_(lights), settings_(settings) {
    if (settings.survival == Survival::albedo) {
        tables_.emplace(scene.scene());
    }
}

/// Chance with which a walk survives its reflection at a point; throughput: with that reflection.
double PathTracer::survival_chance(const SurfacePoint& point, const Scattering& scattering,
                                   const glm::dvec3& throughput) const {
    switch (settings_.survival) {
        case Survival::albedo:
            return largest_channel(
                tables_->albedo(scene_.mesh().triangle_material[point.triangle], scattering));
        case Survival::fixed:
            return settings_.survival_probability;
        case Survival::throughput:
            break;
    }
    return std::min(largest_channel(throughput), 1.0);
}
glm::dvec3 PathTracer::radiance(const glm::dvec3& origin, const glm::dvec3& direction,
                                Sampler& sampler) const {
    const SpecularWalk seen = walk_specular(scene_, scene_.trace(origin, direction), direction,
                                            Carried::radiance, sampler);
    if (!seen.hit) {
        return seen.weight * background_towards(scene_.scene(), seen.direction);
    }
    const glm::dvec3 sum = scene_.shown_emission(*seen.hit);
    if (seen.hit->absorbs()) {
        return seen.weight * sum;
    }
    SurfacePoint point = *seen.hit;
    Scattering scattering(scene_, point, NormalKind::shading, -seen.direction);
    const double factor = choose_side(point, scattering, sampler);
    return seen.weight * (sum + factor * reflected(point, scattering, sampler));
}

double PathTracer::choose_side(SurfacePoint& point, Scattering& scattering,
                               Sampler& sampler) const {
    const Material& material = scene_.material(point);
    if (!transmits(material)) {
        return 1.0;
    }
    const double through = largest_channel(glm::dvec3(material.transmittance));
    const double chance =
        through / (through + largest_channel(glm::dvec3(scattering.brdf().lambert)));
    if (sampler.next() >= chance) {
        return 1.0 / (1.0 - chance);
    }
    point = scene_.other_side(point);
    scattering = Scattering::lambert(point, material.transmittance);
    return 1.0 / chance;
}

glm::dvec3 PathTracer::irradiance(const SurfacePoint& point, Sampler& sampler) const {
    return glm::pi<double>() * reflected(point, Scattering::white(point), sampler);
}

glm::dvec3 PathTracer::emitted(const std::optional<SurfacePoint>& hit,
                               const glm::dvec3& direction) const {
    return hit ? scene_.emission(*hit) : sky_towards(scene_.scene(), direction);
}

glm::dvec3 PathTracer::reflected(SurfacePoint point, Scattering scattering,
                                 Sampler& sampler) const {
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
        if (bounce >= settings_.certain_bounces) {
            const double chance = survival_chance(point, scattering, throughput);
            if (sampler.next() >= chance) {
                break;
            }
            throughput /= chance;
        }
        const SpecularWalk met = walk_specular(scene_, scene_.trace_from(point, next->direction),
                                               next->direction, Carried::radiance, sampler);
        throughput *= met.weight;
        const glm::dvec3 emission = emitted(met.hit, met.direction);
        if (emission != glm::dvec3(0.0)) {
            // No light is sampled by way of glass or ideal mirrors.
            const bool sampled = settings_.next_event && !met.passed;
            const double other =
                sampled ? lights_.density(point, scattering.frame(), next->direction, met.hit)
                        : 0.0;
            sum += throughput * emission * (next->density / (next->density + other));
        }
        if (!met.hit || met.hit->absorbs()) {
            break;
        }
        point = *met.hit;
        scattering = Scattering(scene_, point, NormalKind::geometric, -met.direction);
        throughput *= choose_side(point, scattering, sampler);
    }
    return sum;
}

glm::dvec3 PathTracer::next_event(const SurfacePoint& point, const Scattering& scattering,
                                  Sampler& sampler) const {
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
    return value / light->combined_density(scattering.density(light->direction));
}

}  // namespace raybundle
