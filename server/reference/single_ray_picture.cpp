// SPDX-License-Identifier: Apache-2.0
#include "reference/single_ray_picture.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "reference/solution_picture.h"

namespace raybundle {
namespace {

constexpr std::uint32_t batches = SingleRay::batches;

std::vector<glm::dvec3> patch_irradiance(const RayScene& scene, const SingleRay& solution) {
    std::vector<glm::dvec3> result(scene.mesh().patch_count());
    for (std::uint32_t patch = 0; patch < result.size(); ++patch) {
        result[patch] = solution.irradiance(patch);
    }
    return result;
}

std::vector<VertexIrradiance> batch_irradiance(const RayScene& scene, const SingleRay& solution) {
    std::vector<VertexIrradiance> result;
    std::vector<glm::dvec3> patches(scene.mesh().patch_count());
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
            patches[patch] = solution.batch_irradiance(patch, batch);
        }
        result.emplace_back(scene, patches);
    }
    return result;
}

}  // namespace

SingleRayPicture::SingleRayPicture(const RayScene& scene, const CameraRays& camera)
    : scene_(scene), camera_(camera), centres_(pixel_centres(scene, camera)) {}

std::vector<glm::dvec3> SingleRayPicture::picture(const SingleRay& solution) const {
    return picture_of(scene_, camera_,
                      VertexIrradiance(scene_, patch_irradiance(scene_, solution)));
}

ImageError SingleRayPicture::error(const SingleRay& solution) const {
    const std::vector<VertexIrradiance> irradiance = batch_irradiance(scene_, solution);
    VarianceSum sum;
    for (const auto& point : centres_) {
        if (!point || point->absorbs() || scene_.emission(*point) != glm::dvec3(0.0)) {
            continue;
        }
        const glm::dvec3 albedo = scene_.albedo(*point);
        std::array<glm::dvec3, batches> values;
        glm::dvec3 mean(0.0);
        for (std::uint32_t batch = 0; batch < batches; ++batch) {
            values[batch] = glm::one_over_pi<double>() * albedo * irradiance[batch].at(*point);
            mean += values[batch] / double{batches};
        }
        glm::dvec3 scatter(0.0);
        for (const glm::dvec3& value : values) {
            scatter += (value - mean) * (value - mean);
        }
        sum.add(mean, scatter / double{batches * (batches - 1)});
    }
    // Pixels of a patch err together: chi-square with 15 degrees of freedom if all did (the
    // cautious end), 2.5 % and 97.5 % quantiles 6.262 and 27.49.
    static_assert(batches == 16);
    return {sum.relative(), sum.relative() * std::sqrt(15.0 / 27.49),
            sum.relative() * std::sqrt(15.0 / 6.262)};
}

}  // namespace raybundle
