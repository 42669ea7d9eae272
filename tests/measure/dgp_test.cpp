// SPDX-License-Identifier: Apache-2.0
// DGP against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lit_room.h"
#include "luminous_panel.h"
#include "measure/glare/dgp_measurement.h"
#include "rooms.h"

namespace raybundle {
namespace {

using std::numbers::pi;

const glm::dvec3 line_of_sight(0.0, 0.0, -1.0);

SceneBuilder bright_space(float luminance) {
    SceneBuilder builder;
    const std::uint32_t black = builder.add_material(glm::vec3(0.0F));
    for (const float at : {-10.0F, 10.0F}) {
        const glm::vec3 p(at);
        builder.add_triangle(p, p + glm::vec3(1e-3F, 0, 0), p + glm::vec3(0, 0, 1e-3F), black);
    }
    builder.scene.sky_radiance = glm::vec3(luminance);
    return builder;
}

GlareRating probability(const SceneBuilder& builder, std::size_t passes = 2,
                        DgpSettings settings = {}) {
    DgpMeasurement points(std::make_shared<const MeasuredScene>(builder.scene, builder.mesh),
                          {{{0, 0, 0}, line_of_sight}}, std::move(settings));
    for (std::size_t i = 0; i < passes * DgpMeasurement::pass; ++i) {
        points.add_round();
    }
    return points.glare()[0];
}

/// Nothing is five times as bright as the mean: 5.87e-5 pi L + 0.16.
TEST(Dgp, OfAUniformSphereIsThatOfItsIlluminance) {
    const GlareRating rating = probability(bright_space(1000.0F));
    EXPECT_NEAR(rating.value.value, 5.87e-5 * pi * 1000.0 + 0.16, 1e-4);
    EXPECT_NEAR(rating.background, pi * 1000.0, 2.0);
    EXPECT_EQ(rating.sources, 0U);
    ASSERT_EQ(rating.ratios.size(), 3U);
    for (const double luminance : rating.ratios) {
        EXPECT_NEAR(luminance, 1000.0, 1.0);
    }
    EXPECT_LE(rating.value.low, rating.value.value);
}

/// A bright disc of angular radius 6 degrees line_of_sight ahead in a dim sphere: P = 1, smaller
/// than what pixels resolve well, as a luminaire.
TEST(Dgp, OfABrightDiscFollowsTheFormula) {
    SceneBuilder builder = bright_space(200.0F);
    const std::uint32_t lamp = builder.add_material(glm::vec3(0.0F), glm::vec3(20'000.0F));
    constexpr int corners = 180;
    const double radius = 3.0 * std::tan(glm::radians(6.0));
    const auto corner = [&](int i) {
        const double angle = 2.0 * pi * i / corners;
        return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), -3.0);
    };
    for (int i = 0; i < corners; ++i) {
        builder.add_triangle({0, 0, -3}, corner(i), corner(i + 1), lamp);
    }
    const double omega = 2.0 * pi * (1.0 - std::cos(glm::radians(6.0)));
    const double sine = std::sin(glm::radians(6.0));
    const double ev = pi * 200.0 * (1.0 - sine * sine) + pi * 20'000.0 * sine * sine;
    const double exact =
        5.87e-5 * ev + 0.0918 * std::log10(1.0 + 4e8 * omega / std::pow(ev, 1.87)) + 0.16;
    const GlareRating rating = probability(builder);
    EXPECT_NEAR(rating.background, ev, 0.01 * ev);  // the luminaire's cosine is that of its middle
    EXPECT_NEAR(rating.value.value, exact, 0.003);
    ASSERT_EQ(rating.shares.size(), 1U);
    EXPECT_NEAR(rating.shares[0].solid_angle, omega, 0.01 * omega);
    EXPECT_NEAR(rating.ratios[0] / rating.ratios[2],
                (20'000.0 * omega + 200.0 * (2 * pi * (1 - std::cos(glm::radians(10.0))) - omega)) /
                    (2 * pi * (1 - std::cos(glm::radians(10.0)))) / 200.0,
                4.0);
}

/// A bright part of what is not a lamp: a white wall in the sun. Its pixels glare, and noise does
/// not make it brighter: a floor of the same noise without the wall has no source.
TEST(Dgp, PixelsOfBrightSurfacesGlare) {
    SceneBuilder builder = bright_space(50.0F);
    builder.add_object("sunlit wall");
    builder.add_quad({1.0F, -0.5F, -4.0F}, {1, 0, 0}, {0, 1, 0}, 2, 2,
                     builder.add_material(glm::vec3(0.8F)));
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::directional, {},
                       glm::normalize(glm::vec3(0, 0, -1)), glm::vec3(50'000.0F));
    const GlareRating rating = probability(builder);
    const double luminance = 0.8 * 50'000.0 / pi;
    ASSERT_GE(rating.shares.size(), 1U);
    EXPECT_EQ(rating.shares[0].name, "sunlit wall");
    // 1 m² about (1.5, 0, -4), across the line of sight.
    double omega = 0.0;
    double ev = pi * 50.0;
    double glaring = 0.0;
    constexpr int n = 100;
    const Gaze eye(line_of_sight);
    for (int i = 0; i < n * n; ++i) {
        const glm::dvec3 to(1.0 + (i % n + 0.5) / n, -0.5 + (i / n + 0.5) / n, -4.0);
        const double d2 = glm::dot(to, to);
        const glm::dvec3 w = to / std::sqrt(d2);
        const double part = -w.z / d2 / (n * n);
        const double p = position_index(eye, w);
        omega += part;
        ev += (luminance - 50.0) * part * -w.z;
        glaring += luminance * luminance * part / (p * p);
    }
    EXPECT_NEAR(rating.background, ev, 0.02 * ev);
    const double exact =
        5.87e-5 * ev + 0.0918 * std::log10(1.0 + glaring / std::pow(ev, 1.87)) + 0.16;
    // Pixels at its edge are half as bright: less of L² omega, by their share of it.
    EXPECT_NEAR(rating.value.value, exact, 0.02);
}

/// Lights without size have an illuminance, and no luminance: I cos/d² and E cos in Ev alone.
TEST(Dgp, LightsWithoutSizeAreInTheIlluminance) {
    SceneBuilder builder = bright_space(500.0F);
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::point, {0, 1, -1}, {0, -1, 0},
                       glm::vec3(3000.0F));
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::spot, {0, 0, -2}, {0, 0, 1},
                       glm::vec3(2000.0F));
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::point, {0, 1, 1}, {0, -1, 0},
                       glm::vec3(9000.0F));  // behind the eye
    IesProfile::Data data;
    data.vertical = {0.0, 180.0};
    data.horizontal = {0.0};
    data.candela = {400.0, 400.0};
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::point, {1, 0, -1}, {0, -1, 0},
                       glm::vec3(1.0F));
    builder.scene.punctual_lights.back().profile = std::make_shared<const IesProfile>(data);
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::directional, {},
                       glm::normalize(glm::vec3(0, -1, 1)), glm::vec3(800.0F));
    const double slant = std::sqrt(0.5);
    const double ev =
        pi * 500.0 + 3000.0 * slant / 2.0 + 2000.0 / 4.0 + 400.0 * slant / 2.0 + 800.0 * slant;
    const GlareRating rating = probability(builder);
    // Every path of the sphere is exact; the lights' intensities are single precision.
    EXPECT_NEAR(rating.background, ev, 1e-5 * ev);
    EXPECT_NEAR(rating.value.value, 5.87e-5 * ev + 0.16, 1e-5);
    EXPECT_EQ(rating.small, 4U);
    EXPECT_NE(rating.words.find("without size"), std::string::npos);
    EXPECT_EQ(rating.sources, 0U);
    EXPECT_NEAR(rating.ratios[0], 500.0, 1e-3);
}

/// A panel 2 m ahead: it glares by its file's luminance, and hides its part of the sky.
TEST(Dgp, ALuminaireOfAnAreaGlaresAndHidesTheSky) {
    SceneBuilder builder = bright_space(200.0F);
    builder.scene.punctual_lights.push_back(panel_light({{0, 0, -2}, {0, 0, 1}, 0.0F}, 0.6, 0.6));
    builder.scene.punctual_lights.back().intensity = glm::vec3(10.0F);
    const double candela = 10.0 * panel_candela({0, 0, -1});
    double hidden = 0.0;  // with the cosine at the eye
    constexpr int n = 60;
    for (int i = 0; i < n * n; ++i) {
        const glm::dvec3 to(0.6 * ((i % n + 0.5) / n - 0.5), 0.6 * ((i / n + 0.5) / n - 0.5), -2.0);
        hidden += 0.36 / (n * n) * 4.0 / std::pow(glm::dot(to, to), 2.0);
    }
    const double ev = 200.0 * (pi - hidden) + candela / 4.0;
    const GlareRating rating = probability(builder);
    EXPECT_NEAR(rating.background, ev, 0.006 * ev);
    ASSERT_EQ(rating.shares.size(), 1U);
    EXPECT_NEAR(rating.shares[0].luminance, candela / 0.36, 0.01 * candela / 0.36);
}

TEST(Dgp, IsNotRatedInAir) {
    SceneBuilder builder = enclosure(0.5F);
    builder.scene.medium = Medium{0.1, glm::vec3(1.0F), 0.0};
    const auto scene = std::make_shared<const MeasuredScene>(builder.scene, builder.mesh);
    DgpSettings settings;
    settings.views = {{0, 0, -1}, {1, 0, 0}};
    const glm::dvec3 eye = odd_rotation() * glm::vec4(0.6F, 1.2F, 1.0F, 1.0F);
    DgpMeasurement points(scene, {{eye, line_of_sight}}, settings);
    for (std::size_t i = 0; i < DgpMeasurement::pass; ++i) {
        points.add_round();
    }
    EXPECT_EQ(points.glare()[0].state, GlareRating::State::outside);
    EXPECT_NE(points.glare()[0].words.find("DGP is not defined"), std::string::npos);
    EXPECT_FALSE(points.all());
    EXPECT_EQ(points.relative_error(), 0.0);  // nobody waits for a number
}

/// The sun's disc in sight: L = E/(pi sin² r).
TEST(Dgp, TheSunIsASourceOfItsOwn) {
    SceneBuilder builder = bright_space(2000.0F);
    const glm::dvec3 to = glm::normalize(glm::dvec3(0.0, 0.5, -1.0));
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::directional, {}, glm::vec3(-to),
                       glm::vec3(60'000.0F));
    const double radius = glm::radians(0.2665);
    builder.scene.punctual_lights.back().angular_radius = static_cast<float>(radius);
    const GlareRating rating = probability(builder);
    const double ev = pi * 2000.0 - 0.0 + 60'000.0 * -to.z;
    const double p = position_index(Gaze(line_of_sight), to);
    const double omega = 2.0 * pi * (1.0 - std::cos(radius));
    const double exact =
        5.87e-5 * ev +
        0.0918 * std::log10(1.0 + 60'000.0 * 60'000.0 / omega / (p * p) / std::pow(ev, 1.87)) +
        0.16;
    EXPECT_NEAR(rating.background, ev, 0.01 * ev);
    EXPECT_NEAR(rating.value.value, exact, 0.01);
    ASSERT_EQ(rating.shares.size(), 1U);
    EXPECT_EQ(rating.shares[0].name, "sun");
}

/// Intervals hold the truth, known by many samples, about as often as they say: 40 seeds of a room
/// lit by reflection, of which 2 are expected outside (8 or more: once in a thousand).
TEST(HeavyDgp, IntervalsHoldTheTruth) {
    const SceneBuilder room = enclosure(0.7F);
    const auto scene = std::make_shared<const MeasuredScene>(room.scene, room.mesh);
    const glm::dvec3 eye = odd_rotation() * glm::vec4(0.6F, 1.2F, 1.0F, 1.0F);
    const auto rate = [&](std::uint64_t seed, std::size_t passes) {
        DgpSettings settings;
        settings.seed = seed;
        DgpMeasurement points(scene, {{eye, {0.3, 0.0, 1.0}}}, settings);
        for (std::size_t i = 0; i < passes * DgpMeasurement::pass; ++i) {
            points.add_round();
        }
        return points.values()[0];
    };
    double truth = 0.0;
    std::vector<Interval> found;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        found.push_back(rate(seed * 1000, 1));
        truth += found.back().value / 40.0;
    }
    int outside = 0;
    for (const Interval& one : found) {
        outside += one.low > truth || one.high < truth ? 1 : 0;
    }
    EXPECT_LT(outside, 8);
}

}  // namespace
}  // namespace raybundle
