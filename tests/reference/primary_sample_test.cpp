// SPDX-License-Identifier: Apache-2.0
#include "research/primary_sample.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raybundle {
namespace {

std::vector<double> draw(PrimarySample& sample, int count) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        values.push_back(sample.next());
    }
    return values;
}

double largest_step(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double step = std::abs(a[i] - b[i]);
        largest = std::max(largest, std::min(step, 1.0 - step));  // 0 and 1 are one point
    }
    return largest;
}

TEST(PrimarySample, RejectionRestoresThePoint) {
    PrimarySample sample{RandomStream(1, 0)};
    const std::vector<double> start = draw(sample, 20);
    for (int i = 0; i < 10; ++i) {
        sample.propose(i % 3 == 0);
        (void)draw(sample, 12 + i);
        sample.reject();
    }
    // A small step from where it was: 8 standard deviations of 0.01.
    sample.propose(false);
    EXPECT_LT(largest_step(start, draw(sample, 20)), 0.08);
}

TEST(PrimarySample, SmallStepsAreSmallAndLargeOnesAreNot) {
    PrimarySample sample{RandomStream(2, 0)};
    std::vector<double> current = draw(sample, 20);
    for (int i = 0; i < 50; ++i) {
        sample.propose(false);
        const std::vector<double> next = draw(sample, 20);
        EXPECT_LT(largest_step(current, next), 0.08);
        EXPECT_GT(largest_step(current, next), 1e-4);
        sample.accept();
        current = next;
    }
    sample.propose(true);
    EXPECT_GT(largest_step(current, draw(sample, 20)), 0.2);
}

/// A chain that accepts everything stays uniform. Coordinates that are asked for rarely make all
/// their steps at once. Mean and mean square within 4.5 standard errors of independent numbers,
/// which large steps at every fifth step make a fifth as many: 1 in 150 000 each.
TEST(PrimarySample, StaysUniform) {
    PrimarySample sample{RandomStream(3, 0)};
    (void)draw(sample, 6);
    constexpr int steps = 100'000;
    double sums[6] = {};
    double squares[6] = {};
    int counts[6] = {};
    for (int i = 0; i < steps; ++i) {
        sample.propose(i % 5 == 0);
        const std::size_t asked = i % 7 == 0 ? 6 : 3;
        const std::vector<double> values = draw(sample, static_cast<int>(asked));
        for (std::size_t c = 0; c < asked; ++c) {
            sums[c] += values[c];
            squares[c] += values[c] * values[c];
            ++counts[c];
        }
        sample.accept();
    }
    for (int c = 0; c < 6; ++c) {
        const double independent = std::min(steps / 5.0, static_cast<double>(counts[c]));
        const double bound = 4.5 / std::sqrt(independent);
        EXPECT_NEAR(sums[c] / counts[c], 0.5, bound * std::sqrt(1.0 / 12.0)) << c;
        EXPECT_NEAR(squares[c] / counts[c], 1.0 / 3.0, bound * std::sqrt(4.0 / 45.0)) << c;
    }
}

}  // namespace
}  // namespace raybundle
