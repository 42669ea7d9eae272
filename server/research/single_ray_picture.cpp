// SPDX-License-Identifier: Apache-2.0
#include "research/single_ray_picture.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace raybundle {
namespace {

constexpr std::uint32_t batches = SingleRay::batches;

std::vector<glm::dvec3> patch_irradiance(const RayScene& scene, const SingleRay& solution) {
    std::vector<glm::dvec3> result(scene.mesh().side_count());
    for (std::uint32_t patch = 0; patch < result.size(); ++patch) {
        result[patch] = solution.irradiance(patch);
    }
    return result;
}

std::vector<InterpolatedIrradiance> batch_irradiance(const RayScene& scene,
                                                     const SingleRay& solution) {
    std::vector<InterpolatedIrradiance> result;
    std::vector<glm::dvec3> patches(scene.mesh().side_count());
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
            patches[patch] = solution.batch_irradiance(patch, batch);
        }
        result.emplace_back(scene, patches);
    }
    return result;
}

double particles_per_batch(const SingleRay& solution) {
    return static_cast<double>(solution.iterations()) * SingleRay::particles_per_batch;
}

}  // namespace

SingleRayPicture::SingleRayPicture(const RayScene& scene, const CameraRays& camera,
                                   std::uint64_t seed)
    : scene_(scene), camera_(camera), seed_(seed), centres_(pixel_centres(scene, camera)) {}

void SingleRayPicture::follow(SingleRay& solution) {
    if (!solution.glossy() || solution.iterations() % iterations_per_look != 0) {
        return;
    }
    looks_.resize(centres_.size() * batches, glm::vec3(0.0F));
    look(solution, looks_);
    ++look_count_;
    solution.restart_incoming();
}

void SingleRayPicture::look(const SingleRay& solution, std::vector<glm::vec3>& sums) const {
    tbb::parallel_for(std::size_t{0}, centres_.size(), [&](std::size_t pixel) {
        const glm::dvec2 corner = camera_.corner(pixel);
        for (std::uint32_t batch = 0; batch < batches; ++batch) {
            PixelSampler sampler(seed_, static_cast<std::uint32_t>(pixel), batch, look_count_);
            const glm::dvec3 direction = camera_.direction(corner + sampler.next_pair());
            sums[pixel * batches + batch] +=
                glm::vec3(beyond_main_part(solution, batch, direction));
        }
    });
}

/// What the incoming sample of the patch in this direction adds to the main part.
glm::dvec3 SingleRayPicture::beyond_main_part(const SingleRay& solution, std::uint32_t batch,
                                              const glm::dvec3& direction) const {
    const std::optional<SurfacePoint> hit = scene_.trace(camera_.origin(), direction);
    if (!hit || hit->absorbs()) {
        return glm::dvec3(0.0);
    }
    const IncomingSample& in = solution.incoming(hit->patch, batch);
    if (!(in.importance > 0.0)) {
        return glm::dvec3(0.0);
    }
    const Scattering scattering(scene_, *hit, NormalKind::shading, -direction);
    const glm::dvec3 irradiance = in.importance_sum / in.importance /
                                  scene_.patch_area(hit->patch) * glm::dvec3(in.light.power);
    const std::uint32_t material = scene_.mesh().triangle_material[hit->triangle];
    return irradiance * scattering.reflectance(in.direction_from(hit->position)) -
           main_part(solution.tables(), material, scattering, irradiance);
}

/// The looks and, where iterations have passed since the last one, one more.
std::vector<glm::vec3> SingleRayPicture::looks_so_far(const SingleRay& solution) const {
    std::vector<glm::vec3> sums = looks_;
    if (solution.glossy() && solution.iterations() % iterations_per_look != 0) {
        sums.resize(centres_.size() * batches, glm::vec3(0.0F));
        look(solution, sums);
    }
    return sums;
}

std::vector<glm::dvec3> SingleRayPicture::picture(const SingleRay& solution) const {
    std::vector<glm::dvec3> result =
        picture_of(scene_, solution.tables(), camera_,
                   InterpolatedIrradiance(scene_, patch_irradiance(scene_, solution)));
    const std::vector<glm::vec3> looks = looks_so_far(solution);
    for (std::size_t i = 0; i < looks.size(); ++i) {
        result[i / batches] += glm::dvec3(looks[i]) / (batches * particles_per_batch(solution));
    }
    return result;
}

glm::dvec3 SingleRayPicture::centre_main_part(const SingleRay& solution, std::size_t pixel,
                                              const InterpolatedIrradiance& irradiance) const {
    const SurfacePoint& point = *centres_[pixel];
    const Scattering scattering(scene_, point, NormalKind::shading,
                                glm::normalize(camera_.origin() - point.position));
    return main_part(solution.tables(), scene_.mesh().triangle_material[point.triangle], scattering,
                     irradiance.at(point));
}

ImageError SingleRayPicture::error(const SingleRay& solution,
                                   const std::vector<bool>& measured) const {
    const std::vector<InterpolatedIrradiance> irradiance = batch_irradiance(scene_, solution);
    const std::vector<glm::vec3> looks = looks_so_far(solution);
    BatchScatter scatter(batches);
    for (std::size_t pixel = 0; pixel < centres_.size(); ++pixel) {
        const auto& point = centres_[pixel];
        if (!measured[pixel] || !point || point->absorbs()) {
            continue;
        }
        std::array<glm::dvec3, batches> values;
        glm::dvec3 mean(0.0);
        for (std::uint32_t batch = 0; batch < batches; ++batch) {
            values[batch] = centre_main_part(solution, pixel, irradiance[batch]);
            if (!looks.empty()) {
                values[batch] +=
                    glm::dvec3(looks[pixel * batches + batch]) / particles_per_batch(solution);
            }
            mean += values[batch] / double{batches};
        }
        for (glm::dvec3& value : values) {
            value = (value - mean) * std::sqrt(1.0 / batches);
        }
        scatter.add(values, mean);
    }
    return scatter.error();
}

}  // namespace raybundle
