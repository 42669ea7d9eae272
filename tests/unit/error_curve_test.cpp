// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/error_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace raybundle {
namespace {

CurvePoint point(double seconds, double error) {
    CurvePoint result;
    result.seconds = seconds;
    result.relative_rmse = error;
    return result;
}

ErrorCurve curve(const std::vector<std::pair<double, double>>& points) {
    ErrorCurve result;
    for (const auto& [seconds, error] : points) {
        result.points.push_back(point(seconds, error));
        result.points.back().checkpoint = static_cast<unsigned>(result.points.size() - 1);
    }
    return result;
}

TEST(CheckpointTimes, AreGeometricAndEndAtTheEnd) {
    for (const double seconds : {0.1, 5.0, 30.0, 3600.0}) {
        const std::vector<double> times = checkpoint_times(seconds);
        ASSERT_FALSE(times.empty());
        EXPECT_EQ(times.back(), seconds);
        EXPECT_LE(times.size(), 19U);
        EXPECT_GE(times.front(), 0.1);
        for (std::size_t i = 1; i < times.size(); ++i) {
            EXPECT_NEAR(times[i] / times[i - 1], std::sqrt(2.0), 1e-9);
        }
    }
    EXPECT_EQ(checkpoint_times(5.0).size(), 12U);
    EXPECT_EQ(checkpoint_times(0.05).size(), 1U);
}

TEST(TimeToError, InterpolatesOnLogarithmicScales) {
    // error = 0.1 / sqrt(t)
    const ErrorCurve halving = curve({{1.0, 0.1}, {4.0, 0.05}, {16.0, 0.025}});
    const auto time = time_to_error(halving, 0.1 / std::sqrt(9.0));
    ASSERT_TRUE(time.has_value());
    EXPECT_NEAR(time->seconds, 9.0, 1e-9);
    EXPECT_FALSE(time->at_most);
    EXPECT_NEAR(time_to_error(halving, 0.05)->seconds, 4.0, 1e-9);
    EXPECT_NEAR(time_to_error(halving, 0.025)->seconds, 16.0, 1e-9);
}

TEST(TimeToError, IsNothingWhereTheErrorIsNotReached) {
    EXPECT_FALSE(time_to_error(curve({{1.0, 0.1}, {2.0, 0.05}}), 0.04).has_value());
    EXPECT_FALSE(time_to_error(curve({}), 0.04).has_value());
    const double nan = std::nan("");
    EXPECT_FALSE(time_to_error(curve({{1.0, 0.1}, {2.0, nan}}), 0.2).has_value());
}

TEST(TimeToError, IsABoundWhereTheFirstPointIsWithinIt) {
    const auto time = time_to_error(curve({{1.0, 0.1}, {2.0, 0.05}}), 0.2);
    ASSERT_TRUE(time.has_value());
    EXPECT_TRUE(time->at_most);
    EXPECT_EQ(time->seconds, 1.0);
}

/// A curve that dips and rises again has not arrived at the dip.
TEST(TimeToError, CountsFromWhenTheErrorStaysWithinIt) {
    const ErrorCurve spike =
        curve({{1.0, 0.2}, {2.0, 0.04}, {4.0, 0.3}, {8.0, 0.1}, {16.0, 0.04}, {32.0, 0.03}});
    const auto time = time_to_error(spike, 0.05);
    ASSERT_TRUE(time.has_value());
    EXPECT_GT(time->seconds, 8.0);
    EXPECT_LT(time->seconds, 16.0);
    EXPECT_FALSE(time_to_error(curve({{1.0, 0.01}, {2.0, 0.3}}), 0.05).has_value());
}

TEST(TimeToError, SaysWhetherTheReferenceResolvesIt) {
    ErrorCurve falling = curve({{1.0, 0.2}, {2.0, 0.1}, {4.0, 0.05}});
    falling.points.back().resolved = false;
    EXPECT_TRUE(time_to_error(falling, 0.15)->resolved);
    EXPECT_FALSE(time_to_error(falling, 0.07)->resolved);
}

TEST(SetMeasured, SubtractsTheNoiseInQuadrature) {
    CurvePoint result;
    set_measured(result, {0.05, 0.0025, 0.03, 0.1, 100}, {0.03, 0.0009});
    EXPECT_NEAR(result.relative_rmse, 0.04, 1e-12);
    EXPECT_NEAR(result.mrse, 0.0016, 1e-12);
    EXPECT_EQ(result.median, 0.03);
    EXPECT_FALSE(result.resolved);
    set_measured(result, {0.05, 0.0025, 0.03, 0.1, 100}, {0.01, 0.0001});
    EXPECT_TRUE(result.resolved);
    // Less than the noise: nothing is left, and it is not taken for a measurement.
    set_measured(result, {0.02, 0.0004, 0.01, 0.1, 100}, {0.03, 0.0009});
    EXPECT_EQ(result.relative_rmse, 0.0);
    EXPECT_FALSE(result.resolved);
}

TEST(MergedRuns, GiveTheRootMeanSquareAndStudentsInterval) {
    ErrorCurve a = curve({{1.0, 0.1}});
    ErrorCurve b = curve({{1.2, 0.2}});
    a.points[0].iterations = 10;
    b.points[0].iterations = 13;
    const ErrorCurve merged = merged_runs({a, b});
    ASSERT_EQ(merged.points.size(), 1U);
    const CurvePoint& p = merged.points[0];
    EXPECT_NEAR(p.relative_rmse, std::sqrt(0.025), 1e-12);
    EXPECT_NEAR(p.seconds, 1.1, 1e-12);
    EXPECT_EQ(p.iterations, 12U);
    // Logarithms: mean ln sqrt(0.02), standard error ln(2)/2, one degree of freedom.
    ASSERT_TRUE(p.interval.has_value());
    const double factor = std::exp(12.706 * std::log(2.0) / 2.0);
    EXPECT_NEAR(p.interval->first, std::sqrt(0.02) / factor, 1e-9);
    EXPECT_NEAR(p.interval->second, std::sqrt(0.02) * factor, 1e-9);
}

TEST(MergedRuns, LeaveOutCheckpointsThatOneRunLacks) {
    const ErrorCurve a = curve({{1.0, 0.1}, {2.0, 0.05}, {4.0, 0.02}});
    ErrorCurve b = a;
    b.points.erase(b.points.begin());
    const ErrorCurve merged = merged_runs({a, b});
    ASSERT_EQ(merged.points.size(), 2U);
    EXPECT_EQ(merged.points[0].seconds, 2.0);
}

TEST(MergedRuns, OfOneRunAreTheRun) {
    const ErrorCurve merged = merged_runs({curve({{1.0, 0.1}, {2.0, 0.05}})});
    EXPECT_EQ(merged.points.size(), 2U);
    EXPECT_FALSE(merged.points[0].interval.has_value());
    EXPECT_THROW((void)merged_runs({}), std::invalid_argument);
    EXPECT_THROW((void)merged_runs(std::vector<ErrorCurve>(17)), std::invalid_argument);
}

}  // namespace
}  // namespace raybundle
