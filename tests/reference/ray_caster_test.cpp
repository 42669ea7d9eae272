// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_caster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/measures/image_estimate.h"
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

/// Number of glossy_materials() whose index a parameter below may be; else the box is Lambert.
constexpr int material_count = 3;

SceneBuilder furnished(int material) {
    SceneBuilder b = enclosure(0.8F);
    std::uint32_t box = 0;
    if (material < material_count) {
        box = add_material(b, glossy_materials()[static_cast<std::size_t>(material)].material);
        // The far wall too, so that both sampling techniques matter in most of the picture.
        for (std::size_t i = 0; i < b.mesh.triangle_count(); ++i) {
            if (b.cell_centre(i).z > 3.99F) {
                b.set_triangle_material(i, box);
            }
        }
    }
    b.add_box({1, 0, 1}, {2.5F, 1, 2.5F}, false, 1, box);
    return b;
}

class RayCasterMaterials : public testing::TestWithParam<int> {};

/// Emission and one reflection, nothing more: what path tracing finds within one bounce. Pixels are
/// independent: 4.5 standard errors are passed by chance once in 150 000.
TEST_P(RayCasterMaterials, IsPathTracingOfOneBounce) {
    const SceneBuilder room = furnished(GetParam());
    PathSettings one_bounce;
    one_bounce.max_bounces = 1;
    one_bounce.next_event = false;
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
    EXPECT_LT(traced.standard_error, 0.05 * cast.mean);
    EXPECT_GT(cast.mean, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Materials, RayCasterMaterials, testing::Range(0, material_count + 1));

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
