// SPDX-License-Identifier: Apache-2.0
#include "research/photon_mapper.h"

#include "reference/sampling/next_event.h"
#include "reference/sampling/roulette.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

constexpr int certain_bounces = 3;  // before Russian roulette begins
constexpr int max_gatherings = 8;   // in a corner, one from the other

}  // namespace

glm::dvec3 PhotonMapper::radiance(const PhotonMaps& maps, const glm::dvec3& origin,
                                  const glm::dvec3& direction, PixelSampler& sampler) const {
    const SpecularWalk seen = walk_specular(scene_, scene_.trace(origin, direction), direction,
                                            Carried::radiance, sampler);
    if (!seen.hit) {
        return seen.weight * background_towards(scene_.scene(), seen.direction);
    }
    glm::dvec3 sum = scene_.shown_emission(*seen.hit);
    if (!seen.hit->absorbs()) {
        const Scattering scattering(scene_, *seen.hit, NormalKind::shading, -seen.direction);
        sum += is_sharp(scattering, settings_)
                   ? by_sharp(maps, *seen.hit, scattering, sampler)
                   : by_maps(maps, *seen.hit, scattering, max_gatherings, sampler);
    }
    return seen.weight * sum;
}

/// What a direction drawn at a point meets behind mirrors and glass.
SpecularWalk PhotonMapper::met_by(const SurfacePoint& point, const ScatterSample& drawn,
                                  PixelSampler& sampler) const {
    return walk_specular(scene_, scene_.trace_from(point, drawn.direction), drawn.direction,
                         Carried::radiance, sampler);
}

/// Emission of what a direction drawn at a point has met.
glm::dvec3 PhotonMapper::met_light(const SurfacePoint& point, const Scattering& scattering,
                                   const ScatterSample& drawn, const SpecularWalk& met) const {
    const glm::dvec3 emission =
        met.hit ? scene_.emission(*met.hit) : sky_towards(scene_.scene(), met.direction);
    if (emission == glm::dvec3(0.0) || met.passed) {
        return emission;  // behind mirrors and glass next_event() finds none
    }
    const double other = lights_.density(point, scattering.frame(), drawn.direction, met.hit);
    return emission * power_heuristic(drawn.density, other);
}

/// Light reflected by an S surface: path tracing up to the first D surface.
glm::dvec3 PhotonMapper::by_sharp(const PhotonMaps& maps, SurfacePoint point, Scattering scattering,
                                  PixelSampler& sampler) const {
    glm::dvec3 sum(0.0);
    glm::dvec3 throughput(1.0);
    for (int bounce = 0; bounce < max_bounces; ++bounce) {
        sum += throughput * next_event(lights_, point, scattering, 1.0, sampler);
        const glm::dvec2 u = sampler.next_pair();
        const std::optional<ScatterSample> next = scattering.sample(u, sampler.next());
        if (!next) {
            break;
        }
        throughput *= next->weight;
        if (bounce >= certain_bounces && !survives(throughput, glm::dvec3(1.0), sampler.next())) {
            break;
        }
        const SpecularWalk met = met_by(point, *next, sampler);
        throughput *= met.weight;
        sum += throughput * met_light(point, scattering, *next, met);
        if (!met.hit || met.hit->absorbs()) {
            break;
        }
        point = *met.hit;
        scattering = Scattering(scene_, point, NormalKind::geometric, -met.direction);
        if (!is_sharp(scattering, settings_)) {
            return sum + throughput * by_maps(maps, point, scattering, max_gatherings, sampler);
        }
    }
    return sum;
}

/// Light reflected by a D surface.
glm::dvec3 PhotonMapper::by_maps(const PhotonMaps& maps, const SurfacePoint& point,
                                 const Scattering& scattering, int gatherings,
                                 PixelSampler& sampler) const {
    return next_event(lights_, point, scattering, 1.0, sampler) +
           maps.caustic.reflected(point, scattering, settings_.nearest, radius_) +
           gathered(maps, point, scattering, gatherings, sampler);
}

/// Final gathering: emission that the ray meets at once, and light that has left a D surface last,
/// or one before S surfaces. Emission behind S surfaces is a caustic: by_maps() has it.
glm::dvec3 PhotonMapper::gathered(const PhotonMaps& maps, SurfacePoint point, Scattering scattering,
                                  int gatherings, PixelSampler& sampler) const {
    glm::dvec3 direct(0.0);
    glm::dvec3 throughput(1.0);
    for (int bounce = 0; bounce < max_bounces; ++bounce) {
        const glm::dvec2 u = sampler.next_pair();
        const std::optional<ScatterSample> next = scattering.sample(u, sampler.next());
        if (!next) {
            break;
        }
        throughput *= next->weight;
        if (bounce >= certain_bounces && !survives(throughput, glm::dvec3(1.0), sampler.next())) {
            break;
        }
        const SpecularWalk met = met_by(point, *next, sampler);
        throughput *= met.weight;
        if (bounce == 0 && !met.passed) {
            direct = throughput * met_light(point, scattering, *next, met);
        }
        if (!met.hit || met.hit->absorbs()) {
            break;
        }
        const double distance = glm::distance(point.position, met.hit->position);
        point = *met.hit;
        scattering = Scattering(scene_, point, NormalKind::geometric, -met.direction);
        if (!is_sharp(scattering, settings_)) {
            const bool near = distance < radius_ && gatherings > 0;
            return direct +
                   throughput * (near ? by_maps(maps, point, scattering, gatherings - 1, sampler)
                                      : maps.global.reflected(point, scattering, settings_.nearest,
                                                              radius_));
        }
    }
    return direct;
}

}  // namespace raybundle
