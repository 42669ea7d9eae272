// SPDX-License-Identifier: Apache-2.0
// Daylight in the solver: closed forms on an open plane, and what views show of it. Rooms:
// daylight_room_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "oracle/oracle_solve.h"
#include "reference/camera_rays.h"
#include "scene/light/environment.h"
#include "scene/light/sky_dome.h"
#include "view/viewer_image.h"

namespace raybundle::daylight_test {
namespace {

using std::numbers::pi;

/// Mean irradiance of a black plane that looks up, lx, under a sky.
double plane_illuminance(const SkyDomeSettings& settings, std::uint64_t iterations) {
    SceneBuilder b;
    b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 4, 4, b.add_material(glm::vec3(0.0F)));
    set_environment(std::make_shared<const SkyDome>(settings), b.scene);
    Solver solver(b.scene, b.mesh);
    while (solver.iterations() < iterations) {
        solver.step({});
    }
    return mean_irradiance(b, solver.store().read_irradiance());
}

TEST(Daylight, OvercastPlaneGetsSevenNinths) {
    SkyDomeSettings settings;
    settings.zenith_luminance = 5000.0;
    const double exact = 7.0 / 9.0 * pi * 5000.0;
    EXPECT_NEAR(plane_illuminance(settings, 512), exact, 0.01 * exact);
}

TEST(Daylight, ClearPlaneGetsItsIntegral) {
    SkyDomeSettings settings;
    settings.sky.type = CieSky::standard_clear;
    settings.sun_elevation = glm::radians(35.0);
    settings.zenith_luminance = 3000.0;
    const double exact = SkyDome(settings).sky_illuminance();
    EXPECT_NEAR(plane_illuminance(settings, 768), exact, 0.02 * exact);
    // The sun is a first shot: exact from the beginning.
    settings.zenith_luminance = 0.0;
    settings.sun_illuminance = 70'000.0;
    const double sun = 70'000.0 * std::sin(settings.sun_elevation);
    EXPECT_NEAR(plane_illuminance(settings, 8), sun, 1e-3 * sun);
}

/// Nothing of it exists where no scene calls for it.
TEST(Daylight, CostsNothingInOtherScenes) {
    SceneBuilder b;
    b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 1, 1,
               b.add_material(glm::vec3(0.5F), glm::vec3(1.0F)));
    const Solver solver(b.scene, b.mesh);
    for (const std::string& define : solver.scene().defines()) {
        EXPECT_NE(define, "SKY 1");
        EXPECT_NE(define, "ENVIRONMENT 1");
    }
}

/// Pixels beyond the scene show what the environment shows; the sun's disc is there.
TEST(Daylight, ViewsShowTheSky) {
    SkyDomeSettings settings;
    settings.sky.type = CieSky::standard_clear;
    settings.sun_elevation = glm::radians(20.0);
    settings.zenith_luminance = 3000.0;
    settings.sun_illuminance = 50'000.0;
    SceneBuilder b;
    b.add_quad({-4, -9, -4}, {0, 0, 1}, {1, 0, 0}, 1, 1, b.add_material(glm::vec3(0.5F)));
    const auto sky = std::make_shared<const SkyDome>(settings);
    set_environment(sky, b.scene);
    const Solver solver(b.scene, b.mesh);
    const ViewPrograms programs(solver.scene());
    constexpr glm::uvec2 size(64, 48);
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.target = glm::vec3(sky->sources()[0].direction);
    camera.vertical_fov = 0.12F;
    image.set_camera(camera);
    const auto picture = image.read_radiance();
    const RayScene scene(b.scene, b.mesh);
    const CameraRays rays(scene, camera, size);
    double largest = 0.0;
    int wrong = 0;
    for (std::uint32_t i = 0; i < picture.size(); ++i) {
        const double exact = sky->shown(rays.direction(rays.corner(i) + 0.5)).g;
        largest = std::max(largest, exact);
        wrong += std::abs(static_cast<double>(picture[i].g) - exact) > 0.02 * exact ? 1 : 0;
    }
    EXPECT_GT(largest, 1e8);  // 50 klx / (pi sin²(0.267°)) = 7.4e8
    EXPECT_LE(wrong, 8);      // where the disc's edge runs through a pixel's centre
}

}  // namespace
}  // namespace raybundle::daylight_test
