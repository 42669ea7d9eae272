// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_caster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/image_estimate.h"
#include "rooms.h"

namespace raybundle {
namespace {

/// Luminance of a picture of the furnished enclosure and its standard error, by any estimator.
Estimate mean_radiance(const Tracing& tracing, const RadianceEstimator& estimator,
                       std::uint64_t seed) {
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(2.0F, 2.0F, 0.2F, 1.0F));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(1.5F, 0.5F, 4.0F, 1.0F));
    camera.vertical_fov = 1.2F;
    constexpr glm::uvec2 size(16, 16);
    ImageEstimate image(size, seed);
    const CameraRays rays(tracing.scene, camera, size);
    for (int i = 0; i < 256; ++i) {
        image.add_pass(rays, estimator);
    }
    Estimate result;
    for (std::size_t i = 0; i < 256; ++i) {
        result.mean += image.mean(i).g / 256.0;
        result.standard_error += std::pow(image.standard_error(i).g / 256.0, 2);
    }
    result.standard_error = std::sqrt(result.standard_error);
    return result;
}

SceneBuilder furnished() {
    SceneBuilder b = enclosure(0.8F);
    b.add_box({1, 0, 1}, {2.5F, 1, 2.5F}, false, 1, 0);
    return b;
}

/// Emission and one reflection, nothing more: what path tracing finds within one bounce. Pixels are
/// independent: 4.5 standard errors are passed by chance once in 150 000.
TEST(RayCaster, IsPathTracingOfOneBounce) {
    const SceneBuilder room = furnished();
    PathSettings one_bounce;
    one_bounce.max_bounces = 1;
    const Tracing t(room, one_bounce);
    const RayCaster caster(t.scene, t.lights);
    const Estimate cast = mean_radiance(
        t,
        [&](const glm::dvec3& o, const glm::dvec3& d, PixelSampler& s) {
            return caster.radiance(o, d, s);
        },
        1);
    const Estimate traced = mean_radiance(
        t,
        [&](const glm::dvec3& o, const glm::dvec3& d, PixelSampler& s) {
            return t.tracer.radiance(o, d, s);
        },
        2);
    EXPECT_NEAR(cast.mean, traced.mean,
                4.5 * std::hypot(cast.standard_error, traced.standard_error));
    EXPECT_LT(cast.standard_error, 0.01 * cast.mean);
    EXPECT_GT(cast.mean, 0.0);
}

/// On black walls nothing but emission is left, exactly.
TEST(RayCaster, BlackRoomShowsItsLampAlone) {
    const SceneBuilder room = enclosure(0.0F);
    const Tracing t(room);
    const RayCaster caster(t.scene, t.lights);
    const glm::mat4 turn = odd_rotation();
    const auto look = [&](const glm::vec3& direction) {
        PixelSampler sampler(1, 0, 0, 0);
        return caster.radiance(t.scene.from_world(glm::vec3(turn * glm::vec4(1.5F, 1, 1.5F, 1))),
                               glm::dvec3(turn * glm::vec4(direction, 0)), sampler);
    };
    EXPECT_NEAR(look({0, 1, 0}).g, enclosure_flux / glm::pi<double>(), 1e-3);
    EXPECT_EQ(look({0, -1, 0}), glm::dvec3(0.0));
}

}  // namespace
}  // namespace raybundle
