// SPDX-License-Identifier: Apache-2.0
// Lights and materials that change while the solution is there (ch. 7.4), against linearity, closed
// forms and fresh solves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "oracle/scene_builder.h"
#include "scene/edit/surface_edit.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::surface_change_test {
namespace {

const glm::vec3 bright(900.0F, 1000.0F, 800.0F);

/// Two rooms that share one air: a bright lamp on the ceiling of the first, a dim one in the
/// second, a door between them.
SceneBuilder two_lamps(float dim) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), bright);
    const auto other = b.add_material(glm::vec3(0.0F), dim * bright);
    b.add_box({0, 0, 0}, {8, 3, 4}, true, 8, wall);
    b.add_quad({1.5F, 2.98F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    b.add_quad({5.5F, 2.98F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2, other);
    b.add_box({3.9F, 0, 0}, {4.1F, 3, 2.5F}, false, 4, wall);
    std::uint32_t id = 0;
    for (const auto material : {lamp, other}) {
        Light light;
        light.id = ++id;
        light.material = static_cast<int>(material);
        light.radiance = b.scene.materials[material].emission;
        light.colour = light.radiance / luminance(light.radiance);
        b.scene.lights.push_back(light);
    }
    return b;
}

SolverSettings quick(std::uint64_t seed, BundleResolution resolution = {96, 150}) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = resolution;
    settings.coarse_iterations = 1'000'000;
    return settings;
}

void iterate(Solver& solver, std::uint64_t count, BundleReceiver* receiver = nullptr) {
    const std::span<BundleReceiver* const> receivers(&receiver, receiver != nullptr ? 1 : 0);
    const std::uint64_t end = solver.iterations() + count;
    while (solver.iterations() < end) {
        solver.step(receivers);
    }
}

void edit_light(Solver& solver, SceneBuilder& b, const LightEdit& edit,
                BundleReceiver* receiver = nullptr) {
    const std::span<BundleReceiver* const> receivers(&receiver, receiver != nullptr ? 1 : 0);
    const std::uint32_t materials[] = {apply(b.scene, edit)};
    solver.change_surfaces(b.scene, b.mesh, materials, {}, receivers);
    while (solver.correcting()) {
        solver.step(receivers);
    }
}

void edit_material(Solver& solver, SceneBuilder& b, const MaterialEdit& edit) {
    const std::uint32_t materials[] = {apply(b.scene, edit)};
    solver.change_surfaces(b.scene, b.mesh, materials, materials, {});
    while (solver.correcting()) {
        solver.step({});
    }
}

/// Root mean square difference over root mean square, green channel, of patches whose centre has
/// min_x <= x.
double relative_difference(const SceneBuilder& b, const std::vector<glm::vec4>& a,
                           const std::vector<glm::vec4>& truth, float min_x = -1.0F) {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (b.cell_centre(i).x < min_x) {
            continue;
        }
        const double d = static_cast<double>(a[i].g) - static_cast<double>(truth[i].g);
        difference += d * d;
        size += static_cast<double>(truth[i].g) * static_cast<double>(truth[i].g);
    }
    return std::sqrt(difference / size);
}

LightEdit switched(std::uint32_t light, bool on) {
    LightEdit edit;
    edit.light = light;
    edit.on = on;
    return edit;
}

LightEdit dimmed(std::uint32_t light, float intensity) {
    LightEdit edit;
    edit.light = light;
    edit.intensity = intensity;
    return edit;
}

TEST(LightChange, AllLightAtHalfGivesHalfEverywhere) {
    SceneBuilder b = two_lamps(0.0F);  // the second lamp emits nothing
    Solver solver(b.scene, b.mesh, quick(1));
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {64, 48});
    Camera camera;
    camera.eye = {0.5F, 1.5F, 0.5F};
    camera.target = {3.0F, 0.5F, 3.0F};
    image.set_camera(camera);
    iterate(solver, 96, &image);
    const auto before = solver.store().read_irradiance();
    const auto picture_before = image.read_irradiance();
    edit_light(solver, b, dimmed(1, 0.5F * luminance(bright)), &image);
    const auto after = solver.store().read_irradiance();
    const auto picture_after = image.read_irradiance();
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_NEAR(after[i].g, 0.5F * before[i].g, 1e-5F * before[i].g);
        ASSERT_EQ(after[i].w, before[i].w);
    }
    for (std::size_t i = 0; i < picture_before.size(); ++i) {
        ASSERT_NEAR(picture_after[i].g, 0.5F * picture_before[i].g, 1e-5F * picture_before[i].g);
        ASSERT_EQ(picture_after[i].w, picture_before[i].w);
    }
    EXPECT_EQ(solver.statistics().settled, 1.0);
}

TEST(LightChange, TheOnlyLightOffLeavesExactlyNothing) {
    SceneBuilder b = two_lamps(0.0F);
    Solver solver(b.scene, b.mesh, quick(1));
    iterate(solver, 96);
    edit_light(solver, b, switched(1, false));
    iterate(solver, 16);
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        ASSERT_EQ(glm::vec3(e), glm::vec3(0.0F));
    }
    edit_light(solver, b, switched(1, true));
    iterate(solver, 384);
    Solver fresh(b.scene, b.mesh, quick(11));
    iterate(fresh, 1024);
    EXPECT_LT(
        relative_difference(b, solver.store().read_irradiance(), fresh.store().read_irradiance()),
        0.08);
}

TEST(LightChange, AColourChangesItsChannelsAlone) {
    SceneBuilder b = two_lamps(0.0F);
    Solver solver(b.scene, b.mesh, quick(1));
    iterate(solver, 64);
    const auto before = solver.store().read_irradiance();
    LightEdit red;
    red.light = 1;
    red.colour = glm::vec3(1.0F, 0.0F, 0.0F);
    edit_light(solver, b, red);
    const auto after = solver.store().read_irradiance();
    const float factor = b.scene.lights[0].radiance.r / bright.r;
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_NEAR(after[i].r, factor * before[i].r, 1e-4F * after[i].r);
        ASSERT_EQ(after[i].g, 0.0F);
        ASSERT_EQ(after[i].b, 0.0F);
    }
}

/// A light among others: the corrected solution is nearer to a fresh one than the stale one, of the
/// room that the light is in as well as of the other.
TEST(HeavyLightChange, OneOfTwoLampsIsCorrected) {
    SceneBuilder dim = two_lamps(0.5F);
    apply(dim.scene, dimmed(2, 0.1F * luminance(bright)));
    refresh_surfaces(dim.scene, std::vector<std::uint32_t>{2}, dim.mesh);
    Solver fresh(dim.scene, dim.mesh, quick(99));
    iterate(fresh, 1536);
    const auto truth = fresh.store().read_irradiance();
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SceneBuilder b = two_lamps(0.5F);
        Solver solver(b.scene, b.mesh, quick(seed));
        iterate(solver, 512);
        const auto stale = solver.store().read_irradiance();
        edit_light(solver, b, dimmed(2, 0.1F * luminance(bright)));
        const auto corrected = solver.store().read_irradiance();
        iterate(solver, 512);
        const auto later = solver.store().read_irradiance();
        const double before = relative_difference(b, stale, truth, 4.2F);
        const double after = relative_difference(b, corrected, truth, 4.2F);
        EXPECT_GT(before, 0.5);
        EXPECT_LT(after, 0.5 * before) << seed;
        EXPECT_LT(relative_difference(b, corrected, truth), relative_difference(b, stale, truth));
        EXPECT_LT(relative_difference(b, later, truth, 4.2F), 0.1) << seed;
    }
}

/// numerics.md, "Bright light on and off 1000 times" (a tenth of that but under the label heavy):
/// what the dim lamp lights is 1e-3 of what the bright one does. Statistical: 0.05 of the mean is
/// more than 5 standard errors of either solve.
TEST(HeavyLightChange, ABrightLightOnAndOffManyTimesLeavesNoGhost) {
    SceneBuilder b = two_lamps(1e-3F);
    SolverSettings settings = quick(3, {48, 64});
    settings.special = {.bundles = 3, .most_bundles = 3, .bounces = 1};
    Solver solver(b.scene, b.mesh, settings);
    iterate(solver, 64);
    for (int i = 0; i < RAYBUNDLE_LIGHT_CYCLES; ++i) {
        edit_light(solver, b, switched(1, false));
        edit_light(solver, b, switched(1, true));
    }
    edit_light(solver, b, switched(1, false));
    iterate(solver, 768);
    Solver fresh(b.scene, b.mesh, quick(12, {48, 64}));
    iterate(fresh, 768);
    const auto mean = [&](const Solver& s) {
        double sum = 0.0;
        for (const glm::vec4& e : s.store().read_irradiance()) {
            sum += static_cast<double>(e.g);
        }
        return sum;
    };
    EXPECT_NEAR(mean(solver), mean(fresh), 0.05 * mean(fresh));
    EXPECT_LT(
        relative_difference(b, solver.store().read_irradiance(), fresh.store().read_irradiance()),
        0.15);
    EXPECT_EQ(solver.non_finite(), 0U);
}

TEST(LightChange, AFarBrighterLightStaysInRange) {
    SceneBuilder b = two_lamps(1.0F);
    Solver solver(b.scene, b.mesh, quick(5));
    iterate(solver, 64);
    edit_light(solver, b, dimmed(1, 1e8F));
    iterate(solver, 256);
    EXPECT_EQ(solver.non_finite(), 0U);
    Solver fresh(b.scene, b.mesh, quick(15));
    iterate(fresh, 768);
    EXPECT_LT(
        relative_difference(b, solver.store().read_irradiance(), fresh.store().read_irradiance()),
        0.1);
}

/// Closed furnace, Siegel and Howell: E = pi Le / (1 - albedo) everywhere.
TEST(MaterialChange, ARepaintedFurnaceIsCorrected) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.3F), glm::vec3(100.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 6, wall);
    Solver solver(b.scene, b.mesh, quick(2));
    iterate(solver, 384);
    MaterialEdit edit;
    edit.material = wall + 1;
    edit.base_colour = glm::vec3(0.6F);
    edit_material(solver, b, edit);
    const auto mean = [&] {
        double sum = 0.0;
        const auto irradiance = solver.store().read_irradiance();
        for (const glm::vec4& e : irradiance) {
            sum += static_cast<double>(e.g) / static_cast<double>(irradiance.size());
        }
        return sum;
    };
    const double stale = std::numbers::pi * 100.0 / 0.7;
    const double exact = std::numbers::pi * 100.0 / 0.4;
    EXPECT_NEAR(mean(), exact, 0.27 * (exact - stale));  // nearly three quarters at once
    iterate(solver, 384);
    EXPECT_NEAR(mean(), exact, 0.03 * exact);
}

TEST(MaterialChange, ARepaintedWallIsCorrected) {
    SceneBuilder b = two_lamps(0.5F);
    Solver solver(b.scene, b.mesh, quick(2));
    iterate(solver, 512);
    const auto stale = solver.store().read_irradiance();
    MaterialEdit edit;
    edit.material = 1;
    edit.base_colour = glm::vec3(0.8F, 0.2F, 0.1F);
    edit_material(solver, b, edit);
    const auto corrected = solver.store().read_irradiance();
    iterate(solver, 256);
    Solver fresh(b.scene, b.mesh, quick(17));
    iterate(fresh, 1024);
    const auto truth = fresh.store().read_irradiance();
    const double before = relative_difference(b, stale, truth);
    EXPECT_LT(relative_difference(b, corrected, truth), 0.6 * before);
    EXPECT_LT(relative_difference(b, solver.store().read_irradiance(), truth), 0.06);
}

/// A first glossy material calls for other shaders: another solver takes over with the mean
/// irradiance of the first.
TEST(MaterialChange, AFirstGlossyMaterialKeepsTheMeanIrradiance) {
    SceneBuilder b = two_lamps(0.5F);
    Solver solver(b.scene, b.mesh, quick(2));
    iterate(solver, 256);
    const auto before = solver.store().read_irradiance();
    MaterialEdit edit;
    edit.material = 1;
    edit.metallic = 1.0F;
    edit.roughness = 0.3F;
    const std::uint32_t materials[] = {apply(b.scene, edit)};
    ASSERT_FALSE(solver.covers(b.scene, materials[0]));
    refresh_surfaces(b.scene, materials, b.mesh);
    Solver next(b.scene, b.mesh, quick(4));
    EXPECT_TRUE(next.covers(b.scene, materials[0]));
    next.take_over(solver, materials, {});
    const auto taken = next.store().read_irradiance();
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_NEAR(taken[i].g, before[i].g, 1e-5F * before[i].g);
        ASSERT_EQ(taken[i].w, before[i].w);
    }
    while (next.correcting()) {
        next.step({});
    }
    iterate(next, 256);
    // A room of metal is noisy: no worse than a solve that began with this material.
    Solver fresh(b.scene, b.mesh, quick(18));
    iterate(fresh, 768);
    Solver equal(b.scene, b.mesh, quick(19));
    iterate(equal, 256);
    const auto truth = fresh.store().read_irradiance();
    EXPECT_LT(relative_difference(b, next.store().read_irradiance(), truth),
              1.5 * relative_difference(b, equal.store().read_irradiance(), truth));
}

}  // namespace
}  // namespace raybundle::surface_change_test
