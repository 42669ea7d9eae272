// SPDX-License-Identifier: Apache-2.0
#include "research/light_tracer.h"

#include <cmath>

#include "reference/sampling/roulette.h"
#include "reference/scattering.h"
#include "reference/specular_walk.h"
#include "scene/light/environment.h"

namespace raybundle {
glm::dvec3 LightTracer::radiance(const glm::dvec3& direction, PixelSampler& sampler,
                                 std::vector<Splat>& splats) const {
    if (!lights_.empty()) {
        follow_particle(sampler, splats);
    }
    const SpecularWalk seen = walk_specular(scene_, scene_.trace(camera_.origin(), direction),
                                            direction, Carried::radiance, sampler);
    return seen.weight * (seen.hit ? scene_.shown_emission(*seen.hit)
                                   : background_towards(scene_.scene(), seen.direction));
}

void LightTracer::follow_particle(PixelSampler& sampler, std::vector<Splat>& splats) const {
    const double choice = sampler.next();
    const glm::dvec2 at = sampler.next_pair();
    const EmittedParticle particle = lights_.emit(choice, at, sampler.next_pair());
    if (particle.power == glm::dvec3(0.0)) {
        return;
    }
    glm::dvec3 power = particle.power;
    SpecularWalk way = walk_specular(scene_, first_hit(scene_, particle), particle.direction,
                                     Carried::power, sampler);
    for (int bounce = 0; bounce < max_bounces && way.hit && !way.hit->absorbs(); ++bounce) {
        power *= way.weight;
        show(*way.hit, -way.direction, power, splats);
        const Scattering scattering(scene_, *way.hit, NormalKind::geometric, -way.direction);
        const glm::dvec2 u = sampler.next_pair();
        const std::optional<ScatterSample> next = scattering.sample(u, sampler.next());
        if (!next) {
            return;
        }
        power *= next->weight;
        if (!survives(power, particle.power, sampler.next())) {
            return;
        }
        way = walk_specular(scene_, scene_.trace_from(*way.hit, next->direction), next->direction,
                            Carried::power, sampler);
    }
}

/// What a point that receives `power` from a direction shows to the eye.
void LightTracer::show(const SurfacePoint& point, const glm::dvec3& from, const glm::dvec3& power,
                       std::vector<Splat>& splats) const {
    const glm::dvec3 offset = camera_.origin() - point.position;
    const double square = glm::dot(offset, offset);
    const glm::dvec3 to_eye = offset / std::sqrt(square);
    const double leaving = glm::dot(to_eye, point.normal);
    const std::optional<FilmPoint> film = camera_.project(-to_eye);
    if (!film || !(leaving > 0.0)) {
        return;
    }
    // evaluate() has the cosine of the normal that the picture shows; power is per area across the
    // geometric one.
    const Scattering seen(scene_, point, NormalKind::shading, to_eye);
    const glm::dvec3 reflected = power * seen.evaluate(from) / glm::dot(from, point.normal);
    if (reflected == glm::dvec3(0.0) || !scene_.sees_point(point, camera_.origin())) {
        return;
    }
    const double seen_from_eye = leaving / square * film->importance;
    splats.push_back({film->pixel, reflected * seen_from_eye * camera_.pixel_share()});
}

}  // namespace raybundle
