// SPDX-License-Identifier: Apache-2.0
// Error bars: their arithmetic, and a hundred pictures against their true errors. 800, more scenes
// and targets: error_interval_statistics_test.cpp.
#include "view/error_interval.h"

#include <gtest/gtest.h>

#include <cmath>

#include "judged_scene.h"

namespace raybundle {
namespace {

TEST(ErrorIntervalOf, HasTheErrorBetweenItsEnds) {
    for (const auto& [noise, rest] :
         {std::pair(0.1, 0.0), std::pair(0.0, 0.1), std::pair(0.3, 0.1), std::pair(0.01, 0.1)}) {
        const ErrorInterval interval = error_interval(noise, rest);
        EXPECT_DOUBLE_EQ(interval.error, std::hypot(noise, rest));
        EXPECT_LT(interval.low, interval.error);
        EXPECT_GT(interval.high, interval.error);
    }
    EXPECT_EQ(error_interval(0.0, 0.0).high, 0.0);
}

TEST(VarianceOfMean, BeginsAsOfIndependentBatchesAndFallsWithTheSequence) {
    for (const SampleOrder order : {SampleOrder::low_discrepancy, SampleOrder::shuffled}) {
        EXPECT_DOUBLE_EQ(variance_of_mean(0, order), 1.0 / 7.0);
        EXPECT_DOUBLE_EQ(variance_of_mean(8, order), 1.0 / 7.0);
        EXPECT_GT(variance_of_mean(64, order), variance_of_mean(128, order));
    }
    EXPECT_LT(variance_of_mean(512, SampleOrder::low_discrepancy),
              variance_of_mean(512, SampleOrder::shuffled));
}

/// So many times more samples bring the noise, which falls with their power, to where the interval
/// ends at the target.
TEST(SamplesFactor, LeadsToTheTarget) {
    constexpr double noise = 0.2;
    constexpr double rest = 0.005;
    constexpr double target = 0.02;
    for (const SampleOrder order : {SampleOrder::low_discrepancy, SampleOrder::shuffled}) {
        const double factor = samples_factor(noise, rest, target, order);
        ASSERT_GT(factor, 1.0);
        const auto n = static_cast<std::uint64_t>(1024.0 * factor);
        // Batches scatter like 1/sqrt(n).
        const double then =
            noise * std::sqrt(variance_of_mean(n, order) / variance_of_mean(1024, order) / factor);
        EXPECT_NEAR(error_interval(then, rest).high, target, 1e-4);
        EXPECT_EQ(samples_factor(noise, rest, 1.0, order), 1.0);
        EXPECT_TRUE(std::isinf(samples_factor(noise, 0.02, target, order)));
    }
}

/// 100 pictures, four of each run. Their errors are 10 to 30 %, of which the noise of the reference
/// (2 %) is a small part. With 95 % right, fewer than 87 of 100 are found right once in 1000 times
/// if they are independent; the four of a run are not quite.
TEST(ErrorInterval, CoversTheTrueErrorOfMostPictures) {
    const JudgedScene scene("cornell_box.gltf", 0.4F, 512);
    EXPECT_LT(scene.reference_noise(), 0.03);
    Coverage coverage;
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        scene.run(seed, 0.02, [&](const JudgedPicture& picture) {
            coverage.add(picture);
            return picture.iterations < 64;
        });
    }
    RecordProperty("coverage", coverage.text());
    EXPECT_EQ(coverage.pictures, 100U);
    EXPECT_GE(coverage.covered, 85U) << coverage.text();
    EXPECT_LE(coverage.half_width(), 0.5) << coverage.text();
}

}  // namespace
}  // namespace raybundle
