// SPDX-License-Identifier: Apache-2.0
// Air that absorbs and scatters: furnaces, in which it is unseen, closed forms, path tracing, and
// changes against new solves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../reference/lit_room.h"
#include "changed_room.h"
#include "oracle/oracle_solve.h"
#include "pictures.h"

namespace raybundle::air_test {
namespace {

constexpr float sent = 100.0F;  // cd/m², by everything in a furnace

Medium air_of(double visibility, float albedo = 1.0F, double anisotropy = 0.0) {
    return {Medium::extinction_of(visibility), glm::vec3(albedo), anisotropy};
}

SolverSettings coarse_bundles() {
    SolverSettings settings;
    settings.coarse = {96, 150};
    settings.coarse_iterations = 1'000'000;
    return settings;
}

/// A solver with a picture.
struct Shown {
    Shown(const SceneBuilder& b, const Camera& camera, glm::uvec2 size)
        : solver(b.scene, b.mesh, coarse_bundles()),
          programs(solver.scene()),
          image(solver.scene(), solver.store(), programs, size) {
        image.set_camera(camera);
    }
    void iterate(int count) {
        BundleReceiver* const receivers[] = {&image};
        for (int i = 0; i < count; ++i) {
            solver.step(receivers);
        }
    }

    Solver solver;
    ViewPrograms programs;
    ViewerImage image;
};

struct FurnaceAir {
    const char* name;
    float albedo;  // of the walls
    Medium medium;
};

class AirFurnaceBySolver : public testing::TestWithParam<FurnaceAir> {};

/// A room whose walls send L in every direction: so does air that absorbs nothing, and all walls
/// receive pi L. What bundles lose to the air comes back by its paths.
TEST_P(AirFurnaceBySolver, IsUniform) {
    const FurnaceAir& given = GetParam();
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto wall =
        b.add_material(glm::vec3(given.albedo), glm::vec3((1.0F - given.albedo) * sent));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 6, wall);
    b.add_box({1, 0, 1}, {2, 1, 2}, false, 3, wall);
    b.scene.medium = given.medium;
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(0.3F, 1.5F, 4.7F, 1.0F));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(3.0F, 1.0F, 0.0F, 1.0F));
    camera.vertical_fov = 1.0F;
    Shown shown(b, camera, {24, 18});
    shown.iterate(256);
    const auto irradiance = shown.solver.store().read_irradiance();
    EXPECT_NEAR(mean_irradiance(b, irradiance) / (std::numbers::pi * double{sent}), 1.0, 0.01);
    double sum = 0.0;
    const auto picture = shown.image.read_radiance();
    double squares = 0.0;
    for (const glm::vec4& pixel : picture) {
        sum += double{pixel.g};
        squares += (double{pixel.g} - double{sent}) * (double{pixel.g} - double{sent});
    }
    const auto pixels = static_cast<double>(picture.size());
    EXPECT_NEAR(sum / pixels / double{sent}, 1.0, 0.01);
    EXPECT_LT(std::sqrt(squares / pixels) / double{sent}, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Airs, AirFurnaceBySolver,
                         testing::Values(FurnaceAir{"haze", 0.5F, air_of(30.0)},
                                         FurnaceAir{"fog", 0.7F, air_of(8.0)},
                                         FurnaceAir{"forward", 0.5F, air_of(30.0, 1.0F, 0.3)}),
                         [](const auto& test) { return std::string(test.param.name); });

/// The same below a sky that is as bright, which the air dims and makes up for.
TEST(AirBySolver, AnIsothermalWorldIsUniform) {
    SceneBuilder b;
    b.scene.sky_radiance = glm::vec3(sent);
    const auto m = b.add_material(glm::vec3(0.6F), glm::vec3(0.4F * sent));
    for (int i = 0; i < 3; ++i) {
        const float y = 1.2F * static_cast<float>(i);
        b.add_box({0.25F * static_cast<float>(i), y, 0}, {2.0F, y + 0.2F, 2}, false, 3, m);
    }
    b.scene.medium = air_of(10.0);
    Camera camera;
    camera.eye = {-4.0F, 3.0F, 5.0F};
    camera.target = {1.0F, 1.0F, 1.0F};
    Shown shown(b, camera, {16, 12});
    shown.iterate(384);
    const auto irradiance = shown.solver.store().read_irradiance();
    EXPECT_NEAR(mean_irradiance(b, irradiance) / (std::numbers::pi * double{sent}), 1.0, 0.01);
    for (const glm::vec4& pixel : shown.image.read_radiance()) {
        EXPECT_NEAR(pixel.g, sent, 0.1F * sent);
    }
}

/// Beer and Lambert: a lamp's light on a black floor, and the floor's own towards the eye.
TEST(AirBySolver, FadesByBeerAndLambert) {
    SceneBuilder b;
    const auto floor = b.add_material(glm::vec3(0.0F), glm::vec3(sent));
    const auto wall = b.add_material(glm::vec3(0.0F));
    b.add_quad({-3, 0, -3}, {0, 0, 6}, {6, 0, 0}, 12, 12, floor);
    b.add_box({-3, 0, -3}, {3, 4, 3}, true, 4, wall);
    for (std::size_t i = 0; i < b.mesh.triangle_count(); ++i) {
        if (i >= 288 && std::abs(b.cell_centre(i).y) < 1e-3F) {
            b.set_triangle_material(i, floor);
        }
    }
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {0.2F, 2.5F, 0.1F},
                       {0.0F, -1.0F, 0.0F}, glm::vec3(100.0F));
    const double extinction = 0.3;
    b.scene.medium = Medium{extinction, glm::vec3(0.0F), 0.0};
    Camera camera;
    camera.eye = {0.0F, 3.0F, 0.0F};
    camera.target = {0.0F, 0.0F, 0.0F};
    camera.up = {0.0F, 0.0F, 1.0F};
    camera.vertical_fov = 0.05F;
    Shown shown(b, camera, {4, 4});
    shown.iterate(8);
    for (const glm::vec4& pixel : shown.image.read_radiance()) {
        EXPECT_NEAR(pixel.g, double{sent} * std::exp(-extinction * 3.0), 1e-3 * double{sent});
    }
    const auto irradiance = shown.solver.store().read_irradiance();
    const double direct_of = 100.0;
    for (const std::size_t patch : {std::size_t{0}, std::size_t{77}, std::size_t{150}}) {
        const glm::dvec3 offset = glm::dvec3(0.2, 2.5, 0.1) - glm::dvec3(b.cell_centre(patch));
        const double r = glm::length(offset);
        const double exact = direct_of * 2.5 / (r * r * r) * std::exp(-extinction * r);
        EXPECT_NEAR(irradiance[patch].g, exact, 0.01 * exact) << patch;
    }
}

struct FoggedView {
    SceneBuilder builder;
    Camera camera;
};

/// A room of 6 x 3 x 4 m with a lamp in the ceiling, a spot, and a screen across it.
FoggedView closed_room() {
    FoggedView view;
    SceneBuilder& b = view.builder;
    const auto wall = b.add_material(glm::vec3(0.7F, 0.6F, 0.5F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(2000.0F));
    b.add_box({0, 0, 0}, {6, 3, 4}, true, 8, wall);
    b.add_quad({1.5F, 2.98F, 1.5F}, {0.8F, 0, 0}, {0, 0, 0.8F}, 2, 2, lamp);
    b.add_box({3.0F, 0, 0}, {3.1F, 2.0F, 2.2F}, false, 4, wall);
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::spot, {4.5F, 2.8F, 1.0F},
                       {0.1F, -1.0F, 0.3F}, glm::vec3(1500.0F));
    view.camera.eye = {5.7F, 1.6F, 3.8F};
    view.camera.target = {1.0F, 1.2F, 0.5F};
    view.camera.vertical_fov = 1.0F;
    return view;
}

/// The room of the reference tests: open front, a lamp, a spot, the sun.
FoggedView open_room() {
    return {lit_room(odd_rotation(), 8), lit_room_camera(odd_rotation())};
}

/// A block on open ground below a sky and the sun.
FoggedView outdoors() {
    FoggedView view;
    SceneBuilder& b = view.builder;
    const auto ground = b.add_material(glm::vec3(0.3F, 0.35F, 0.25F));
    const auto walls = b.add_material(glm::vec3(0.6F));
    b.add_quad({-15, 0, -15}, {0, 0, 30}, {30, 0, 0}, 16, 16, ground);
    b.add_box({-3, 0, -3}, {3, 6, 1}, false, 6, walls);
    b.scene.sky_radiance = glm::vec3(3000.0F, 3500.0F, 5000.0F);
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::directional, glm::vec3(0.0F),
                       glm::normalize(glm::vec3(0.5F, -1.0F, -0.6F)), glm::vec3(30000.0F));
    view.camera.eye = {11.0F, 1.7F, 13.0F};
    view.camera.target = {0.0F, 2.5F, 0.0F};
    view.camera.vertical_fov = 0.8F;
    return view;
}

struct AirCase {
    const char* name;
    FoggedView (*view)();
    Medium medium;
    double mean_bound, block_bound;
    int iterations = 512;
    std::uint32_t paths = 1500;
};

void expect_as_by_path_tracing(const AirCase& given) {
    FoggedView view = given.view();
    view.builder.scene.medium = given.medium;
    constexpr glm::uvec2 size(24, 18);
    constexpr unsigned block = 6;
    Shown shown(view.builder, view.camera, size);
    shown.iterate(given.iterations);
    const auto picture = shown.image.read_radiance();
    const auto truth =
        path_traced_centres(view.builder.scene, view.builder.mesh, view.camera, size, given.paths);
    glm::dvec3 found(0.0);
    glm::dvec3 exact(0.0);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (truth[i].r >= 0.0) {
            found += glm::dvec3(picture[i]);
            exact += truth[i];
        }
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(found[c] / exact[c], 1.0, given.mean_bound) << c;
    }
    const double difference = block_difference(picture, truth, size, block);
    EXPECT_LT(difference, given.block_bound);
    testing::Test::RecordProperty("mean", std::to_string(found.g / exact.g));
    testing::Test::RecordProperty("blocks", std::to_string(difference));
}

class AirAsByPathTracing : public testing::TestWithParam<AirCase> {};

/// Within 5 % from a visibility of 30 m upwards.
TEST_P(AirAsByPathTracing, Agrees) {
    expect_as_by_path_tracing(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Views, AirAsByPathTracing,
                         testing::Values(AirCase{"outdoors", outdoors, air_of(60.0), 0.03, 0.05,
                                                 192, 800}),
                         [](const auto& test) { return std::string(test.param.name); });

class HeavyAirAsByPathTracing : public testing::TestWithParam<AirCase> {};

TEST_P(HeavyAirAsByPathTracing, Agrees) {
    expect_as_by_path_tracing(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Views, HeavyAirAsByPathTracing,
    testing::Values(AirCase{"closed_room_100", closed_room, air_of(100.0), 0.02, 0.05, 1024, 4000},
                    AirCase{"closed_room_30", closed_room, air_of(30.0), 0.02, 0.05, 1024, 6000},
                    AirCase{"closed_room_10", closed_room, air_of(10.0), 0.03, 0.05, 1024, 12000},
                    AirCase{"closed_room_absorbing", closed_room, air_of(20.0, 0.6F), 0.02, 0.05,
                            1024, 8000},
                    AirCase{"closed_room_forward", closed_room, air_of(30.0, 1.0F, 0.7), 0.02, 0.05,
                            1024, 8000},
                    AirCase{"open_room_30", open_room, air_of(30.0), 0.02, 0.05, 1024, 6000},
                    AirCase{"outdoors_30", outdoors, air_of(30.0), 0.02, 0.05, 1024, 8000},
                    AirCase{"outdoors_200", outdoors, air_of(200.0), 0.02, 0.05, 1024, 4000}),
    [](const auto& test) { return std::string(test.param.name); });

/// A room as `Solved` shows it, with a screen that can be moved, object 1, and two lamps without
/// extent, one of them on the screen.
SceneBuilder changing_room() {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    b.add_box({0, 0, 0}, {6, 3, 4}, true, 8, wall);
    b.add_object("screen");
    b.add_box({2.0F, 0.1F, 1.0F}, {2.2F, 1.5F, 2.5F}, false, 3, wall);
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {4.5F, 2.2F, 2.0F},
                       {0.0F, -1.0F, 0.0F}, glm::vec3(200.0F));
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {2.1F, 1.8F, 1.7F},
                       {0.0F, -1.0F, 0.0F}, glm::vec3(300.0F));
    b.scene.punctual_lights.back().object = 1;
    b.scene.medium = air_of(20.0);
    return b;
}

void finish(Solved& changed) {
    BundleReceiver* const receivers[] = {&changed.image};
    while (changed.solver.correcting()) {
        changed.solver.step(receivers);
    }
}

/// Lamps that are dimmed and lamps that are carried away take their air along.
TEST(AirBySolver, FollowsLampsThatChange) {
    Solved changed(changing_room());
    BundleReceiver* const receivers[] = {&changed.image};
    changed.iterate(128);
    changed.b.scene.punctual_lights[0].intensity *= 0.2F;
    changed.solver.change_surfaces(changed.b.scene, changed.b.mesh, {}, {}, receivers);
    finish(changed);
    changed.iterate(256);
    expect_fresh(changed, 384, "a lamp dimmed");
    const glm::vec3 offset(2.5F, 0.3F, 0.8F);
    changed.b.scene.objects[1].transform.translation = offset;
    changed.solver.move_object(1, glm::translate(glm::mat4(1.0F), offset), receivers);
    finish(changed);
    changed.iterate(384);
    expect_fresh(changed, 384, "a lamp carried away");
}

}  // namespace
}  // namespace raybundle::air_test
