// SPDX-License-Identifier: Apache-2.0
// Path tracing through air that absorbs and scatters, against closed forms and quadrature. Bounds
// in standard errors as in path_tracer_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "lit_room.h"
#include "rooms.h"

namespace raybundle {
namespace {

using std::numbers::pi;

/// Mean of the green channel, with its standard error.
Estimate mean_of(std::uint32_t samples, const std::function<double(Sampler&)>& sample) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        RandomStream random(7, i);
        const double value = sample(random);
        sum += value;
        squares += value * value;
    }
    const double mean = sum / samples;
    const double variance = std::max(squares / samples - mean * mean, 0.0);
    return {mean, std::sqrt(variance / samples), 0.0};
}

void expect_near_exact(const Estimate& estimate, double exact, double relative_error) {
    EXPECT_NEAR(estimate.mean, exact, sigmas * estimate.standard_error + 1e-6 * exact);
    EXPECT_LT(estimate.standard_error, relative_error * exact);
}

Medium air(double extinction, float albedo, double anisotropy = 0.0) {
    return {extinction, glm::vec3(albedo), anisotropy};
}

/// A black cube about the origin whose walls emit.
SceneBuilder cube(float half_edge, float emission, const Medium& medium, float albedo = 0.0F) {
    SceneBuilder b;
    const std::uint32_t wall = b.add_material(glm::vec3(albedo), glm::vec3(emission));
    b.add_box(glm::vec3(-half_edge), glm::vec3(half_edge), true, 2, wall);
    b.scene.medium = medium;
    return b;
}

glm::dvec3 even_direction(Sampler& sampler) {
    return scattered_direction(0.0, {0, 0, 1}, sampler.next_pair());
}

TEST(Air, PhaseFunctionIsDrawnAsItIs) {
    for (const double g : {-0.7, 0.0, 0.5, 0.9}) {
        const Estimate cosine = mean_of(200'000, [g](Sampler& s) {
            return scattered_direction(g, glm::normalize(glm::dvec3(1, 2, 3)), s.next_pair()).x +
                   1.0;
        });
        expect_near_exact(cosine, 1.0 + g / std::sqrt(14.0), 0.01);
        double integral = 0.0;
        constexpr int steps = 200'000;
        for (int i = 0; i < steps; ++i) {
            integral += phase_of(g, -1.0 + 2.0 * (i + 0.5) / steps) * 4.0 * pi / steps;
        }
        EXPECT_NEAR(integral, 1.0, 1e-4) << g;
    }
}

/// Beer and Lambert: a surface's radiance, in air that absorbs alone.
TEST(Air, SurfacesFadeByBeerAndLambert) {
    const SceneBuilder room = cube(2.0F, 100.0F, air(0.4, 0.0F));
    const Tracing t(room);
    const glm::dvec3 eye = t.scene.from_world({-1.0, 0.3, 0.2});
    const Estimate seen = mean_of(100'000, [&](Sampler& s) {
        return t.tracer.radiance(eye, {1.0, 0.0, 0.0}, s).g;
    });
    expect_near_exact(seen, 100.0 * std::exp(-0.4 * 3.0), 0.01);
}

/// The same of a lamp's illuminance.
TEST(Air, LampsFadeByBeerAndLambert) {
    SceneBuilder room = cube(2.0F, 0.0F, air(0.5, 0.0F));
    add_punctual_light(room, glm::mat4(1.0F), PunctualKind::point, {0.0F, 1.0F, 0.0F},
                       {0.0F, -1.0F, 0.0F}, glm::vec3(100.0F));
    const Tracing t(room);
    const glm::dvec3 above = t.scene.from_world({0.6, 0.0, 0.3});
    const auto floor = t.scene.trace(above, {0.0, -1.0, 0.0});
    ASSERT_TRUE(floor);
    const double square = 9.0 + 0.36 + 0.09;
    const double exact = 100.0 * 3.0 / std::pow(square, 1.5) * std::exp(-0.5 * std::sqrt(square));
    const Estimate lit = irradiance_at(t.tracer, *floor, 1000);
    EXPECT_NEAR(lit.mean, exact, 1e-4 * exact);
}

class AirFurnace : public testing::TestWithParam<std::tuple<float, double, double>> {};

/// Walls that send L everywhere: air that absorbs nothing shows L in every direction.
TEST_P(AirFurnace, IsUniform) {
    const auto [albedo, extinction, anisotropy] = GetParam();
    const SceneBuilder room = cube(2.0F, 100.0F, air(extinction, 1.0F, anisotropy), albedo);
    const Tracing t(room);
    const glm::dvec3 eye = t.scene.from_world({-1.5, 0.3, 0.2});
    const Estimate seen =
        mean_of(60'000, [&](Sampler& s) { return t.tracer.radiance(eye, even_direction(s), s).g; });
    expect_near_exact(seen, 100.0 / (1.0 - static_cast<double>(albedo)), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Airs, AirFurnace,
                         testing::Values(std::tuple{0.0F, 0.2, 0.0}, std::tuple{0.0F, 2.0, 0.7},
                                         std::tuple{0.7F, 0.5, 0.0}, std::tuple{0.5F, 0.3, -0.4}));

/// Light of a point source that an infinite medium of extinction 1/m scatters, at a distance: each
/// order of the albedo's series is a product of Fourier transforms, atan(k)/k for one flight.
double scattered_fluence(double flux, double albedo, double distance) {
    constexpr double step = 0.002;
    constexpr double blur = 0.004;  // m: of the field, so that the integral ends
    double sum = 0.0;
    for (double k = 0.5 * step; k * blur < 4.0; k += step) {
        const double flight = std::atan(k) / k;
        sum += k * std::sin(k * distance) * albedo * flight * flight / (1.0 - albedo * flight) *
               std::exp(-k * k * blur * blur) * step;
    }
    return flux / (2.0 * pi * pi * distance) * sum;
}

TEST(Air, InfiniteMediumHasTheSeriesOfItsAlbedo) {
    for (const float albedo : {0.3F, 0.8F}) {
        SceneBuilder room = cube(30.0F, 0.0F, air(1.0, albedo));
        add_punctual_light(room, glm::mat4(1.0F), PunctualKind::point, glm::vec3(0.0F),
                           {0.0F, -1.0F, 0.0F}, glm::vec3(10.0F));
        const Tracing t(room);
        const glm::dvec3 eye = t.scene.from_world({0.9, 0.0, 0.0});
        const Estimate light = mean_of(200'000, [&](Sampler& s) {
            return 4.0 * pi * t.tracer.radiance(eye, even_direction(s), s).g;
        });
        expect_near_exact(light, scattered_fluence(40.0 * pi, static_cast<double>(albedo), 0.9),
                          0.02);
    }
}

/// Single scattering of a point light along a ray, by quadrature.
TEST(Air, SingleScatteringIsTheIntegralAlongTheRay) {
    for (const double g : {0.0, 0.6}) {
        SceneBuilder room = cube(3.0F, 0.0F, air(0.3, 0.9F, g));
        add_punctual_light(room, glm::mat4(1.0F), PunctualKind::point, {0.5F, 0.4F, 0.0F},
                           {0.0F, -1.0F, 0.0F}, glm::vec3(100.0F));
        PathSettings once;
        once.max_bounces = 1;
        const Tracing t(room, once);
        const glm::dvec3 eye = t.scene.from_world({-3.0 + 1e-3, 0.0, 0.0});
        double exact = 0.0;
        constexpr int steps = 100'000;
        for (int i = 0; i < steps; ++i) {
            const double s = 6.0 * (i + 0.5) / steps;
            const glm::dvec3 to_light = glm::dvec3(0.5, 0.4, 0.0) - glm::dvec3(s - 3.0, 0.0, 0.0);
            const double r = glm::length(to_light);
            exact += 0.3 * 0.9 * std::exp(-0.3 * (s + r)) * phase_of(g, to_light.x / r) * 100.0 /
                     (r * r) * 6.0 / steps;
        }
        const Estimate seen = mean_of(50'000, [&](Sampler& s) {
            return t.tracer.radiance(eye, {1.0, 0.0, 0.0}, s).g;
        });
        expect_near_exact(seen, exact, 0.01);
    }
}

/// A lamp with extent found by chance and by sampling is one light.
TEST(Air, LampsAreAsBrightWithoutNextEventEstimation) {
    SceneBuilder room = cube(2.0F, 0.0F, air(0.5, 0.8F, 0.3), 0.5F);
    const std::uint32_t lamp = room.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    room.add_box({-0.4F, 0.8F, -0.4F}, {0.4F, 1.0F, 0.4F}, false, 1, lamp);
    PathSettings by_chance;
    by_chance.next_event = false;
    const Tracing sampled(room);
    const Tracing met(room, by_chance);
    const auto seen = [](const Tracing& t, std::uint32_t paths) {
        const glm::dvec3 eye = t.scene.from_world({-1.5, 0.0, 0.2});
        return mean_of(paths, [&](Sampler& s) {
            return t.tracer.radiance(eye, glm::normalize(glm::dvec3(1.0, -0.2, 0.1)), s).g;
        });
    };
    const Estimate a = seen(sampled, 60'000);
    const Estimate b = seen(met, 100'000);
    EXPECT_NEAR(a.mean, b.mean, sigmas * std::hypot(a.standard_error, b.standard_error));
    EXPECT_LT(b.standard_error, 0.03 * b.mean);
}

/// A sky above open ground shines through the air in the box that holds the scene.
TEST(Air, TheSkyFadesOnItsWayThroughTheBox) {
    SceneBuilder b;
    const std::uint32_t ground = b.add_material(glm::vec3(0.0F));
    b.add_quad({-5.0F, 0.0F, -5.0F}, {0.0F, 0.0F, 10.0F}, {10.0F, 0.0F, 0.0F}, 1, 1, ground);
    const std::uint32_t thing = b.add_material(glm::vec3(0.0F));
    b.add_box({-5.0F, 3.9F, -5.0F}, {-4.9F, 4.0F, -4.9F}, false, 1, thing);
    b.scene.sky_radiance = glm::vec3(1000.0F);
    b.scene.medium = air(0.5, 0.0F);
    const Tracing t(b);
    const glm::dvec3 eye = t.scene.from_world({0.0, 1.0, 0.0});
    const Estimate seen = mean_of(60'000, [&](Sampler& s) {
        return t.tracer.radiance(eye, {0.0, 1.0, 0.0}, s).g;
    });
    expect_near_exact(seen, 1000.0 * std::exp(-0.5 * 3.0), 0.01);
}

}  // namespace
}  // namespace raybundle
