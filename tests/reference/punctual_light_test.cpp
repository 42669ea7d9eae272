// SPDX-License-Identifier: Apache-2.0
// Punctual lights on the CPU, against closed forms. That the methods agree with one another:
// method_agreement_test.cpp.
#include "scene/light/punctual_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lit_room.h"
#include "luminous_panel.h"
#include "research/single_ray.h"
#include "rooms.h"

namespace raybundle {
namespace {

using std::numbers::pi;
/// A floor of 10 m x 10 m at height 0, black, 2 triangles.
SceneBuilder black_floor() {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    b.add_quad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, 1, 1, b.add_material(glm::vec3(0.0F)));
    return b;
}

/// Illuminance of the floor at x, z, green channel. There is one path only: no noise.
double illuminance(const SceneBuilder& builder, double x, double z) {
    const Tracing tracing(builder);
    // Both triangles have corner (-5, -5) first; the second one has (5, -5)'s side.
    const double u = (z + 5.0) / 10.0;
    const double v = (x + 5.0) / 10.0;
    const std::uint32_t triangle = u >= v ? 0 : 1;
    const glm::dvec2 at = triangle == 0 ? glm::dvec2(u - v, v) : glm::dvec2(u, v - u);
    return irradiance_at(tracing.tracer, tracing.scene.point_on_patch(triangle, at), 4).mean;
}

TEST(PunctualLight, PointLightFollowsInverseSquareAndCosine) {
    SceneBuilder b = black_floor();
    add_punctual_light(b, odd_rotation(), PunctualKind::point, {0, 2, 0}, {0, -1, 0},
                       glm::vec3(100.0F));
    EXPECT_NEAR(illuminance(b, 0.0, 0.0), 25.0, 1e-4);
    for (const glm::dvec2 at : {glm::dvec2(1.5, 0.0), glm::dvec2(-2.0, 3.0), glm::dvec2(4, -4)}) {
        const double distance = std::hypot(at.x, at.y, 2.0);
        EXPECT_NEAR(illuminance(b, at.x, at.y), 200.0 / std::pow(distance, 3), 1e-4);
    }
}

TEST(PunctualLight, DirectionalLightFollowsTheCosineAlone) {
    SceneBuilder b = black_floor();
    add_punctual_light(b, odd_rotation(), PunctualKind::directional, {0, 0, 0}, {1, -1, 0},
                       glm::vec3(1000.0F));
    EXPECT_NEAR(illuminance(b, 0.0, 0.0), 1000.0 * std::sqrt(0.5), 1e-3);
    EXPECT_NEAR(illuminance(b, 3.0, -4.0), 1000.0 * std::sqrt(0.5), 1e-3);
}

/// KHR_lights_punctual's own formula, between the cones and outside of them.
TEST(PunctualLight, SpotFadesBetweenItsCones) {
    SceneBuilder b = black_floor();
    add_punctual_light(b, odd_rotation(), PunctualKind::spot, {0, 2, 0}, {0, -1, 0},
                       glm::vec3(100.0F));
    for (const double degrees : {0.0, 15.0, 25.0, 30.0, 34.0, 36.0, 60.0}) {
        const double cosine = std::cos(glm::radians(degrees));
        const double outer = std::cos(glm::radians(35.0));
        const double share = (cosine - outer) / (std::cos(glm::radians(20.0)) - outer);
        const double attenuation = std::pow(glm::clamp(share, 0.0, 1.0), 2);
        EXPECT_NEAR(illuminance(b, 2.0 * std::tan(glm::radians(degrees)), 0.0),
                    attenuation * 25.0 * std::pow(cosine, 3), 1e-3)
            << degrees;
    }
}

TEST(PunctualLight, WhatStandsInTheWayShades) {
    SceneBuilder b = black_floor();
    b.add_quad({-0.5F, 1, -0.5F}, {0, 0, 1}, {1, 0, 0}, 1, 1, 0);  // faces up, its back blocks
    add_punctual_light(b, odd_rotation(), PunctualKind::point, {0, 2, 0}, {0, -1, 0},
                       glm::vec3(100.0F));
    EXPECT_EQ(illuminance(b, 0.95, 0.95), 0.0);
    EXPECT_GT(illuminance(b, 1.05, 0.0), 0.0);
}

/// A panel of 0.6 m x 0.6 m shines from all of it: paths draw its points. Bounds of 4.5 standard
/// errors.
TEST(PunctualLight, PanelIsAnArea) {
    for (const float height : {0.3F, 1.0F, 3.0F}) {
        SceneBuilder b;
        b.add_quad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, 1, 1, b.add_material(glm::vec3(0.0F)));
        b.scene.punctual_lights.push_back(
            panel_light({{0.1F, height, 0}, {0, -1, 0}, 30.0F}, 0.6, 0.6));
        const Tracing tracing(b);
        const SurfacePoint floor = tracing.scene.point_on_patch(0, {0.0, 0.5});
        const double exact = panel_illuminance(b.scene.punctual_lights[0], 0.6, 0.6,
                                               glm::dvec3(0.0), {0.0, 1.0, 0.0});
        const Estimate found = irradiance_at(tracing.tracer, floor, 40'000);
        EXPECT_NEAR(found.mean, exact, 4.5 * found.standard_error + 1e-3 * exact) << height;
        EXPECT_LT(found.standard_error, 3e-3 * exact) << height;
    }
}

/// Of lights that are chosen by what they bring no sample says more than all of them do together,
/// but for the defensive share; and all choices together say the illuminance.
TEST(PunctualLight, IsChosenByTheLightThatItBrings) {
    SceneBuilder b = black_floor();
    const std::vector<glm::dvec3> positions = {{0, 0.3, 0}, {-4, 2, 1}, {3, 4, -3}, {1, -2, 0}};
    double expected = 0.0;
    for (const glm::dvec3& position : positions) {
        add_punctual_light(b, odd_rotation(), PunctualKind::point, glm::vec3(position), {0, -1, 0},
                           glm::vec3(100.0F));
        expected += 100.0 * std::max(position.y, 0.0) / std::pow(glm::length(position), 3);
    }
    add_punctual_light(b, odd_rotation(), PunctualKind::directional, {0, 0, 0}, {0.6F, -0.8F, 0},
                       glm::vec3(500.0F));
    expected += 0.8 * 500.0;
    const Tracing tracing(b);
    const SurfacePoint floor = tracing.scene.point_on_patch(0, {0.0, 0.5});
    const Frame frame(floor.normal);
    constexpr int choices = 100'000;
    double sum = 0.0;
    for (int i = 0; i < choices; ++i) {
        const auto light =
            tracing.lights.sample(floor, frame, (i + 0.5) / choices, glm::dvec2(0.5));
        ASSERT_TRUE(light);
        const double cosine = std::max(glm::dot(light->direction, frame.z), 0.0);
        const double value = cosine * light->radiance.g / light->density;
        EXPECT_LE(value, 1.001 / 0.9 * expected) << light->punctual;
        sum += value / choices;
    }
    EXPECT_NEAR(sum, expected, 1e-3 * expected);
}

/// The flux that emit() hands out in a closed room of one albedo: Phi/(1 - albedo) in all. The
/// scatter over the batches gives the standard error (7 degrees of freedom): 9 of them are passed
/// by chance once in 20 000.
class EnclosedLamp : public testing::TestWithParam<PunctualKind> {};

TEST_P(EnclosedLamp, OfThousandLumenGivesThousandLumen) {
    constexpr double albedo = 0.5;
    SceneBuilder b;
    b.set_transform(odd_rotation());
    b.add_box({0, 0, 0}, {4, 4, 4}, true, 2, b.add_material(glm::vec3(albedo)));
    const double solid_angle =
        GetParam() == PunctualKind::point
            ? 4.0 * pi
            : 2.0 * pi *
                  (1.0 - std::cos(glm::radians(20.0)) +
                   (std::cos(glm::radians(20.0)) - std::cos(glm::radians(35.0))) / 3.0);
    add_punctual_light(b, odd_rotation(), GetParam(), {1.0F, 2.5F, 1.2F}, {0.3F, -1, 0.2F},
                       glm::vec3(static_cast<float>(1000.0 / solid_angle)));
    const Tracing tracing(b);
    SingleRay solution(tracing.scene, tracing.lights, 5);
    for (int i = 0; i < 64; ++i) {
        solution.iterate();
    }
    double flux = 0.0;
    double variance = 0.0;
    for (std::uint32_t patch = 0; patch < b.mesh.patch_count(); ++patch) {
        const double area = tracing.scene.patch_area(patch) * tracing.scene.square_metres();
        flux += area * solution.irradiance(patch).g;
        variance += std::pow(area * solution.standard_error(patch).g, 2);
    }
    EXPECT_NEAR(flux, 1000.0 / (1.0 - albedo), 9.0 * std::sqrt(variance) + 0.01);
    EXPECT_LT(std::sqrt(variance), 10.0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EnclosedLamp,
                         testing::Values(PunctualKind::point, PunctualKind::spot),
                         [](const auto& test) {
                             return test.param == PunctualKind::spot ? "spot" : "point";
                         });

}  // namespace
}  // namespace raybundle
