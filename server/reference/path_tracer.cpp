// SPDX-License-Identifier: Apache-2.0
#include "reference/path_tracer.h"

#include <algorithm>

#include "scene/light/environment.h"

namespace raybundle {

PathTracer::PathTracer(const RayScene& scene, const LightSampling& lights,
                       const PathSettings& settings)
    : scene_(scene), lights_(lights), settings_(settings) {
    if (settings.survival == Survival::albedo) {
        tables_.emplace(scene.scene());
    }
    if (scene.scene().medium) {
        air_.emplace(scene, lights, settings.panes);
    }
}

/// Chance with which a path survives the reflection that its throughput includes already.
double PathTracer::survival_chance(const PathEnd& end) const {
    switch (settings_.survival) {
        case Survival::albedo:
            return largest_channel(tables_->albedo(
                scene_.mesh().triangle_material[end.point.triangle], end.scattering));
        case Survival::fixed:
            return settings_.survival_probability;
        case Survival::throughput:
            break;
    }
    return std::min(largest_channel(end.throughput), 1.0);
}

glm::dvec3 PathTracer::radiance(const glm::dvec3& origin, const glm::dvec3& direction,
                                Sampler& sampler) const {
    if (air_) {
        return fly(from_eye(origin, direction), sampler);
    }
    const Seen seen = see(origin, direction, sampler);
    return seen.end ? seen.emitted + reflected(*seen.end, sampler) : seen.emitted;
}

glm::dvec3 PathTracer::indirect(const glm::dvec3& origin, const glm::dvec3& direction,
                                Sampler& sampler) const {
    if (air_) {
        Flight flight = from_eye(origin, direction);
        flight.sends = false;
        return fly(flight, sampler);
    }
    const SpecularWalk walk = walk_from_eye(scene_, origin, direction, sampler);
    const std::optional<PathEnd> end = end_of(walk, sampler);
    return end ? reflected(*end, sampler) : glm::dvec3(0.0);
}

Seen PathTracer::see(const glm::dvec3& origin, const glm::dvec3& direction,
                     Sampler& sampler) const {
    const SpecularWalk walk = walk_from_eye(scene_, origin, direction, sampler);
    if (walk.luminaire) {
        return {walk.weight * *walk.luminaire, {}};
    }
    if (!walk.hit) {
        return {walk.weight * background_towards(scene_.scene(), walk.direction), {}};
    }
    Seen seen{walk.weight * scene_.shown_emission(*walk.hit), {}};
    if (!walk.hit->absorbs()) {
        PathEnd end{*walk.hit, Scattering(scene_, *walk.hit, NormalKind::shading, -walk.direction),
                    walk.weight, 0, walk.passed};
        end.throughput *= choose_side(end.point, end.scattering, sampler);
        seen.end = end;
    }
    return seen;
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
    return glm::pi<double>() * reflected({point, Scattering::white(point)}, sampler);
}

std::optional<PathEnd> PathTracer::end_of(const SpecularWalk& walk, Sampler& sampler) const {
    if (!walk.hit || walk.hit->absorbs()) {
        return std::nullopt;
    }
    PathEnd end{*walk.hit, Scattering(scene_, *walk.hit, NormalKind::geometric, -walk.direction),
                walk.weight, 0, walk.passed};
    end.throughput *= choose_side(end.point, end.scattering, sampler);
    return end;
}

glm::dvec3 PathTracer::emitted(const std::optional<SurfacePoint>& hit,
                               const glm::dvec3& direction) const {
    return hit ? scene_.emission(*hit) : sky_towards(scene_.scene(), direction);
}

glm::dvec3 PathTracer::reflected(PathEnd end, Sampler& sampler) const {
    glm::dvec3 sum(0.0);
    if (air_) {
        Flight flight;
        flight.throughput = end.throughput;
        flight.bounces = end.bounces;
        return leave(flight, end, sum, sampler) ? sum + fly(flight, sampler) : sum;
    }
    while (end.bounces < settings_.max_bounces && advance(end, sum, sampler)) {
    }
    return sum;
}

bool PathTracer::advance(PathEnd& end, glm::dvec3& sum, Sampler& sampler) const {
    const int samples = settings_.next_event ? light_samples(end) : 0;
    for (int i = 0; i < samples; ++i) {
        sum += end.throughput *
               next_event(lights_, end.point, end.scattering, 1.0 / samples, sampler,
                          settings_.panes) /
               static_cast<double>(samples);
    }
    const glm::dvec2 u = sampler.next_pair();
    const std::optional<ScatterSample> next = end.scattering.sample(u, sampler.next());
    if (!next) {
        return false;
    }
    end.throughput *= next->weight;
    if (end.bounces >= settings_.certain_bounces) {
        const double chance = survival_chance(end);
        if (sampler.next() >= chance) {
            return false;
        }
        end.throughput /= chance;
    }
    const SpecularWalk met = walk_specular(scene_, scene_.trace_from(end.point, next->direction),
                                           next->direction, Carried::radiance, sampler);
    end.throughput *= met.weight;
    const glm::dvec3 emission = emitted(met.hit, met.direction);
    if (emission != glm::dvec3(0.0)) {
        // No light is sampled by way of glass or ideal mirrors.
        const bool sampled = settings_.next_event && !met.passed;
        const double other =
            sampled ? lights_.density(end.point, end.scattering.frame(), next->direction, met.hit)
                    : 0.0;
        sum += end.throughput * emission * power_heuristic(next->density, samples * other);
    }
    if (!met.hit || met.hit->absorbs()) {
        return false;
    }
    end.point = *met.hit;
    end.scattering = Scattering(scene_, end.point, NormalKind::geometric, -met.direction);
    end.passed = met.passed;
    ++end.bounces;
    end.throughput *= choose_side(end.point, end.scattering, sampler);
    return true;
}

}  // namespace raybundle
