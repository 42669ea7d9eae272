// SPDX-License-Identifier: Apache-2.0
// Several objects that move at once, and objects that carry a light, against fresh solves.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "moved_box.h"

namespace raybundle::moved_together_test {
namespace {

SolverSettings quick(std::uint64_t seed) {
    SolverSettings settings = quick_settings(seed, {96, 150});
    settings.special = interactive_special();
    return settings;
}

Transform at(const glm::vec3& place) {
    Transform transform;
    transform.translation = place;
    return transform;
}

/// A room with boxes that can be moved, objects 1 to 3.
SceneBuilder room_with_boxes(const std::vector<glm::vec3>& places) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(900.0F, 1000.0F, 800.0F));
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 6, wall);
    b.add_quad({1.5F, 2.98F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    for (const glm::vec3& place : places) {
        b.add_object("box", at(place));
        b.add_box({-0.4F, 0, -0.4F}, {0.4F, 0.8F, 0.4F}, false, 3, wall);
    }
    return b;
}

void finish(Solver& solver) {
    while (solver.correcting()) {
        solver.step({});
    }
}

TEST(MovedTogether, ThreeBoxesAreCorrectedInOnePhase) {
    const std::vector<glm::vec3> from = {{0.8F, 0, 0.8F}, {3.0F, 0, 1.0F}, {1.2F, 1.0F, 3.0F}};
    const std::vector<glm::vec3> to = {{2.0F, 0.2F, 2.2F}, {3.2F, 0, 3.1F}, {0.8F, 0, 1.5F}};
    const SceneBuilder after = room_with_boxes(to);
    Solver fresh(after.scene, after.mesh, quick(11));
    iterate(fresh, 768);
    const auto truth = fresh.store().read_irradiance();
    const SceneBuilder before = room_with_boxes(from);
    Solver solver(before.scene, before.mesh, quick(1));
    iterate(solver, 256);
    const double stale = relative_difference(solver.store().read_irradiance(), truth);
    std::vector<ObjectMove> moves;
    for (std::uint32_t i = 0; i < to.size(); ++i) {
        moves.push_back({i + 1, at(to[i]).matrix()});
    }
    solver.move_objects(moves, {});
    finish(solver);
    EXPECT_EQ(solver.special_bundles(), 2 * interactive_special().bundles);
    const double corrected = relative_difference(solver.store().read_irradiance(), truth);
    iterate(solver, 192);
    EXPECT_GT(stale, 0.2);  // the test would show nothing otherwise
    EXPECT_LT(corrected, 0.85 * stale);
    EXPECT_LT(relative_difference(solver.store().read_irradiance(), truth), 0.1);
}

/// What is out of the scene's neighbourhood makes bundles no coarser, there and when it is back.
TEST(MovedTogether, AnObjectFarAwayLeavesTheSceneAsLargeAsItWas) {
    const SceneBuilder b = room_with_boxes({{1.0F, 0, 1.0F}});
    Solver solver(b.scene, b.mesh, quick(3));
    const float diameter = solver.scene().diameter();
    solver.move_object(1, at({500.0F, 0, 0}).matrix(), {});
    finish(solver);
    EXPECT_FLOAT_EQ(solver.scene().diameter(), diameter);
    solver.move_object(1, at({1.0F, 0, 1.0F}).matrix(), {});
    finish(solver);
    EXPECT_FLOAT_EQ(solver.scene().diameter(), diameter);
}

#ifdef RAYBUNDLE_LONG_TESTS
/// numerics.md, "Light carried by the moved object": no worse than a fresh solve at equal time,
/// up to the noise of the few bundles of the phase. Root mean square over ten seeds, with one (203)
/// whose phase hardly meets the lamp; a pair of bundles of the phase counts as two iterations.
/// Ratios of single seeds scatter by 0.2. Measured: 1.13 after 128 iterations, 0.99 after 256.
TEST(MovedTogether, ACarriedLightIsNoWorseThanAFreshSolve) {
    const auto carrier = [](const glm::vec3& place) {
        SceneBuilder b;
        const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
        const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(900.0F, 1000.0F, 800.0F));
        b.add_box({0, 0, 0}, {4, 3, 4}, true, 8, wall);
        b.add_object("lamp", at(place));
        b.add_box({-0.3F, 1.0F, -0.3F}, {0.3F, 1.1F, 0.3F}, false, 2, wall);
        b.add_quad({-0.25F, 0.99F, -0.25F}, {0.5F, 0, 0}, {0, 0, 0.5F}, 2, 2, lamp);
        return b;
    };
    const glm::vec3 from(1.0F, 0.0F, 1.2F);
    const glm::vec3 to(2.8F, 0.4F, 2.6F);
    const SceneBuilder before = carrier(from);
    const SceneBuilder after = carrier(to);
    Solver truth_solver(after.scene, after.mesh, quick(30));
    iterate(truth_solver, 2048);
    const auto truth = truth_solver.store().read_irradiance();
    for (const auto& [count, bound] : {std::pair{128U, 1.2}, std::pair{256U, 1.1}}) {
        double moved = 0.0;
        double fresh = 0.0;
        for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 201U, 202U, 203U, 204U, 205U}) {
            Solver solver(before.scene, before.mesh, quick(seed));
            iterate(solver, 256);
            solver.move_object(1, at(to).matrix(), {});
            finish(solver);
            iterate(solver, count);
            Solver equal(after.scene, after.mesh, quick(100 + seed));
            iterate(equal, count + 2ULL * interactive_special().bundles);
            moved += std::pow(relative_difference(solver.store().read_irradiance(), truth), 2.0);
            fresh += std::pow(relative_difference(equal.store().read_irradiance(), truth), 2.0);
        }
        EXPECT_LT(std::sqrt(moved / fresh), bound) << count;
        RecordProperty("ratio_" + std::to_string(count), std::to_string(std::sqrt(moved / fresh)));
    }
}
#endif

}  // namespace
}  // namespace raybundle::moved_together_test
