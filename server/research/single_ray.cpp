// SPDX-License-Identifier: Apache-2.0
#include "research/single_ray.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "reference/sampling/roulette.h"
#include "reference/scattering.h"

namespace raybundle {
SingleRay::SingleRay(const RayScene& scene, const LightSampling& lights, std::uint64_t seed)
    : scene_(scene),
      lights_(lights),
      seed_(seed),
      tables_(scene.scene()),
      power_(scene.mesh().side_count() * batches, glm::dvec3(0.0)),
      incoming_(tables_.glossy() ? power_.size() : 0) {}

void SingleRay::restart_incoming() {
    std::fill(incoming_.begin(), incoming_.end(), IncomingSample{});
}

void SingleRay::iterate() {
    if (!lights_.empty()) {
        std::atomic<std::uint64_t> rays{0};
        tbb::parallel_for(std::uint32_t{0}, batches,
                          [&](std::uint32_t batch) { rays += follow_batch(batch); });
        rays_ += rays;
    }
    ++iterations_;
}

std::uint64_t SingleRay::follow_batch(std::uint32_t batch) {
    std::uint64_t rays = 0;
    for (std::uint32_t i = 0; i < particles_per_batch; ++i) {
        const std::uint64_t index = iterations_ * particles_per_batch + i;
        PixelSampler sampler(seed_, static_cast<std::uint32_t>(index >> 32U), batch,
                             static_cast<std::uint32_t>(index));
        rays += follow_particle(batch, sampler);
    }
    return rays;
}

std::uint64_t SingleRay::follow_particle(std::uint32_t batch, PixelSampler& sampler) {
    const double choice = sampler.next();
    const glm::dvec2 at = sampler.next_pair();
    const EmittedParticle particle = lights_.emit(choice, at, sampler.next_pair());
    glm::dvec3 power = particle.power;
    if (!(largest_channel(power) > 0.0)) {
        return 0;
    }
    glm::dvec3 direction = particle.direction;
    std::optional<glm::dvec3> source;  // nothing: infinitely far away
    if (!particle.distant) {
        source = particle.emitter ? particle.emitter->position : particle.origin;
    }
    std::optional<SurfacePoint> hit = first_hit(scene_, particle);
    std::uint64_t rays = 1;
    for (; rays < max_bounces && hit && !hit->absorbs(); ++rays) {
        const Scattering scattering(scene_, *hit, NormalKind::geometric, -direction);
        const auto inverse_distance =
            static_cast<float>(source ? 1.0 / glm::distance(*source, hit->position) : 0.0);
        receive(
            *hit, scattering, batch, power,
            {glm::vec3(power), glm::vec3(hit->position), glm::vec3(-direction), inverse_distance},
            sampler);
        const glm::dvec2 u = sampler.next_pair();
        const std::optional<ScatterSample> next = scattering.sample(u, sampler.next());
        const double roulette = sampler.next();
        if (!next) {
            break;
        }
        const glm::dvec3 before = std::exchange(power, power * next->weight);
        if (!survives(power, before, roulette)) {
            break;
        }
        direction = next->direction;
        source = hit->position;
        hit = scene_.trace_from(*hit, direction);
    }
    return rays;
}

void SingleRay::receive(const SurfacePoint& point, const Scattering& scattering,
                        std::uint32_t batch, const glm::dvec3& power, const IncomingLight& light,
                        PixelSampler& sampler) {
    power_[index(point.patch, batch)] += power;
    if (!scattering.is_lambert()) {
        const std::uint32_t material = scene_.mesh().triangle_material[point.triangle];
        const double importance = largest_channel(power) * tables_.importance(material, scattering);
        incoming_[index(point.patch, batch)].add(light, importance, sampler.next());
    }
}

glm::dvec3 SingleRay::batch_irradiance(std::uint32_t patch, std::uint32_t batch) const {
    const double particles = static_cast<double>(iterations_) * particles_per_batch;
    const double area = scene_.patch_area(patch);
    return area > 0.0 && particles > 0.0 ? power_[index(patch, batch)] / (area * particles)
                                         : glm::dvec3(0.0);
}

glm::dvec3 SingleRay::irradiance(std::uint32_t patch) const {
    glm::dvec3 sum(0.0);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        sum += batch_irradiance(patch, batch);
    }
    return sum / double{batches};
}

glm::dvec3 SingleRay::standard_error(std::uint32_t patch) const {
    const glm::dvec3 mean = irradiance(patch);
    glm::dvec3 scatter(0.0);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        const glm::dvec3 deviation = batch_irradiance(patch, batch) - mean;
        scatter += deviation * deviation;
    }
    return glm::sqrt(scatter / double{batches * (batches - 1)});
}

}  // namespace raybundle
