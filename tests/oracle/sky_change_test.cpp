// SPDX-License-Identifier: Apache-2.0
// The sky and the sun that are switched, dimmed and coloured while the solution is there, against
// closed forms and fresh solves of the changed scene.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "oracle/oracle_solve.h"
#include "reference/camera_rays.h"
#include "scene/edit/surface_edit.h"
#include "scene/light/environment.h"
#include "scene/light/environment_map.h"
#include "scene/light/sky_dome.h"
#include "view/viewer_image.h"

namespace raybundle::sky_change_test {
namespace {

using std::numbers::pi;

SkyDomeSettings clear_morning() {
    SkyDomeSettings settings;
    settings.sky.type = CieSky::standard_clear;
    settings.sun_elevation = glm::radians(35.0);
    settings.sun_azimuth = 0.3;
    settings.zenith_luminance = 2000.0;
    settings.sun_illuminance = 8000.0;
    return settings;
}

/// An open black floor below that sky and a point light. Lights: 1 the lamp, 2 the sun, 3 the sky.
SceneBuilder open_floor() {
    SceneBuilder b;
    b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 6, 6, b.add_material(glm::vec3(0.0F)));
    PunctualLight lamp;
    lamp.position = {1.0F, 2.0F, 0.0F};
    lamp.intensity = glm::vec3(20'000.0F);
    b.scene.punctual_lights.push_back(lamp);
    set_environment(std::make_shared<const SkyDome>(clear_morning()), b.scene);
    b.scene.sky_light = find_sky_light(b.scene);
    return b;
}

constexpr std::uint32_t sun_number = 2;
constexpr std::uint32_t sky_number = 3;

LightEdit switched(std::uint32_t light, bool on) {
    LightEdit edit;
    edit.light = light;
    edit.on = on;
    return edit;
}

/// A solver of the floor, whose lights change.
struct Floor {
    void iterate(std::uint64_t count) {
        for (const std::uint64_t end = solver.iterations() + count; solver.iterations() < end;) {
            solver.step({});
        }
    }
    void change(const LightEdit& edit) {
        ASSERT_EQ(problem_of(b.scene, edit), "");
        ASSERT_EQ(apply(b.scene, edit), no_material);
        solver.change_surfaces(b.scene, b.mesh, {}, {}, {});
        while (solver.correcting()) {
            solver.step({});
        }
    }
    [[nodiscard]] double illuminance() const {
        return mean_irradiance(b, solver.store().read_irradiance());
    }

    Floor() : b(open_floor()), solver(b.scene, b.mesh, settings) {}

    SceneBuilder b;
    SolverSettings settings;
    Solver solver;
};

/// What lamp and sun bring is exact from the first iteration on; what the sky brings is found by
/// random directions, and known to a twentieth by 512 of them.
TEST(SkyChange, BringsWhatAFileWithThatSkyWould) {
    const SkyDomeSettings file = clear_morning();
    const double sky = SkyDome(file).sky_illuminance();
    const double sun = file.sun_illuminance * std::sin(file.sun_elevation);
    const double bound = 0.05 * sky;
    Floor dark;
    dark.change(switched(sun_number, false));
    dark.change(switched(sky_number, false));
    const double lamp = dark.illuminance();
    EXPECT_GT(lamp, 0.05 * sky);
    Floor lit;
    lit.iterate(512);
    EXPECT_NEAR(lit.illuminance(), lamp + sun + sky, bound);
    LightEdit dim;
    dim.light = sky_number;
    dim.intensity = 0.25F * luminance(lit.b.scene.sky_light->loaded);
    lit.change(dim);
    EXPECT_NEAR(lit.illuminance(), lamp + sun + 0.25 * sky, 2.0 * bound) << "right afterwards";
    lit.iterate(512);
    EXPECT_NEAR(lit.illuminance(), lamp + sun + 0.25 * sky, bound);
    lit.change(switched(sun_number, false));
    EXPECT_NEAR(lit.illuminance(), lamp + 0.25 * sky, bound) << "without the sun";
    lit.change(switched(sky_number, false));
    EXPECT_NEAR(lit.illuminance(), lamp, 0.02 * sky) << "the lamp alone";
    lit.change(switched(sky_number, true));
    lit.iterate(512);
    EXPECT_NEAR(lit.illuminance(), lamp + 0.25 * sky, bound) << "the sky again";
}

/// The scene as an edit leaves it is the one that a file with such a sky and sun gives.
TEST(SkyChange, IsTheSkyOfAFileWithThatSkyAndSun) {
    SceneBuilder b = open_floor();
    SkyDomeSettings settings = clear_morning();
    settings.zenith_luminance *= 0.5;
    settings.sun_illuminance *= 0.25;
    LightEdit edit;
    edit.light = sky_number;
    edit.intensity = 0.5F * luminance(b.scene.sky_light->intensity);
    apply(b.scene, edit);
    edit.light = sun_number;
    edit.intensity = 0.25F * luminance(b.scene.punctual_lights[1].intensity);
    apply(b.scene, edit);
    const SkyDome file(settings);
    const auto same = [](const glm::dvec3& a, const glm::dvec3& e) {
        EXPECT_LE(glm::length(a - e), 1e-6 * glm::length(e));
    };
    same(mean_sky(b.scene), file.mean());
    for (const glm::dvec3& to : {glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0.8, 0),
                                 glm::dvec3(0.6, -0.8, 0), file.sources()[0].direction}) {
        same(sky_towards(b.scene, to), file.radiance(to));
        same(background_towards(b.scene, to), file.shown(to));
    }
}

/// Brightest luminance of the sky round the sun in a view, cd/m².
double brightest_towards(const Solver& solver, const glm::vec3& target) {
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {64, 48});
    Camera camera;
    camera.eye = {0, 1, 0};
    camera.target = camera.eye + target;
    camera.vertical_fov = 0.12F;
    image.set_camera(camera);
    double largest = 0.0;
    for (const auto& pixel : image.read_radiance()) {
        largest = std::max(largest, static_cast<double>(pixel.g));
    }
    return largest;
}

void expect_disc_follows(SceneBuilder b, std::uint32_t sun, const glm::vec3& towards) {
    Solver solver(b.scene, b.mesh);
    const double whole = brightest_towards(solver, towards);
    const double without =
        static_cast<double>(luminance(glm::vec3(sky_towards(b.scene, glm::dvec3(towards)))));
    EXPECT_GT(whole, 20.0 * without);
    LightEdit edit;
    edit.light = sun;
    edit.intensity = 0.5F * luminance(setting_of(b.scene.punctual_lights.back()).loaded);
    apply(b.scene, edit);
    solver.change_surfaces(b.scene, b.mesh, {}, {}, {});
    EXPECT_NEAR(brightest_towards(solver, towards), 0.5 * (whole + without), 0.03 * whole);
    apply(b.scene, switched(sun, false));
    solver.change_surfaces(b.scene, b.mesh, {}, {}, {});
    EXPECT_LT(brightest_towards(solver, towards), 1.5 * without);
    const glm::dvec3 seen = background_towards(b.scene, glm::dvec3(towards));
    EXPECT_LT(static_cast<double>(luminance(glm::vec3(seen))), 1.5 * without);
}

TEST(SkyChange, TheSunLeavesThePictureOfTheSky) {
    SceneBuilder dome = open_floor();
    expect_disc_follows(dome, sun_number, dome.scene.punctual_lights[1].axes[2]);
    EquirectangularImage image;
    image.width = 64;
    image.height = 32;
    image.pixels.assign(64 * 32, glm::vec3(100.0F));
    image.pixels[image.index(32, 8)] = glm::vec3(1e6F);
    SceneBuilder map = open_floor();
    set_environment(std::make_shared<const EnvironmentMap>(image, EnvironmentMapSettings{}),
                    map.scene);
    map.scene.sky_light = find_sky_light(map.scene);
    ASSERT_EQ(map.scene.punctual_lights.size(), 2U);
    ASSERT_TRUE(map.scene.sky_light->image);
    expect_disc_follows(map, sun_number, map.scene.punctual_lights[1].axes[2]);
}

/// An open black plane that looks up under a uniform sky of 1000 cd/m².
SceneBuilder open_plane() {
    SceneBuilder b;
    b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 4, 4, b.add_material(glm::vec3(0.2F)));
    b.scene.sky_radiance = glm::vec3(1000.0F);
    b.scene.sky_light = find_sky_light(b.scene);
    return b;
}

SolverSettings interactive() {
    SolverSettings settings;
    settings.special = interactive_special();
    return settings;
}

/// Whatever else changes, the sky's light is not brought a second time.
TEST(SkyChange, OtherChangesLeaveTheSkyAsItIs) {
    for (const SolverSettings& settings : {SolverSettings(), interactive()}) {
        SceneBuilder b = open_plane();
        Solver solver(b.scene, b.mesh, settings);
        while (solver.iterations() < 256) {
            solver.step({});
        }
        MaterialEdit edit;
        edit.material = 1;
        edit.base_colour = glm::vec3(0.7F);
        const std::uint32_t material = apply(b.scene, edit);
        solver.change_surfaces(b.scene, b.mesh, std::span(&material, 1), std::span(&material, 1),
                               {});
        while (solver.correcting()) {
            solver.step({});
        }
        EXPECT_NEAR(mean_irradiance(b, solver.store().read_irradiance()), 1000.0 * pi, 0.02e3 * pi);
    }
}

/// Where nothing else shines, transport is linear: a dimmed sky needs no new iteration.
TEST(SkyChange, OnlyTheSkyAtATenthGivesATenth) {
    SceneBuilder b = open_plane();
    Solver solver(b.scene, b.mesh);
    while (solver.iterations() < 64) {
        solver.step({});
    }
    const auto before = solver.store().read_irradiance();
    LightEdit edit;
    edit.light = 1;
    edit.intensity = 100.0F;
    apply(b.scene, edit);
    solver.change_surfaces(b.scene, b.mesh, {}, {}, {});
    EXPECT_FALSE(solver.correcting());
    const auto after = solver.store().read_irradiance();
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_NEAR(after[i].g, 0.1F * before[i].g, 1e-5F * before[i].g);
    }
}

}  // namespace
}  // namespace raybundle::sky_change_test
