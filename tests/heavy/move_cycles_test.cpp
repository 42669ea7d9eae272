// SPDX-License-Identifier: Apache-2.0
// numerics.md, "Moves there and back": drift of signed increments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

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

std::vector<double> luminances(const Solver& solver) {
    std::vector<double> result;
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        result.push_back(static_cast<double>(luminance(glm::vec3(e))));
    }
    return result;
}

/// Mean and standard deviation of a patch over fresh solves.
struct Expected {
    double mean = 0.0;
    double deviation = 0.0;
};

std::vector<Expected> expected_of_fresh_solves(const SceneBuilder& b) {
    std::vector<std::vector<double>> runs;
    for (int k = 0; k < fresh_solves; ++k) {
        Solver fresh(b.scene, b.mesh, quick(100 + static_cast<std::uint64_t>(k)));
        iterate(fresh, iterations_at_rest);
        runs.push_back(luminances(fresh));
    }
    std::vector<Expected> result(runs.front().size());
    double pooled = 0.0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        double sum = 0.0;
        double squares = 0.0;
        for (const std::vector<double>& run : runs) {
            sum += run[i] / fresh_solves;
            squares += run[i] * run[i] / fresh_solves;
        }
        const double variance =
            std::max(squares - sum * sum, 0.0) * fresh_solves / (fresh_solves - 1.0);
        result[i] = {sum, std::sqrt(variance)};
        pooled += sum > 0.0 ? variance / (sum * sum) / static_cast<double>(result.size()) : 0.0;
    }
    // Of eight runs one patch in many has a deviation that is too small by chance.
    for (Expected& patch : result) {
        patch.deviation = std::max(patch.deviation, std::sqrt(pooled) * patch.mean);
    }
    return result;
}

/// The solution lasts: after the moves it iterates twice as long as the fresh solves have, since
/// samples after a change weigh less at first, and no patch is off by more than 5 standard
/// deviations of a difference to their mean (of some 1000 patches one would be by chance with a
/// probability below 0.1 %).
TEST(MoveCycles, FiveHundredTimesThereAndBackEqualsFreshSolves) {
    const SceneBuilder b = room_with_box(first_place);
    const std::vector<Expected> expected = expected_of_fresh_solves(b);
    Solver solver(b.scene, b.mesh, quick(1));
    iterate(solver, 256);
    for (int i = 0; i < RAYBUNDLE_MOVE_CYCLES; ++i) {
        move_box(solver, second_place);
        move_box(solver, first_place);
    }
    iterate(solver, 2 * iterations_at_rest);
    const std::vector<double> after = luminances(solver);
    const double spread = std::sqrt(1.0 + 1.0 / fresh_solves);
    double worst = 0.0;
    double sum = 0.0;
    double wanted = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        ASSERT_TRUE(std::isfinite(after[i]));
        sum += after[i];
        wanted += expected[i].mean;
        if (expected[i].deviation > 0.0) {
            worst = std::max(
                worst, std::abs(after[i] - expected[i].mean) / (spread * expected[i].deviation));
        }
    }
    EXPECT_LT(worst, 5.0);
    EXPECT_NEAR(sum, wanted, 0.02 * wanted);
    EXPECT_EQ(solver.non_finite(), 0U);
    RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace raybundle
