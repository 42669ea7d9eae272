// SPDX-License-Identifier: Apache-2.0
// Triangles that are smaller than patches share their light.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "ball.h"
#include "moved_box.h"
#include "oracle/oracle_solve.h"
#include "oracle/scene_builder.h"
#include "scene/mesh/patch_means.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::joined_patches_test {
namespace {

TessellationSettings with_size(float size) {
    TessellationSettings settings;
    settings.patch_size = size;
    settings.target_patches = 1;  // joins however few triangles there are
    settings.join_triangles = true;
    return settings;
}

glm::vec3 side_normal(const PatchMesh& mesh, std::uint32_t side) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[side]];
    const glm::vec3& a = mesh.positions[t.x];
    const glm::vec3 n = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    return glm::normalize(side < mesh.triangle_count() ? n : -n);
}

glm::vec3 side_middle(const PatchMesh& mesh, std::uint32_t side) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[side]];
    return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F;
}

/// A room of 4 x 3 x 4 m, each wall cut into 2 n² triangles.
SceneBuilder room(std::uint32_t n) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {4, 3, 4}, true, n, b.add_material(glm::vec3(0.6F)));
    return b;
}

TEST(JoinedPatches, AreAboutAsLargeAsPatchesOfTheTargetEdge) {
    Scene scene = room(40).loaded_scene();  // triangles of 0.1 m
    const PatchMesh mesh = tessellate(scene, with_size(0.8F));
    Scene coarse_scene = room(1).loaded_scene();
    const PatchMesh coarse = tessellate(coarse_scene, with_size(0.8F));
    EXPECT_TRUE(coarse.patch_sets.empty());
    EXPECT_EQ(mesh.triangle_count(), 19'200U);
    EXPECT_LT(mesh.patch_count(), 2 * coarse.patch_count());
    EXPECT_GT(2 * mesh.patch_count(), coarse.patch_count());
    double largest = 0.0;
    for (std::uint32_t patch = 0; patch < mesh.patch_count(); ++patch) {
        double area = 0.0;
        const glm::vec3 normal = side_normal(mesh, mesh.sides_of(patch).front());
        for (const std::uint32_t side : mesh.sides_of(patch)) {
            area += double{side_area(mesh, side)};
            EXPECT_GT(glm::dot(normal, side_normal(mesh, side)), 0.99F);  // of one wall
            EXPECT_EQ(mesh.patch_of(side), patch);
        }
        largest = std::max(largest, area);
    }
    EXPECT_LT(largest, 0.8 * 0.8);
}

TEST(JoinedPatches, LargeTrianglesStayAsTheyAre) {
    const auto with_join = [](bool join) {
        Scene scene = room(2).loaded_scene();
        TessellationSettings settings = with_size(0.5F);
        settings.join_triangles = join;
        return tessellate(scene, settings);
    };
    const PatchMesh joined = with_join(true);
    EXPECT_TRUE(joined.patch_sets.empty());
    EXPECT_EQ(joined.triangles, with_join(false).triangles);
}

TEST(JoinedPatches, AreNoMoreThanTwiceTheTarget) {
    SceneBuilder b = room(1);
    const auto paint = b.add_material(glm::vec3(0.5F));
    for (int i = 0; i < 60; ++i) {  // apart from each other, and small
        add_ball(
            b,
            {0.5F + 0.3F * static_cast<float>(i % 10), 0.5F + 0.3F * static_cast<float>(i / 10), 2},
            0.01F, 10, paint);
    }
    Scene scene = b.loaded_scene();
    TessellationSettings settings;
    settings.target_patches = 300;
    settings.join_triangles = true;
    const PatchMesh mesh = tessellate(scene, settings);
    EXPECT_GT(mesh.triangle_count(), 20'000U);
    EXPECT_LE(mesh.patch_count(), 600U);
    EXPECT_GT(mesh.patch_count(), 200U);
}

/// A small room on a large site: there is place for all of its triangles.
TEST(JoinedPatches, AreNoneWhereTheTargetHasPlaceForAllTriangles) {
    SceneBuilder b = room(6);
    b.add_quad({-500, -0.1F, -500}, {0, 0, 1000}, {1000, 0, 0}, 1, 1,
               b.add_material(glm::vec3(0.5F)));
    Scene scene = b.loaded_scene();
    TessellationSettings settings;
    settings.target_patches = 1000;
    settings.join_triangles = true;
    const PatchMesh mesh = tessellate(scene, settings);
    EXPECT_TRUE(mesh.patch_sets.empty());
    EXPECT_GT(mesh.patch_count(), 800U);
}

/// Fewer than there are sides of things: all round, whatever is between.
TEST(JoinedPatches, AreNoMoreThanThatHoweverSmallTheTarget) {
    SceneBuilder b = room(1);
    const auto paint = b.add_material(glm::vec3(0.5F));
    b.scene.materials[paint].double_sided = true;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 at(0.3F + 0.16F * static_cast<float>(i % 20),
                           0.5F + 0.2F * static_cast<float>(i / 20), 2);
        add_ball(b, at, 0.02F, 4, paint);
        b.add_quad(at + glm::vec3(0.08F, 0, 0), {0, 0.1F, 0}, {0, 0, 0.1F}, 1, 1, paint);
    }
    Scene scene = b.loaded_scene();
    TessellationSettings settings;
    settings.target_patches = 150;
    settings.join_triangles = true;
    const PatchMesh mesh = tessellate(scene, settings);
    EXPECT_GT(mesh.side_count(), 10'000U);
    EXPECT_LE(mesh.patch_count(), 300U);
    double apart = 0.0;
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        apart += double{side_area(mesh, side)};
    }
    double together = 0.0;
    for (std::uint32_t patch = 0; patch < mesh.patch_count(); ++patch) {
        for (const std::uint32_t side : mesh.sides_of(patch)) {
            together += double{side_area(mesh, side)};
            EXPECT_EQ(mesh.patch_of(side), patch);
        }
    }
    EXPECT_NEAR(together, apart, 1e-9 * apart);
}

TEST(JoinedPatches, HaveNormalsOnOneSide) {
    SceneBuilder b = room(1);
    add_ball(b, {2, 1, 2}, 0.05F, 12, b.add_material(glm::vec3(0.5F)));
    Scene scene = b.loaded_scene();
    const PatchMesh mesh = tessellate(scene, with_size(1.0F));
    std::size_t sets = 0;
    for (std::uint32_t patch = 0; patch < mesh.patch_count(); ++patch) {
        glm::vec3 mean(0.0F);
        for (const std::uint32_t side : mesh.sides_of(patch)) {
            mean += side_area(mesh, side) * side_normal(mesh, side);
        }
        for (const std::uint32_t side : mesh.sides_of(patch)) {
            EXPECT_GT(glm::dot(mean, side_normal(mesh, side)), 0.0F);
        }
        sets += mesh.sides_of(patch).size() > 1 ? 1 : 0;
    }
    EXPECT_GE(sets, 2U);
    EXPECT_LE(sets, 12U);
}

/// Two rooms whose floor is one mesh, with a wall between them whose foot falls between its edges.
SceneBuilder rooms_on_one_floor(std::uint32_t floor_material, std::uint32_t wall) {
    SceneBuilder b;
    b.add_material(glm::vec3(0.8F));
    b.add_material(glm::vec3(0.8F));
    b.add_quad({0, 0, 0}, {0, 0, 3}, {6, 0, 0}, 30, 60, floor_material);
    b.add_quad({0, 3, 0}, {6, 0, 0}, {0, 0, 3}, 2, 2, wall);
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 3}, 2, 2, wall);
    b.add_quad({6, 0, 0}, {0, 0, 3}, {0, 3, 0}, 2, 2, wall);
    b.add_quad({0, 0, 0}, {6, 0, 0}, {0, 3, 0}, 2, 2, wall);
    b.add_quad({0, 0, 3}, {0, 3, 0}, {6, 0, 0}, 2, 2, wall);
    b.add_box({2.95F, 0, 0}, {3.05F, 3, 3}, false, 1, wall);
    return b;
}

TEST(JoinedPatches, DoNotReachBelowAWall) {
    Scene scene = rooms_on_one_floor(0, 1).loaded_scene();
    const PatchMesh mesh = tessellate(scene, with_size(1.0F));
    std::size_t joined = 0;
    for (std::uint32_t patch = 0; patch < mesh.patch_count(); ++patch) {
        if (mesh.triangle_material[mesh.triangle_of(patch)] != 0) {
            continue;
        }
        const bool low = side_middle(mesh, mesh.sides_of(patch).front()).x < 3.0F;
        for (const std::uint32_t side : mesh.sides_of(patch)) {
            EXPECT_EQ(side_middle(mesh, side).x < 3.0F, low);
        }
        joined += mesh.sides_of(patch).size() > 1 ? 1 : 0;
    }
    EXPECT_GT(joined, 50U);
}

TEST(JoinedPatches, AreTheSameEveryTime) {
    Scene first = room(30).loaded_scene();
    Scene second = room(30).loaded_scene();
    EXPECT_EQ(tessellate(first, with_size(0.7F)).patch_sets.side_patch,
              tessellate(second, with_size(0.7F)).patch_sets.side_patch);
}

/// A room with a lamp below its ceiling and a finely cut ball on its floor.
struct RoomWithBall {
    explicit RoomWithBall(float size, bool join, int cuts = 24) {
        const auto paint = b.add_material(glm::vec3(0.7F));
        const auto red = b.add_material(glm::vec3(0.6F, 0.3F, 0.2F));
        const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
        b.add_box({0, 0, 0}, {4, 3, 4}, true, 1, paint);
        b.add_quad({1.5F, 2.9F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
        add_ball(b, {2, 0.7F, 2}, 0.6F, cuts, red);
        scene = b.loaded_scene();
        TessellationSettings settings = with_size(size);
        settings.join_triangles = join;
        mesh = tessellate(scene, settings);
    }

    /// Mean irradiance of the room, then of the ball.
    [[nodiscard]] glm::dvec2 solved(std::uint64_t iterations) const {
        OracleSettings settings;
        settings.iterations = iterations;
        settings.resolution = {128, 200};
        const auto irradiance = solve(scene, mesh, settings).store().read_irradiance();
        glm::dvec2 sum(0.0);
        glm::dvec2 area(0.0);
        for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
            const int which = mesh.triangle_material[mesh.side_triangle[side]] == 1 ? 1 : 0;
            const double own = side_area(mesh, side);
            sum[which] += own * static_cast<double>(irradiance[mesh.patch_of(side)].g);
            area[which] += own;
        }
        return sum / area;
    }

    SceneBuilder b;
    Scene scene;
    PatchMesh mesh;
};

/// size: of joined patches, m; fewer: so many less are they at least.
void expect_lit_as_triangles(float size, std::size_t fewer) {
    const RoomWithBall apart(0.5F, false);
    const RoomWithBall joined(size, true);
    EXPECT_LT(joined.mesh.patch_count() + fewer, apart.mesh.patch_count());
    const glm::dvec2 exact = apart.solved(1536);
    const glm::dvec2 found = joined.solved(1536);
    EXPECT_NEAR(found.x / exact.x, 1.0, 0.01);
    EXPECT_NEAR(found.y / exact.y, 1.0, 0.02);
}

TEST(JoinedPatches, LightARoomAsTheirTrianglesDo) {
    expect_lit_as_triangles(0.5F, 2000);
}

TEST(HeavyJoinedPatches, LightARoomAsTheirTrianglesDoWhereTheyAreFiner) {
    expect_lit_as_triangles(0.25F, 0);
}

/// Mean irradiance of two rooms' sides: of those below x = 2.9 m, which a lamp lights, and of those
/// beyond 3.1 m.
glm::dvec2 means_of_two_rooms(bool join, std::uint64_t seed) {
    SceneBuilder b = rooms_on_one_floor(0, 1);
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_quad({1, 2.9F, 1}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
    Scene scene = b.loaded_scene();
    TessellationSettings settings = with_size(0.8F);
    settings.join_triangles = join;
    const PatchMesh mesh = tessellate(scene, settings);
    EXPECT_EQ(mesh.patch_sets.empty(), !join);
    OracleSettings brief;
    brief.iterations = 128;
    brief.seed = seed;
    const auto irradiance = solve(scene, mesh, brief).store().read_irradiance();
    glm::dvec2 flux(0.0);
    glm::dvec2 area(0.0);
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        const float x = side_middle(mesh, side).x;
        if (x < 2.9F || x > 3.1F) {
            const int room = x < 3.0F ? 0 : 1;
            const double own{side_area(mesh, side)};
            flux[room] += own * double{irradiance[mesh.patch_of(side)].g};
            area[room] += own;
        }
    }
    return flux / area;
}

/// Sums over so many seeds of what the rooms have, without joined triangles and with them.
std::array<glm::dvec2, 2> light_of_two_rooms(std::uint64_t seeds) {
    std::array<glm::dvec2, 2> sums{glm::dvec2(0.0), glm::dvec2(0.0)};
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        sums[0] += means_of_two_rooms(false, seed);
        sums[1] += means_of_two_rooms(true, seed);
    }
    return sums;
}

TEST(JoinedPatches, LeakAThousandthOfALitRoomsLightAtMost) {
    const auto [apart, joined] = light_of_two_rooms(2);
    EXPECT_LT(apart.y, 1e-3 * apart.x);
    EXPECT_LT(joined.y, 1e-3 * apart.x);
}

/// A triangle that stands half below a wall has half of the light of its lit half, and gives half
/// of what it has to the other room. Joined to others it has nearly all of that light and gives
/// nearly all of it: up to four times as much leaks, which is little: 2e-4 of the lit room's light.
/// From seed to seed that scatters by more than itself.
TEST(HeavyJoinedPatches, LeakNoMoreThanFourTimesTheirTriangles) {
    const auto [apart, joined] = light_of_two_rooms(16);
    EXPECT_LT(joined.y, 4.0 * apart.y);
}

/// A point light of 1000 lm in a black closed room, whose walls' triangles share patches.
TEST(JoinedPatches, TakeAllTheLightOfALampWithoutExtent) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 12, b.add_material(glm::vec3(0.0F)));
    b.join(6);
    PunctualLight light;
    light.position = {1.1F, 1.8F, 1.9F};
    light.intensity = glm::vec3(250.0F / std::numbers::pi_v<float>);
    b.scene.punctual_lights.push_back(light);
    const Solver solver(b.scene, b.mesh);
    const auto irradiance = solver.store().read_irradiance();
    double flux = 0.0;
    for (std::uint32_t side = 0; side < b.mesh.side_count(); ++side) {
        flux += double{side_area(b.mesh, side)} *
                static_cast<double>(irradiance[b.mesh.patch_of(side)].g);
    }
    EXPECT_NEAR(flux, 1000.0, 10.0);
}

/// As Move.CorrectionBringsTheSolutionTowardsTheFreshOne, of patches of four triangles.
TEST(JoinedPatches, AreCorrectedAfterAMove) {
    const glm::vec3 second_place(2.6F, 0.0F, 2.4F);
    SceneBuilder before = room_with_box({1.2F, 0.0F, 1.5F});
    SceneBuilder after = room_with_box(second_place);
    before.join(4);
    after.join(4);
    Solver fresh(after.scene, after.mesh, quick_settings(11, {128, 200}));
    iterate(fresh, 768);
    const auto truth = fresh.store().read_irradiance();
    Solver solver(before.scene, before.mesh, quick_settings(1, {128, 200}));
    iterate(solver, 384);
    const double stale = relative_difference(solver.store().read_irradiance(), truth);
    move_box(solver, second_place);
    const double corrected = relative_difference(solver.store().read_irradiance(), truth);
    iterate(solver, 256);
    const double settled = relative_difference(solver.store().read_irradiance(), truth);
    EXPECT_GT(stale, 0.1);
    EXPECT_LT(corrected, 0.7 * stale);
    EXPECT_LT(settled, 0.5 * corrected);
}

}  // namespace
}  // namespace raybundle::joined_patches_test
