// SPDX-License-Identifier: Apache-2.0
// Path tracing against closed forms. Bounds in standard errors are 4.5: passed by chance once in
// 150 000; each test also bounds the standard error, so that it can fail.
#include "reference/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rooms.h"

namespace raybundle {
namespace {

using std::numbers::pi;

void expect_estimate(const Estimate& estimate, double exact, double relative_error) {
    EXPECT_NEAR(estimate.mean, exact, sigmas * estimate.standard_error + 1e-9 * exact);
    EXPECT_LT(estimate.standard_error, relative_error * exact);
}

std::uint32_t patch_count(const SceneBuilder& builder) {
    return static_cast<std::uint32_t>(builder.mesh.patch_count());
}

class PathTracerFurnace : public testing::TestWithParam<float> {};

/// Isothermal enclosure (Siegel, Howell): irradiance pi Le/(1 - albedo) everywhere.
TEST_P(PathTracerFurnace, HasTheSameIrradianceEverywhere) {
    const float albedo = GetParam();
    const SceneBuilder room = furnace_room(albedo, 100.0F);
    const Tracing t(room);
    const double exact = pi * 100.0 / (1.0 - static_cast<double>(albedo));
    expect_estimate(mean_irradiance(t.scene, t.tracer, 0, patch_count(room), 40'000), exact, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Albedos, PathTracerFurnace, testing::Values(0.0F, 0.5F, 0.9F, 0.99F));

class PathTracerEnclosure : public testing::TestWithParam<float> {};

/// Flux balance in a closed room of uniform albedo: mean irradiance Phi/(S (1 - albedo)).
TEST_P(PathTracerEnclosure, HasTheMeanIrradianceOfItsFluxBalance) {
    const float albedo = GetParam();
    const SceneBuilder room = enclosure(albedo);
    const Tracing t(room);
    const double exact = enclosure_flux / (enclosure_surface * (1.0 - static_cast<double>(albedo)));
    expect_estimate(mean_irradiance(t.scene, t.tracer, 0, patch_count(room), 100'000), exact,
                    0.005);
}

INSTANTIATE_TEST_SUITE_P(Albedos, PathTracerEnclosure, testing::Values(0.5F, 0.8F, 0.95F));

/// Same room a thousandth and a thousand times as large, and 10 km away: the same illuminance but
/// for the lamp's flux, which grows with its area.
TEST(PathTracer, ScaleAndPlaceDoNotMatter) {
    const auto measure = [](const glm::mat4& where) {
        const SceneBuilder room = enclosure(0.8F, where);
        const Tracing t(room);
        return mean_irradiance(t.scene, t.tracer, 0, patch_count(room), 30'000);
    };
    const Estimate usual = measure(glm::mat4(1.0F));
    for (const float scale : {1e-3F, 1e3F}) {
        const Estimate scaled = measure(glm::scale(glm::mat4(1.0F), glm::vec3(scale)));
        EXPECT_NEAR(scaled.mean / usual.mean, 1.0, 1e-3) << scale;
    }
    SceneBuilder moved = enclosure(0.8F);
    for (Object& object : moved.scene.objects) {
        object.transform.translation += glm::vec3(1e4F, -5e3F, 1e4F);
    }
    moved.scene.bounds.min += glm::vec3(1e4F, -5e3F, 1e4F);
    moved.scene.bounds.max += glm::vec3(1e4F, -5e3F, 1e4F);
    const Tracing t(moved);
    const Estimate far = mean_irradiance(t.scene, t.tracer, 0, patch_count(moved), 30'000);
    EXPECT_NEAR(far.mean / usual.mean, 1.0, 1e-3);
}

/// Form factors of the unit cube (view factor tables, rederived in numerics.md).
TEST(PathTracer, CubeHasItsFormFactors) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
    b.add_box({0, 0, 0}, {1, 1, 1}, true, 2, black);
    const std::uint32_t face = patch_count(b) / 6;  // faces: x0, x1, y0, y1, z0, z1
    for (std::uint32_t i = 4 * face; i < 5 * face; ++i) {
        b.set_triangle_material(i, lamp);
    }
    const Tracing t(b);
    expect_estimate(mean_irradiance(t.scene, t.tracer, 5 * face, 6 * face, 250'000), 0.199825 * pi,
                    0.002);
    expect_estimate(mean_irradiance(t.scene, t.tracer, 0, 4 * face, 400'000), 0.200044 * pi, 0.002);
}

/// A floor of two triangles, [0, 1]^2 in x and z, facing up.
void add_floor(SceneBuilder& b, std::uint32_t material) {
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 1, material);
}

/// Integral over the rectangle [0, x] x [0, z] at height h of E = L cos^2/r^2, per L, signed.
double corner_term(double x, double z, double h) {
    const double p = std::sqrt(x * x + h * h);
    const double q = std::sqrt(z * z + h * h);
    return 0.5 * (x / p * std::atan(z / p) + z / q * std::atan(x / q));
}

TEST(PathTracer, RectangularLampLightsTheFloorAsItsClosedForm) {
    constexpr double h = 0.7;
    SceneBuilder b;
    b.set_transform(odd_rotation());
    add_floor(b, b.add_material(glm::vec3(0.0F)));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_quad({-0.3F, static_cast<float>(h), 0.2F}, {1, 0, 0}, {0, 0, 0.4F}, 2, 3, lamp);
    const Tracing t(b);
    for (const glm::dvec2& at :
         {glm::dvec2(0.1, 0.1), glm::dvec2(0.6, 0.3), glm::dvec2(0.1, 0.8)}) {
        // Triangle (0, 0, 0), (0, 0, 1), (1, 0, 1): x is the last weight.
        const SurfacePoint point = t.scene.point_on_patch(0, at);
        const double x = at.y;
        const double z = at.x + at.y;
        const auto term = [&](double lamp_x, double lamp_z) {
            return corner_term(lamp_x - x, lamp_z - z, h);
        };
        const double exact =
            1000.0 * (term(0.7, 0.6) - term(-0.3, 0.6) - term(0.7, 0.2) + term(-0.3, 0.2));
        expect_estimate(irradiance_at(t.tracer, point, 100'000), exact, 0.002);
    }
}

/// A lamp that lies on the floor, and a mirror over both: its light is that of its image, at twice
/// the mirror's height. A ray to it arrives where it is, not near it as by a narrow lobe.
TEST(PathTracer, IdealMirrorShowsTheLampWhereItsImageIs) {
    constexpr double h = 0.4;
    SceneBuilder b;
    b.set_transform(odd_rotation());
    add_floor(b, b.add_material(glm::vec3(0.0F)));
    b.add_quad({1.1F, 0, 0.2F}, {0, 0, 0.4F}, {1, 0, 0}, 1, 1,
               b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F)));
    Material mirror;
    mirror.base_colour = glm::vec3(0.9F);
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    b.add_quad({-20, static_cast<float>(h), -20}, {40, 0, 0}, {0, 0, 40}, 1, 1,
               add_material(b, mirror));
    const Tracing t(b);
    const SurfacePoint point = t.scene.point_on_patch(0, {0.2, 0.5});
    const glm::dvec2 at(0.5, 0.7);  // x, z
    const auto term = [&](double lamp_x, double lamp_z) {
        return corner_term(lamp_x - at.x, lamp_z - at.y, 2.0 * h);
    };
    const double image =
        1000.0 * (term(2.1, 0.6) - term(1.1, 0.6) - term(2.1, 0.2) + term(1.1, 0.2));
    // Schlick's reflectance is between those of the angles to the lamp's nearest and farthest
    // point.
    const auto reflected = [&](double distance) {
        const double cosine = 2.0 * h / std::hypot(distance, 2.0 * h);
        return 0.9 + 0.1 * std::pow(1.0 - cosine, 5.0);
    };
    const Estimate found = irradiance_at(t.tracer, point, 2'000'000);
    EXPECT_LT(found.standard_error, 0.004 * image);
    EXPECT_GT(found.mean, reflected(0.6) * image - sigmas * found.standard_error);
    EXPECT_LT(found.mean, reflected(1.8) * image + sigmas * found.standard_error);

    constexpr double above = 0.1;
    const glm::dvec3 from =
        point.position + above / std::sqrt(t.scene.square_metres()) * point.normal;
    const auto towards_image = [&](double x) {
        const glm::dvec3 here(at.x, above, at.y);
        const glm::dvec3 there(x, 2.0 * h, 0.4);
        return glm::normalize(glm::dmat3(odd_rotation()) * (there - here));
    };
    PixelSampler sampler(1, 0, 0, 0);
    EXPECT_GT(t.tracer.radiance(from, towards_image(1.101), sampler).g, 900.0);
    EXPECT_EQ(t.tracer.radiance(from, towards_image(1.099), sampler).g, 0.0);
}

/// E = pi L a^2/(a^2 + h^2) below a disc, here a polygon of 256 sides and the disc's area.
TEST(PathTracer, DiscLampLightsThePointBelow) {
    for (const double radius : {1.0, 0.1, 1e-3}) {
        constexpr int sides = 256;
        SceneBuilder b;
        b.set_transform(odd_rotation());
        b.add_triangle({-1, 0, -1}, {-1, 0, 2}, {2, 0, -1}, b.add_material(glm::vec3(0.0F)));
        const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
        const double step = 2.0 * pi / sides;
        const double rim = radius * std::sqrt(step / std::sin(step));
        const auto corner = [&](int i) {
            return glm::vec3(rim * std::cos(step * i), 2.0, rim * std::sin(step * i));
        };
        for (int i = 0; i < sides; ++i) {
            b.add_triangle({0, 2, 0}, corner(i), corner(i + 1), lamp);
        }
        const Tracing t(b);
        const SurfacePoint below = t.scene.point_on_patch(0, {1.0 / 3.0, 1.0 / 3.0});
        const double exact = pi * radius * radius / (radius * radius + 4.0);
        const Estimate e = irradiance_at(t.tracer, below, 50'000);
        EXPECT_NEAR(e.mean, exact, 1e-3 * exact + sigmas * e.standard_error) << radius;
        EXPECT_LT(e.standard_error, 0.002 * exact) << radius;
    }
}

class PathTracerThinWall : public testing::TestWithParam<float> {};

/// Light neither leaks through a wall without thickness nor is lost at it.
TEST_P(PathTracerThinWall, KeepsTheDarkRoomExactlyDarkAndTheLitRoomLit) {
    const TwoRooms rooms = two_rooms(0.8F, GetParam());
    const Tracing t(rooms.builder);
    const Estimate dark =
        mean_irradiance(t.scene, t.tracer, rooms.first_dark, patch_count(rooms.builder), 200'000);
    EXPECT_EQ(dark.largest, 0.0);
    expect_estimate(mean_irradiance(t.scene, t.tracer, 0, rooms.first_dark, 100'000),
                    enclosure_flux / (enclosure_surface * 0.2), 0.005);
}

INSTANTIATE_TEST_SUITE_P(Thicknesses, PathTracerThinWall, testing::Values(0.0F, 1e-3F));
INSTANTIATE_TEST_SUITE_P(HeavyThicknesses, PathTracerThinWall, testing::Values(1e-6F, 0.1F));

/// Under an open sky a floor receives pi L, whether the sky is sampled or met.
TEST(PathTracer, OpenFloorReceivesTheSky) {
    SceneBuilder b;
    add_floor(b, b.add_material(glm::vec3(0.5F)));
    b.scene.sky_radiance = glm::vec3(100.0F);
    const Tracing t(b);
    const Estimate e = mean_irradiance(t.scene, t.tracer, 0, 2, 1'000);
    EXPECT_NEAR(e.mean, 100.0 * pi, 1e-6 * e.mean);
}

/// Two techniques that share little: with and without next-event estimation, lamp and sky.
TEST(PathTracer, NextEventEstimationChangesNothingButTheNoise) {
    SceneBuilder open;
    open.set_transform(odd_rotation());
    const auto floor = open.add_material(glm::vec3(0.7F));
    const auto lamp = open.add_material(glm::vec3(0.3F), glm::vec3(50.0F));
    open.add_quad({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, 1, 1, floor);
    open.add_quad({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 1, 1, floor);
    open.add_quad({0.5F, 1.5F, 0.3F}, {0.8F, 0, 0}, {0, 0, 0.8F}, 1, 1, lamp);
    open.scene.sky_radiance = glm::vec3(20.0F);
    PathSettings alone;
    alone.next_event = false;
    const Tracing both(open);
    const Tracing one(open, alone);
    const Estimate a = mean_irradiance(both.scene, both.tracer, 0, 4, 100'000, 1);
    const Estimate c = mean_irradiance(one.scene, one.tracer, 0, 4, 100'000, 2);
    EXPECT_NEAR(a.mean, c.mean, sigmas * std::hypot(a.standard_error, c.standard_error));
    EXPECT_LT(c.standard_error, 0.005 * c.mean);
    const Tracing several(open, {.first_light_samples = 2});
    const Estimate d = mean_irradiance(several.scene, several.tracer, 0, 4, 100'000, 3);
    EXPECT_NEAR(d.mean, c.mean, sigmas * std::hypot(d.standard_error, c.standard_error));
    EXPECT_LT(d.standard_error, 0.005 * d.mean);
}

}  // namespace
}  // namespace raybundle
