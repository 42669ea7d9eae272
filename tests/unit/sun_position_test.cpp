// SPDX-License-Identifier: Apache-2.0
// The sun by the clock, against published positions.
#include "scene/light/sun_position.h"

#include <gtest/gtest.h>

#include "scene/edit/daylight_edit.h"
#include "scene/edit/light_edit.h"
#include "scene/light/environment.h"

namespace raybundle::test {
namespace {

/// The worked example of NREL's SPA (Reda and Andreas 2008): geometric elevation, to which air at
/// 10 degrees and 1010 hPa adds 1.2'.
TEST(SunPosition, IsThatOfPublishedTables) {
    struct Published {
        const char* time;
        double latitude, longitude, elevation, azimuth;
    };
    const Published spa{"2003-10-17T12:30:30-07:00", 39.742476, -105.1786, 39.87205, 194.34024};
    const SunPosition sun = sun_position(spa.latitude, spa.longitude, *parse_time(spa.time));
    EXPECT_NEAR(sun.elevation, spa.elevation + 1.2 / 60.0, 0.01);
    EXPECT_NEAR(sun.azimuth, spa.azimuth, 0.01);
}

/// At the equinox of 2024 (20 March, 03:06 UTC) it stands over the equator; at the solstices over
/// the tropics, whose latitude the obliquity of the ecliptic is (23.436 degrees in 2024).
TEST(SunPosition, PassesThroughEquinoxesAndSolstices) {
    const auto highest = [](double latitude, const char* day) {
        double best = -90.0;
        const double midnight = *parse_time(std::string(day) + "T00:00Z");
        for (int minute = 0; minute < 1440; ++minute) {
            best = std::max(best, sun_position(latitude, 0.0, midnight + 60.0 * minute).elevation);
        }
        return best;
    };
    EXPECT_NEAR(highest(0.0, "2024-03-20"), 90.0, 0.25);
    EXPECT_NEAR(highest(23.436, "2024-06-20"), 90.0, 0.15);
    EXPECT_NEAR(highest(50.0, "2024-06-20"), 40.0 + 23.436, 0.02);
    EXPECT_NEAR(highest(50.0, "2024-12-21"), 40.0 - 23.436 + 3.2 / 60.0, 0.02);
    // South of the equator it culminates in the north.
    const SunPosition sydney = sun_position(-33.87, 151.21, *parse_time("2024-12-21T01:50:00Z"));
    EXPECT_TRUE(sydney.azimuth < 20.0 || sydney.azimuth > 340.0) << sydney.azimuth;
}

TEST(SunPosition, ReadsTimesWithTheirZone) {
    EXPECT_EQ(*parse_time("1970-01-01T00:00Z"), 0.0);
    EXPECT_EQ(*parse_time("2026-06-21T15:00:00+02:00"), *parse_time("2026-06-21T13:00Z"));
    EXPECT_EQ(*parse_time("2026-06-21T15:00:30-05:30") - *parse_time("2026-06-21T20:30Z"), 30.0);
    EXPECT_EQ(*parse_time("2000-03-01T00:00Z") - *parse_time("2000-02-28T00:00Z"), 2.0 * 86400.0);
    for (const char* wrong : {"", "2026-06-21", "2026-06-21T15:00", "2026-02-30T12:00Z",
                              "2026-06-21T24:00Z", "2026-06-21T15:00+2", "2026-06-21T15:00Zx",
                              "1850-01-01T00:00Z", "21.6.2026 15:00", "2026-06-21T15:61Z"}) {
        EXPECT_FALSE(parse_time(wrong).has_value()) << wrong;
    }
}

Scene empty_scene() {
    Scene scene;
    PunctualLight lamp;
    lamp.name = "lamp";
    scene.punctual_lights.push_back(lamp);
    return scene;
}

TEST(DaylightEdit, GivesASceneWithoutSkyOneAndTakesItAway) {
    Scene scene = empty_scene();
    DaylightSetting day;
    day.sky = "clear";
    apply(scene, day);
    ASSERT_EQ(scene.punctual_lights.size(), 2U);
    ASSERT_TRUE(scene.sky_light.has_value());
    EXPECT_GT(luminance(scene.punctual_lights[1].intensity), 10'000.0F);
    EXPECT_GT(luminance(scene.sky_light->intensity), 1'000.0F);
    for (const char* dark : {"none", "loaded"}) {
        day.sky = dark;
        apply(scene, day);
        EXPECT_EQ(scene.punctual_lights.size(), 2U);
        EXPECT_TRUE(scene.sky_light.has_value());
        EXPECT_EQ(luminance(scene.punctual_lights[1].intensity), 0.0F);
        EXPECT_EQ(mean_sky(scene), glm::dvec3(0.0));
    }
    day.sky = "clear";
    day.sun_elevation = -3.0F;  // night
    apply(scene, day);
    EXPECT_EQ(mean_sky(scene), glm::dvec3(0.0));
    day.sky = "overcast";
    day.sun_elevation = 30.0F;
    apply(scene, day);
    EXPECT_EQ(scene.punctual_lights.size(), 2U);
    EXPECT_EQ(luminance(scene.punctual_lights[1].intensity), 0.0F);
    EXPECT_GT(mean_sky(scene).g, 100.0);
    day.sky = "stormy";
    EXPECT_NE(problem_of(day).find("'stormy' is none of none, loaded, overcast"),
              std::string::npos);
}

TEST(DaylightEdit, LoadedSkyComesBackUndimmed) {
    Scene scene = empty_scene();
    scene.sky_radiance = glm::vec3(500.0F);
    scene.sky_light = find_sky_light(scene);
    LightEdit dim;
    dim.light = 2;
    dim.intensity = 100.0F;
    apply(scene, dim);
    EXPECT_TRUE(daylight_dimmed(scene));
    EXPECT_NEAR(mean_sky(scene).g, 100.0, 1e-3);
    DaylightSetting day;
    day.sky = "clear";
    apply(scene, day);
    EXPECT_FALSE(daylight_dimmed(scene));
    day.sky = "loaded";
    apply(scene, day);
    EXPECT_NEAR(mean_sky(scene).g, 500.0, 1e-3);
}

/// Horizontal and vertical illuminance by the clock, worked out from the sun's angles and the
/// formulas of CIE S 011 by quadrature over the sky.
TEST(DaylightEdit, SunMovesWithTheClock) {
    Scene scene = empty_scene();
    for (const double azimuth : {90.0, 180.0, 250.0}) {
        DaylightSetting day;
        day.sky = "clear";
        day.sun_elevation = 35.0F;
        day.sun_azimuth = static_cast<float>(azimuth);
        apply(scene, day);
        const glm::vec3 towards = scene.punctual_lights[1].axes[2];
        EXPECT_NEAR(towards.y, std::sin(glm::radians(35.0)), 1e-6);
        EXPECT_NEAR(towards.x, std::cos(glm::radians(35.0)) * std::sin(glm::radians(azimuth)),
                    1e-6);
        EXPECT_NEAR(towards.z, -std::cos(glm::radians(35.0)) * std::cos(glm::radians(azimuth)),
                    1e-6);
    }
}

}  // namespace
}  // namespace raybundle::test
