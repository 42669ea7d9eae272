// SPDX-License-Identifier: Apache-2.0
// Paths through air that absorbs and scatters.
#include <algorithm>

#include "reference/path_tracer.h"
#include "scene/light/environment.h"

namespace raybundle {

PathTracer::Flight PathTracer::from_eye(const glm::dvec3& origin, const glm::dvec3& direction) {
    Flight flight;
    flight.origin = origin;
    flight.direction = direction;
    return flight;
}

glm::dvec3 PathTracer::fly(Flight flight, Sampler& sampler) const {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < settings_.max_bounces; ++i) {
        const std::optional<SurfacePoint> hit =
            flight.surface ? scene_.trace_from(*flight.surface, flight.direction)
                           : scene_.trace(flight.origin, flight.direction);
        const bool inside = hit && ends_inside_glass(scene_, *hit);
        WayInBox way = inside ? WayInBox{} : air_->way(flight.origin, flight.direction, hit);
        const auto luminaire = flight.density > 0.0
                                   ? std::nullopt
                                   : scene_.luminaire_before(flight.origin, flight.direction, hit);
        if (luminaire) {
            way.end = std::min(way.end, luminaire->distance);
        }
        if (settings_.next_event) {
            sum +=
                flight.throughput * air_->punctual(flight.origin, flight.direction, way, sampler);
        }
        const std::optional<double> collision = air_->collision(way, sampler.next());
        if (luminaire && !collision) {
            sum += flight.throughput * (flight.sends ? luminaire->luminance : glm::dvec3(0.0));
            break;
        }
        if (collision ? !collide(flight, *collision, sum, sampler)
                      : hit && !arrive(flight, *hit, sum, sampler)) {
            break;
        }
        if (!collision && !hit) {
            if (flight.sends) {
                const glm::dvec3 sky = flight.density > 0.0
                                           ? sky_towards(scene_.scene(), flight.direction)
                                           : background_towards(scene_.scene(), flight.direction);
                sum += flight.throughput * sky * weight_of_met(flight, hit);
            }
            break;
        }
    }
    return sum;
}

/// Weight of light that a path meets by itself, beside that which is sampled.
double PathTracer::weight_of_met(const Flight& flight,
                                 const std::optional<SurfacePoint>& hit) const {
    // No light is sampled by way of glass or ideal mirrors.
    if (!settings_.next_event || flight.passed || flight.density <= 0.0) {
        return 1.0;
    }
    if (flight.vertex) {
        return power_heuristic(flight.density,
                               air_->emitter_density(*flight.vertex, flight.direction, hit));
    }
    return power_heuristic(
        flight.density,
        flight.light_samples *
            lights_.density(*flight.surface, flight.reflected->frame(), flight.direction, hit));
}

bool PathTracer::survives(Flight& flight, double chance, Sampler& sampler) {
    if (sampler.next() >= chance) {
        return false;
    }
    flight.throughput /= chance;
    return true;
}

/// The path is scattered by the air. False where it ends.
bool PathTracer::collide(Flight& flight, double distance, glm::dvec3& sum, Sampler& sampler) const {
    flight.throughput *= glm::dvec3(air_->medium().albedo);
    if (flight.throughput == glm::dvec3(0.0)) {
        return false;
    }
    if (flight.bounces >= settings_.certain_bounces &&
        !survives(flight, std::min(largest_channel(flight.throughput), 1.0), sampler)) {
        return false;
    }
    const AirVertex at{flight.origin + distance * flight.direction, flight.direction};
    if (settings_.next_event) {
        sum += flight.throughput * air_->emitters(at, sampler);
    }
    const double anisotropy = air_->medium().anisotropy;
    const glm::dvec3 direction =
        scattered_direction(anisotropy, flight.direction, sampler.next_pair());
    flight.density = phase_of(anisotropy, glm::dot(direction, flight.direction));
    flight.origin = at.position;
    flight.direction = direction;
    flight.surface.reset();
    flight.vertex = at;
    flight.light_samples = 1;
    flight.passed = false;
    flight.sends = true;
    ++flight.bounces;
    return true;
}

/// The path is at a surface. False where it ends.
bool PathTracer::arrive(Flight& flight, const SurfacePoint& hit, glm::dvec3& sum,
                        Sampler& sampler) const {
    if (const auto ray = deflect(scene_, hit, flight.direction, Carried::radiance, sampler)) {
        if (flight.passed && flight.surface) {
            flight.throughput *= left_of_way(scene_, flight.origin, hit);
        }
        flight.throughput *= ray->weight;
        flight.surface = ray->departure;
        flight.origin = ray->departure.position;
        flight.direction = ray->direction;
        flight.passed = true;
        return true;
    }
    const bool seen = flight.density <= 0.0;
    if (flight.sends) {
        const glm::dvec3 emission = seen ? scene_.shown_emission(hit) : scene_.emission(hit);
        if (emission != glm::dvec3(0.0)) {
            sum += flight.throughput * emission * weight_of_met(flight, hit);
        }
    }
    if (hit.absorbs()) {
        return false;
    }
    PathEnd end{hit,
                Scattering(scene_, hit, seen ? NormalKind::shading : NormalKind::geometric,
                           -flight.direction),
                flight.throughput, flight.bounces, flight.passed};
    end.throughput *= choose_side(end.point, end.scattering, sampler);
    return leave(flight, end, sum, sampler);
}

/// Adds the light of lamps and sky that a surface reflects, and goes on from it.
bool PathTracer::leave(Flight& flight, PathEnd& end, glm::dvec3& sum, Sampler& sampler) const {
    const int samples = settings_.next_event ? light_samples(end) : 0;
    for (int i = 0; i < samples; ++i) {
        sum += end.throughput * sampled_light(end, 1.0 / samples, sampler) /
               static_cast<double>(samples);
    }
    const glm::dvec2 u = sampler.next_pair();
    const std::optional<ScatterSample> next = end.scattering.sample(u, sampler.next());
    if (!next) {
        return false;
    }
    end.throughput *= next->weight;
    flight.throughput = end.throughput;
    if (end.bounces >= settings_.certain_bounces &&
        !survives(flight, survival_chance(end), sampler)) {
        return false;
    }
    flight.origin = end.point.position;
    flight.direction = next->direction;
    flight.surface = end.point;
    flight.reflected = end.scattering;
    flight.vertex.reset();
    flight.density = next->density;
    flight.light_samples = samples;
    flight.bounces = end.bounces + 1;
    flight.passed = false;
    flight.sends = true;
    return true;
}

/// next_event() through the air.
glm::dvec3 PathTracer::sampled_light(const PathEnd& end, double lobe_samples,
                                     Sampler& sampler) const {
    if (lights_.empty()) {
        return glm::dvec3(0.0);
    }
    const double choice = sampler.next();
    const std::optional<LightSample> light =
        lights_.sample(end.point, end.scattering.frame(), choice, sampler.next_pair());
    if (!light) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 value = end.scattering.evaluate(light->direction) * light->radiance;
    if (value == glm::dvec3(0.0)) {
        return value;
    }
    const glm::dvec3 share = settings_.panes == Panes::pass
                                 ? lights_.arriving_share(end.point, *light)
                                 : glm::dvec3(lights_.arrives(end.point, *light) ? 1.0 : 0.0);
    const double other = lobe_samples * end.scattering.density(light->direction);
    return share * value *
           (air_->transmittance_of(end.point.position, *light) * light->weight(other) /
            light->density);
}

}  // namespace raybundle
