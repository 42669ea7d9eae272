// SPDX-License-Identifier: Apache-2.0
#include "research/photon_tracer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "reference/sampling/random.h"
#include "reference/sampling/roulette.h"
#include "reference/specular_walk.h"

namespace raybundle {
namespace {

constexpr std::uint32_t particles_per_task = 1024;

struct Photons {
    std::vector<Photon> global, caustic;
};

/// Follows one particle of settings.emitted.
void follow(const RayScene& scene, const LightSampling& lights, const PhotonSettings& settings,
            PixelSampler& sampler, Photons& photons) {
    const double choice = sampler.next();
    const glm::dvec2 at = sampler.next_pair();
    const EmittedParticle particle = lights.emit(choice, at, sampler.next_pair());
    if (particle.power == glm::dvec3(0.0)) {
        return;
    }
    const double share = 1.0 / settings.emitted;
    glm::dvec3 power = particle.power;
    SpecularWalk way = walk_specular(scene, first_hit(scene, particle), particle.direction,
                                     Carried::power, sampler);
    bool by_sharp_alone = true;
    for (int bounce = 0; bounce < max_bounces && way.hit && !way.hit->absorbs(); ++bounce) {
        power *= way.weight;
        const Scattering scattering(scene, *way.hit, NormalKind::geometric, -way.direction);
        const bool sharp = is_sharp(scattering, settings);
        if (!sharp) {
            const Photon photon{glm::vec3(way.hit->position), glm::vec3(way.hit->normal),
                                glm::vec3(-way.direction), glm::vec3(power * share)};
            photons.global.push_back(photon);
            if (by_sharp_alone && (bounce > 0 || way.passed)) {
                photons.caustic.push_back(photon);
            }
            by_sharp_alone = false;
        }
        const glm::dvec2 u = sampler.next_pair();
        const std::optional<ScatterSample> next = scattering.sample(u, sampler.next());
        if (!next) {
            return;
        }
        power *= next->weight;
        if (!survives(power, particle.power, sampler.next())) {
            return;
        }
        way = walk_specular(scene, scene.trace_from(*way.hit, next->direction), next->direction,
                            Carried::power, sampler);
    }
}

std::vector<Photon> joined(const std::vector<Photons>& tasks,
                           std::vector<Photon> Photons::*member) {
    std::vector<Photon> all;
    for (const Photons& task : tasks) {
        all.insert(all.end(), (task.*member).begin(), (task.*member).end());
    }
    return all;
}

}  // namespace

PhotonMaps trace_photons(const RayScene& scene, const LightSampling& lights,
                         const PhotonSettings& settings, std::uint64_t seed, std::uint64_t number) {
    if (lights.empty()) {
        return {};
    }
    const std::uint32_t task_count =
        (settings.emitted + particles_per_task - 1) / particles_per_task;
    std::vector<Photons> tasks(task_count);
    tbb::parallel_for(std::uint32_t{0}, task_count, [&](std::uint32_t task) {
        const std::uint32_t first = task * particles_per_task;
        const std::uint32_t last = std::min(first + particles_per_task, settings.emitted);
        for (std::uint32_t i = first; i < last; ++i) {
            PixelSampler sampler(seed, static_cast<std::uint32_t>(number),
                                 static_cast<std::uint32_t>(number >> 32U), i);
            follow(scene, lights, settings, sampler, tasks[task]);
        }
    });
    return {PhotonMap(joined(tasks, &Photons::global)),
            PhotonMap(joined(tasks, &Photons::caustic))};
}

}  // namespace raybundle
