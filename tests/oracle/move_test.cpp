// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "moved_box.h"

namespace raybundle::move_test {
namespace {

SolverSettings quick(std::uint64_t seed) {
    return quick_settings(seed, {128, 200});
}

const glm::vec3 first_place(1.2F, 0.0F, 1.5F);
const glm::vec3 second_place(2.6F, 0.0F, 2.4F);

TEST(HeavyMove, CorrectionBringsTheSolutionTowardsTheFreshOne) {
    const SceneBuilder before = room_with_box(first_place);
    const SceneBuilder after = room_with_box(second_place);
    Solver fresh(after.scene, after.mesh, quick(11));
    iterate(fresh, 1024);
    const auto truth = fresh.store().read_irradiance();

    Solver solver(before.scene, before.mesh, quick(1));
    iterate(solver, 512);
    const double stale = relative_difference(solver.store().read_irradiance(), truth);
    move_box(solver, second_place);
    const double corrected = relative_difference(solver.store().read_irradiance(), truth);
    iterate(solver, 256);
    const double settled = relative_difference(solver.store().read_irradiance(), truth);
    EXPECT_GT(stale, 0.1);  // the test would show nothing otherwise
    EXPECT_LT(corrected, 0.7 * stale);
    EXPECT_LT(settled, 0.5 * corrected);
    EXPECT_LT(settled, 0.08);
}

TEST(Move, PatchesThatNoLineThroughTheBoxReachesKeepTheirBits) {
    // The box moves in a room of its own, out of sight of the lit one.
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.5F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 6, wall);
    b.add_quad({1.5F, 2.9F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    const std::size_t room = b.mesh.triangles.size();
    b.add_box({10, 0, 0}, {13, 3, 3}, true, 6, wall);  // another room, dark
    b.add_object("box");
    b.add_box({11, 1, 1}, {11.5F, 1.5F, 1.5F}, false, 2, wall);
    Solver solver(b.scene, b.mesh, quick(3));
    iterate(solver, 64);
    const auto before = solver.store().read_irradiance();
    move_box(solver, {1.0F, 0.0F, 1.0F});
    const auto after = solver.store().read_irradiance();
    std::size_t changed = 0;
    for (std::size_t i = 0; i < room; ++i) {
        changed += before[i] == after[i] ? 0 : 1;
    }
    EXPECT_EQ(changed, 0U);
}

void expect_where_it_began(int times) {
    const SceneBuilder b = room_with_box(first_place);
    Solver fresh(b.scene, b.mesh, quick(5));
    iterate(fresh, 1024);
    Solver solver(b.scene, b.mesh, quick(1));
    iterate(solver, 256);
    for (int i = 0; i < times; ++i) {
        move_box(solver, second_place);
        move_box(solver, first_place);
    }
    iterate(solver, 512);
    const auto irradiance = solver.store().read_irradiance();
    for (const glm::vec4& e : irradiance) {
        ASSERT_TRUE(std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z));
    }
    EXPECT_LT(relative_difference(irradiance, fresh.store().read_irradiance()), 0.08);
}

TEST(Move, ThereAndBackEndsWhereItBegan) {
    expect_where_it_began(5);
}

TEST(HeavyMove, ThereAndBackTwentyTimesEndsWhereItBegan) {
    expect_where_it_began(20);
}

TEST(Move, OutOfTheSceneScaledToNothingAndThroughAWallStaysFinite) {
    const SceneBuilder b = room_with_box(first_place);
    Solver solver(b.scene, b.mesh, quick(2));
    iterate(solver, 32);
    for (const glm::vec3& place :
         {glm::vec3(4.0F, 0.0F, 2.0F), glm::vec3(40.0F, 0.0F, 2.0F), first_place}) {
        move_box(solver, place);
        iterate(solver, 16);
    }
    Transform vanished;
    vanished.translation = first_place;
    vanished.scale = glm::vec3(0.0F);
    solver.move_object(box_object, vanished.matrix(), {});
    iterate(solver, 48);
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        ASSERT_TRUE(std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z));
    }
}

/// A furnace crowded with boxes: windows need far more hits than there is room for at first. Hits
/// that were dropped would show as darkness, iterations counted twice as light.
TEST(Solution, WindowsThatOverflowAreDoneAgain) {
    SceneBuilder b;
    const auto m = b.add_material(glm::vec3(0.5F), glm::vec3(100.0F));
    b.add_box({0, 0, 0}, {4, 4, 4}, true, 6, m);
    for (int i = 0; i < 36; ++i) {
        const float x = 0.15F + 0.1F * static_cast<float>(i);
        b.add_box({x, 0.2F, 0.2F}, {x + 0.05F, 3.8F, 3.8F}, false, 3, m);
    }
    SolverSettings settings = quick(1);
    settings.probabilities = {1.0F, 0.0F, 0.0F};
    Solver solver(b.scene, b.mesh, settings);
    const std::size_t before = solver.bytes();
    iterate(solver, 192);
    EXPECT_EQ(solver.iterations(), 192U);
    EXPECT_GT(solver.bytes(), before);  // the lists did grow
    double mean = 0.0;
    const auto irradiance = solver.store().read_irradiance();
    for (const glm::vec4& e : irradiance) {
        mean += static_cast<double>(e.x) / static_cast<double>(irradiance.size());
    }
    const double exact = 3.14159265358979 * 100.0 / 0.5;
    EXPECT_NEAR(mean, exact, 0.04 * exact);
}

TEST(Solution, NonFiniteValuesAreDroppedAndCounted) {
    const SceneBuilder b = room_with_box(first_place);
    SolverSettings settings = quick(2);
    settings.probabilities = {1.0F, 0.0F, 0.0F};  // every bundle transfers from every patch
    Solver solver(b.scene, b.mesh, settings);
    iterate(solver, 20);  // amid a group: its beginning would write the radiance anew
    EXPECT_EQ(solver.non_finite(), 0U);
    solver.store().write_radiance(0, glm::vec4(std::nanf(""), INFINITY, 1.0F, 0.1F));
    iterate(solver, 64);
    EXPECT_GT(solver.non_finite(), 0U);
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        ASSERT_TRUE(std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z));
    }
}

}  // namespace
}  // namespace raybundle::move_test
