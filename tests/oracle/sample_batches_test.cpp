// SPDX-License-Identifier: Apache-2.0
// What batches of samples tell of a picture's noise, from sums whose modes are known.
#include "view/error/sample_batches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace raybundle::sample_batches_test {
namespace {

constexpr auto order = SampleOrder::low_discrepancy;

/// Half-width for m modes, see SampleBatches::luck().
double luck_of(double modes) {
    return 1.96 * std::sqrt(0.5 / modes);
}

/// After 64 batches of a picture of so many equal modes, whose successive deviations have a
/// correlation.
double measured_luck(unsigned modes, double correlation) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    SampleBatches batches;
    std::vector<double> last(modes, 0.0);
    SampleWeights all;
    for (int batch = 0; batch < 64; ++batch) {
        all.samples += 8;
        all.sum += 8.0F;
        all.squares += 8.0F;
        EXPECT_TRUE(batches.end(all, order));
        SampleBatches::Sums sums;
        for (double& v : last) {
            const double now = correlation * v + normal(random);
            sums.product += now * v;
            sums.square += now * now;
            sums.other += v * v;
            v = now;
        }
        batches.take(sums);
    }
    return batches.luck(order);
}

TEST(SampleBatches, FindHowManyModesTheNoiseHas) {
    EXPECT_NEAR(SampleBatches().luck(order), usual_luck(order), 1e-12);
    for (const unsigned modes : {2U, 5U, 40U}) {
        // 62 squared cosines: their mean is known to some 18 %, its root to 9 %.
        EXPECT_NEAR(measured_luck(modes, 0.0) / luck_of(modes), 1.0, 0.3) << modes << " modes";
    }
}

/// Batches of one low-discrepancy sequence avoid each other.
TEST(SampleBatches, TakeAvoidanceForNoMode) {
    EXPECT_NEAR(measured_luck(40, -0.3) / luck_of(40), 1.0, 0.3);
}

TEST(SampleBatches, SayWhereSamplesHangTogether) {
    SampleBatches batches;
    SampleWeights all;
    SampleBatches::Sums sums;
    sums.of_samples = 1.0;
    double expected = 0.0;
    for (int batch = 0; batch < 4; ++batch) {
        all.samples += 8;
        all.sum += 8.0F;
        all.squares += 8.0F;
        EXPECT_TRUE(batches.end(all, order));
        expected = variance_of_mean(8, order);
        sums.variance = 3.0 * expected;
        batches.take(sums);
        EXPECT_NEAR(batches.correlation(), batch == 0 ? 1.0 : 3.0, 1e-6);
    }
    EXPECT_FALSE(batches.end(all, order)) << "no new samples";
    sums.variance = 0.0;
    batches.take(sums);
    EXPECT_NEAR(batches.correlation(), 3.0, 1e-6) << "of the last batch that had any";
    all.samples += 8;
    all.sum += 8.0F;
    all.squares += 8.0F;
    EXPECT_TRUE(batches.end(all, order));
    sums.variance = 0.3 * expected;
    batches.take(sums);
    EXPECT_EQ(batches.correlation(), 1.0);
    batches.restart();
    EXPECT_EQ(batches.correlation(), 1.0);
    EXPECT_EQ(batches.begin(), 0.0F);
}

}  // namespace
}  // namespace raybundle::sample_batches_test
