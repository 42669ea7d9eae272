// SPDX-License-Identifier: Apache-2.0
// Daylight against closed forms, and how scene files ask for it.
#include "scene/light/daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_builder.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/light/environment_map.h"
#include "scene/light/sky_dome.h"

namespace raybundle::test {
namespace {

using std::numbers::pi;

SkyDome dome(int type, double elevation, double zenith, double sun = 0.0) {
    SkyDomeSettings settings;
    settings.sky.type = type;
    settings.sun_elevation = glm::radians(elevation);
    settings.sun_azimuth = glm::radians(230.0);
    settings.zenith_luminance = zenith;
    settings.sun_illuminance = sun;
    return SkyDome(settings);
}

/// Illuminance of a plane by all that is within a cone about a direction; cosine to `normal`.
double cone_illuminance(const Environment& environment, const glm::dvec3& axis, double radius,
                        const glm::dvec3& normal) {
    constexpr int rings = 200;
    constexpr int turns = 400;
    const glm::dvec3 other = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(other, axis));
    const glm::dvec3 y = glm::cross(axis, x);
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
        const double angle = radius * (i + 0.5) / rings;
        for (int k = 0; k < turns; ++k) {
            const double turn = 2.0 * pi * (k + 0.5) / turns;
            const glm::dvec3 d = std::cos(angle) * axis +
                                 std::sin(angle) * (std::cos(turn) * x + std::sin(turn) * y);
            sum += environment.shown(d).g * std::max(glm::dot(d, normal), 0.0) * std::sin(angle);
        }
    }
    return sum * radius / rings * 2.0 * pi / turns;
}

TEST(CieSky, OvercastGivesSevenNinthsOfAUniformSky) {
    const SkyDome sky = dome(CieSky::traditional_overcast, 40.0, 9000.0);
    EXPECT_NEAR(sky.sky_illuminance(), 7.0 / 9.0 * pi * 9000.0, 1.0);
    EXPECT_NEAR(sky.radiance({0, 1, 0}).g, 9000.0, 1e-9);
    EXPECT_NEAR(sky.radiance({1, 0, 0}).g, 3000.0, 1e-9);  // a third at the horizon
    // The plain below reflects it, and the mean is half of each hemisphere's: 2/3 and that.
    EXPECT_NEAR(sky.radiance({0, -1, 0}).g, 0.2 * 7.0 / 9.0 * 9000.0, 1.0);
    EXPECT_NEAR(sky.mean().g, 0.5 * (6000.0 + 0.2 * 7000.0), 1.0);
}

TEST(CieSky, UniformTypeIsUniform) {
    const SkyDome sky = dome(5, 30.0, 1000.0);
    EXPECT_NEAR(sky.sky_illuminance(), pi * 1000.0, 0.1);
    EXPECT_NEAR(sky.radiance(glm::normalize(glm::dvec3(1, 0.1, 2))).g, 1000.0, 1e-9);
}

/// The standard's own statements: luminance relative to the zenith, brightest towards the sun for
/// clear skies, an overcast gradation of about 1:3.
TEST(CieSky, TypesAreRelativeToTheZenith) {
    for (int type = 1; type <= 15; ++type) {
        const SkyDome sky = dome(type, 35.0, 1.0);
        EXPECT_NEAR(sky.radiance({0, 1, 0}).g, 1.0, 1e-9) << type;
        EXPECT_GT(sky.radiance(sky_direction(0.0, 0.0)).g, 0.0) << type;
    }
    EXPECT_NEAR(dome(1, 35.0, 1.0).radiance({1, 0, 0}).g, 1.0 / 2.986, 1e-3);
    const SkyDome clear = dome(CieSky::standard_clear, 35.0, 1.0);
    EXPECT_GT(clear.radiance(sky_direction(glm::radians(35.0), glm::radians(230.0))).g, 5.0);
    // 90 degrees from the sun at the zenith's height there is little: dark zenith region.
    EXPECT_LT(clear.radiance(sky_direction(glm::radians(60.0), glm::radians(50.0))).g, 1.5);
}

TEST(CieSky, QuadratureAgreesWithAnother) {
    for (const int type : {3, 7, 12, 16}) {
        const SkyDome sky = dome(type, 50.0, 2000.0);
        EXPECT_NEAR(cone_illuminance(sky, {0, 1, 0}, 0.5 * pi, {0, 1, 0}), sky.sky_illuminance(),
                    2e-3 * sky.sky_illuminance())
            << type;
    }
}

TEST(CieSky, TypicalSkiesAreAsBrightAsMeasuredOnes) {
    const CieSky overcast{CieSky::traditional_overcast};
    const double zenith = typical_zenith_luminance(overcast, glm::radians(45.0));
    EXPECT_NEAR(7.0 / 9.0 * pi * zenith, 0.1 * 133.8e3 * std::sin(glm::radians(45.0)), 5.0);
    const CieSky clear{CieSky::standard_clear};
    const double sun = clear.typical_sun_illuminance(glm::radians(60.0));
    EXPECT_GT(sun, 90e3);
    EXPECT_LT(sun, 110e3);
    EXPECT_LT(clear.typical_sun_illuminance(glm::radians(5.0)), 0.5 * sun);
    EXPECT_EQ(overcast.typical_sun_illuminance(1.0), 0.0);
}

TEST(SkyDome, SunsDiscGivesItsIlluminance) {
    const SkyDome with_sun = dome(5, 40.0, 100.0, 80'000.0);
    const SkyDome without = dome(5, 40.0, 100.0);
    const glm::dvec3 sun = sky_direction(glm::radians(40.0), glm::radians(230.0));
    const double radius = with_sun.settings().sun_radius;
    const auto disc = [&](const glm::dvec3& normal) {
        return cone_illuminance(with_sun, sun, radius, normal) -
               cone_illuminance(without, sun, radius, normal);
    };
    EXPECT_NEAR(disc(sun), 80'000.0, 80.0);
    EXPECT_NEAR(disc({0, 1, 0}), 80'000.0 * std::sin(glm::radians(40.0)), 80.0);
    ASSERT_EQ(with_sun.sources().size(), 1U);
    EXPECT_EQ(with_sun.radiance(sun), without.radiance(sun));  // a light of its own
}

EquirectangularImage flat_image(int width, const glm::vec3& colour) {
    return {width, width / 2,
            std::vector<glm::vec3>(static_cast<std::size_t>(width * width / 2), colour)};
}

TEST(EnvironmentMap, ConstantImageIsAUniformSky) {
    const EnvironmentMap map(flat_image(32, {1, 2, 3}), {"flat", 0.4, 10.0});
    EXPECT_LT(glm::distance(map.mean(), glm::dvec3(10, 20, 30)), 1e-5);
    for (const glm::dvec3& d : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0)}) {
        EXPECT_LT(glm::distance(map.radiance(d), glm::dvec3(10, 20, 30)), 1e-5);
    }
    EXPECT_TRUE(map.sources().empty());
}

/// The middle of the image is north, a quarter to the right east; rotation turns it clockwise.
TEST(EnvironmentMap, DirectionsAreThoseOfTheCompass) {
    EquirectangularImage image = flat_image(64, glm::vec3(1.0F));
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            image.pixels[static_cast<std::size_t>(y * 64 + x)] =
                glm::vec3(static_cast<float>(x), static_cast<float>(y), 0.0F);
        }
    }
    const EnvironmentMap map(image, {"ramp", 0.0, 1.0});
    EXPECT_NEAR(map.radiance({0, 0, -1}).r, 31.5, 1e-4);
    EXPECT_NEAR(map.radiance({1, 0, 0}).r, 47.5, 1e-4);
    EXPECT_NEAR(map.radiance({-1, 0, 0}).r, 15.5, 1e-4);
    EXPECT_NEAR(map.radiance({1, 0, 0}).g, 15.5, 1e-4);
    EXPECT_NEAR(map.radiance({0, 1, 0}).g, 0.0, 1e-4);
    const EnvironmentMap turned(image, {"ramp", glm::radians(90.0), 1.0});
    EXPECT_NEAR(turned.radiance({1, 0, 0}).r, 31.5, 1e-4);
}

/// What becomes a light and what stays add up to the image.
TEST(EnvironmentMap, BrightSpotsBecomeLights) {
    EquirectangularImage image = flat_image(128, glm::vec3(1.0F));
    for (const int x : {126, 127, 0}) {  // across the seam
        image.pixels[static_cast<std::size_t>(20 * 128 + x)] = glm::vec3(50'000, 40'000, 30'000);
    }
    const EnvironmentMap map(image, {"sun", 0.0, 1.0});
    ASSERT_EQ(map.sources().size(), 1U);
    const SkySource& sun = map.sources()[0];
    const double solid_angle =
        3.0 * 2.0 * pi / 128.0 * (std::cos(pi * 20.0 / 64.0) - std::cos(pi * 21.0 / 64.0));
    EXPECT_NEAR(sun.illuminance.r / (50'000.0 * solid_angle), 1.0, 5e-3);
    EXPECT_NEAR(sun.direction.y, std::cos(pi * 20.5 / 64.0), 1e-3);
    const double azimuth = std::atan2(sun.direction.x, -sun.direction.z);
    EXPECT_NEAR(std::abs(azimuth), pi - 0.5 * 2.0 * pi / 128.0, 1e-3);
    EXPECT_LT(map.mean().r, 1.1);
    EXPECT_GT(map.shown(sun.direction).r, 30'000.0);
    EXPECT_LT(map.radiance(sun.direction).r, 400.0);
}

GltfBuilder lit_by(const Json& daylight) {
    GltfBuilder builder;
    const int positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}}})}});
    builder.json["scenes"][0]["extras"]["raybundle"]["daylight"] = daylight;
    return builder;
}

TEST(Daylight, SceneFilesAskForIt) {
    const Scene scene = lit_by({{"sky", "clear"}, {"sunElevation", 30}, {"sunAzimuth", 90}}).load();
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.sky_radiance, glm::vec3(0.0F));
    ASSERT_EQ(scene.punctual_lights.size(), 1U);
    const PunctualLight& sun = scene.punctual_lights[0];
    EXPECT_TRUE(sun.of_sky);
    EXPECT_NEAR(sun.axes[2].x, std::cos(glm::radians(30.0F)), 1e-6F);  // from the east
    EXPECT_NEAR(sun.angular_radius, glm::radians(0.2665F), 1e-6F);
    EXPECT_FALSE(has_notice(scene, "uniform sky"));
}

TEST(Daylight, CommandLineGoesBeforeTheFile) {
    GltfBuilder builder = lit_by({{"sky", "clear"}, {"sunElevation", 30}});
    SceneSettings settings;
    settings.daylight.sun_illuminance = 500.0F;
    const Scene dimmed = builder.load(settings);
    ASSERT_EQ(dimmed.punctual_lights.size(), 1U);
    EXPECT_EQ(dimmed.punctual_lights[0].intensity, glm::vec3(500.0F));
    settings.daylight.sky = "overcast";
    settings.daylight.sun_illuminance.reset();
    EXPECT_TRUE(builder.load(settings).punctual_lights.empty());
    settings.sky_luminance = 70.0F;
    const Scene uniform = builder.load(settings);
    EXPECT_FALSE(uniform.environment);
    EXPECT_EQ(uniform.sky_radiance, glm::vec3(70.0F));
}

TEST(Daylight, OptionsWithoutTheirSkyAreNamed) {
    SceneSettings settings;
    settings.daylight.sun_elevation = 30.0F;
    settings.daylight.environment_scale = 2.0F;
    const Scene dark = one_triangle().load(settings);
    EXPECT_TRUE(has_notice(dark, "no effect: sunElevation. The scene has no standard sky"));
    EXPECT_TRUE(has_notice(dark, "no effect: environmentScale"));
    EXPECT_FALSE(has_notice(lit_by({{"sky", "clear"}}).load(settings), "sunElevation"));
    settings.sky_luminance = 70.0F;
    EXPECT_TRUE(has_notice(lit_by({{"sky", "clear"}}).load(settings), "no effect: sunElevation"));
}

TEST(Daylight, NonsenseIsRejected) {
    const auto rejected = [](const Json& daylight, const std::string& reason) {
        try {
            (void)lit_by(daylight).load();
            ADD_FAILURE() << daylight.dump();
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        }
    };
    rejected({{"sky", "sunny"}}, "daylight.sky");
    rejected({{"sky", 5}}, "must be a text");
    rejected(Json::array(), "must be an object");
    rejected(Json::object(), "one of sky and environment");
    rejected({{"sky", "clear"}, {"sunElevation", 91}}, "daylight.sunElevation");
    rejected({{"sky", "clear"}, {"groundAlbedo", "dark"}}, "must be a number");
    rejected({{"environment", "no such file.hdr"}}, "environment");
}

}  // namespace
}  // namespace raybundle::test
