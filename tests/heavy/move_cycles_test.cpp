// SPDX-License-Identifier: Apache-2.0
// numerics.md, "Moves there and back": drift of signed increments.
#include <gtest/gtest.h>

#include <vector>

#include "../oracle/fresh_solves.h"
#include "../oracle/moved_box.h"

namespace raybundle {
namespace {

const glm::vec3 first_place(1.2F, 0.0F, 1.5F);
const glm::vec3 second_place(2.6F, 0.0F, 2.4F);
constexpr int fresh_solves = 8;
constexpr std::uint64_t iterations_at_rest = 768;

SolverSettings quick(std::uint64_t seed) {
    SolverSettings settings = quick_settings(seed, {48, 64});
    settings.special = interactive_special();
    return settings;
}

/// The solution lasts: after the moves it iterates twice as long as the fresh solves have, since
/// samples after a change weigh less at first, and no patch is off by more than 5 standard
/// deviations of a difference to their mean (of some 1000 patches one would be by chance with a
/// probability below 0.1 %).
TEST(MoveCycles, FiveHundredTimesThereAndBackEqualsFreshSolves) {
    const SceneBuilder b = room_with_box(first_place);
    const FreshSolves fresh = solve_afresh(b, quick(100), fresh_solves, iterations_at_rest);
    Solver solver(b.scene, b.mesh, quick(1));
    iterate(solver, 256);
    for (int i = 0; i < RAYBUNDLE_MOVE_CYCLES; ++i) {
        move_box(solver, second_place);
        move_box(solver, first_place);
    }
    iterate(solver, 2 * iterations_at_rest);
    const std::vector<double> after = luminances(solver);
    EXPECT_LT(fresh.worst(after), 5.0);
    EXPECT_NEAR(fresh.level(after), 1.0, 0.02);
    EXPECT_EQ(solver.non_finite(), 0U);
    RecordProperty("worst", std::to_string(fresh.worst(after)));
}

}  // namespace
}  // namespace raybundle
