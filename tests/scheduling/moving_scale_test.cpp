// SPDX-License-Identifier: Apache-2.0
#include "scheduling/moving_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raybundle {
namespace {

constexpr double budget_ms = 32.0;

/// What a frame takes: part of it whatever its size, most of it for its pixels.
double frame_ms(double scale, double full_ms) {
    return 0.15 * full_ms + 0.85 * full_ms * scale * scale;
}

/// After so many frames that are measured with errors of up to 5 %; how often the size changed.
int changes_over(MovingScale& scale, double full_ms, int frames) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> error(0.95, 1.05);
    int changes = 0;
    double estimate = full_ms;
    for (int i = 0; i < frames; ++i) {
        const double before = scale.scale();
        const double measured = frame_ms(before, full_ms) * error(random) / (before * before);
        estimate += 0.2 * (measured - estimate);
        scale.note(estimate, budget_ms);
        changes += scale.scale() != before ? 1 : 0;
    }
    return changes;
}

TEST(MovingScaleTest, PicturesAreFullWhileThereIsTime) {
    MovingScale scale;
    EXPECT_EQ(scale.scale(), 1.0);
    EXPECT_EQ(changes_over(scale, 25.0, 100), 0);
    EXPECT_EQ(scale.scale(), 1.0);
}

TEST(MovingScaleTest, SettlesWhereFramesFitIntoTheirBudget) {
    for (const double full_ms : {35.0, 40.0, 46.0, 60.0}) {
        MovingScale scale;
        EXPECT_LE(changes_over(scale, full_ms, 50), 6) << full_ms;
        EXPECT_EQ(changes_over(scale, full_ms, 200), 0) << full_ms;
        EXPECT_LT(frame_ms(scale.scale(), full_ms), 1.07 * budget_ms) << full_ms;
        EXPECT_GT(frame_ms(scale.scale(), full_ms), 0.75 * budget_ms) << full_ms;
    }
}

TEST(MovingScaleTest, NeverBecomesTooSmallAndGrowsAgain) {
    MovingScale scale;
    scale.note(1e9, budget_ms);
    EXPECT_EQ(scale.scale(), MovingScaleSettings().min);
    scale.note(1.3 * budget_ms, budget_ms);
    EXPECT_NEAR(scale.scale(), 0.875, 1e-9);
    scale.note(0.5 * budget_ms, budget_ms);
    EXPECT_EQ(scale.scale(), 1.0);
    scale.note(0.0, budget_ms);
    EXPECT_EQ(scale.scale(), 1.0);
}

}  // namespace
}  // namespace raybundle
