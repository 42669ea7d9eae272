// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "research/plot/axis.h"
#include "research/plot/plot_labels.h"

namespace raybundle {
namespace {

std::vector<std::string> labels_of(const Axis& axis) {
    std::vector<std::string> labels;
    for (const AxisTick& tick : axis.ticks) {
        if (!tick.label.empty()) {
            labels.push_back(tick.label);
        }
    }
    return labels;
}

TEST(LogarithmicAxis, EndsAtOneTwoOrFiveAndLabelsThese) {
    const Axis axis = axis_for({0.13, 4.2}, AxisScale::logarithmic, " s");
    EXPECT_NEAR(axis.low, 0.1, 1e-12);
    EXPECT_NEAR(axis.high, 5.0, 1e-12);
    EXPECT_EQ(labels_of(axis),
              (std::vector<std::string>{"0.1 s", "0.2 s", "0.5 s", "1 s", "2 s", "5 s"}));
}

TEST(LogarithmicAxis, KeepsEndsThatAreRoundAlready) {
    const Axis axis = axis_for({0.1, 5.0}, AxisScale::logarithmic, "");
    EXPECT_NEAR(axis.low, 0.1, 1e-12);
    EXPECT_NEAR(axis.high, 5.0, 1e-12);
    EXPECT_EQ(axis.ticks.front().label, "0.1");
    EXPECT_EQ(axis.ticks.back().label, "5");
}

TEST(LogarithmicAxis, LabelsOnlyPowersOfTenOverManyDecades) {
    const Axis axis = axis_for({1.0, 100000.0}, AxisScale::logarithmic, "");
    EXPECT_EQ(labels_of(axis),
              (std::vector<std::string>{"1", "10", "100", "1000", "10000", "100000"}));
    EXPECT_EQ(axis.ticks.size(), 46U);  // 9 lines a decade
}

TEST(LogarithmicAxis, HasTicksWhereAllValuesAreOne) {
    const Axis axis = axis_for({2.0}, AxisScale::logarithmic, "");
    EXPECT_LT(axis.low, 2.0);
    EXPECT_GT(axis.high, 2.0);
    EXPECT_GE(labels_of(axis).size(), 2U);
}

TEST(LogarithmicAxis, PassesOverWhatItCannotShow) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const Axis axis = axis_for({nan, infinity, 0.0, -1.0, 3.0, 30.0}, AxisScale::logarithmic, "");
    EXPECT_NEAR(axis.low, 2.0, 1e-12);
    EXPECT_NEAR(axis.high, 50.0, 1e-12);
    const Axis empty = axis_for({nan}, AxisScale::logarithmic, "");
    EXPECT_GT(empty.low, 0.0);
    EXPECT_GT(empty.high, empty.low);
}

TEST(LogarithmicAxis, PutsEqualFactorsAtEqualDistances) {
    const Axis axis = axis_for({1.0, 100.0}, AxisScale::logarithmic, "");
    EXPECT_NEAR(axis.position(10.0), 0.5, 1e-12);
    EXPECT_NEAR(axis.position(1.0), 0.0, 1e-12);
    EXPECT_NEAR(axis.position(100.0), 1.0, 1e-12);
}

/// Over a wide range of ends: ticks ascend, lie within, and some have labels.
TEST(LogarithmicAxis, IsSoundForAnyRange) {
    for (double low = 1e-7; low < 1e6; low *= 1.7) {
        for (double factor = 1.0; factor < 1e7; factor *= 2.3) {
            const Axis axis = axis_for({low, low * factor}, AxisScale::logarithmic, "");
            ASSERT_LE(axis.low, low * (1.0 + 1e-9));
            ASSERT_GE(axis.high, low * factor * (1.0 - 1e-9));
            ASSERT_GE(labels_of(axis).size(), 2U) << low << " x " << factor;
            ASSERT_LE(labels_of(axis).size(), 16U) << low << " x " << factor;
            for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
                ASSERT_TRUE(std::isfinite(axis.position(axis.ticks[i].value)));
                ASSERT_GE(axis.position(axis.ticks[i].value), -1e-6);
                ASSERT_LE(axis.position(axis.ticks[i].value), 1.0 + 1e-6);
                ASSERT_TRUE(i == 0 || axis.ticks[i].value > axis.ticks[i - 1].value);
            }
        }
    }
}

TEST(LinearAxis, StepsByRoundNumbers) {
    const Axis axis = axis_for({-3.0, 47.0}, AxisScale::linear, "");
    EXPECT_EQ(labels_of(axis),
              (std::vector<std::string>{"-10", "0", "10", "20", "30", "40", "50"}));
    const Axis constant = axis_for({4.0}, AxisScale::linear, "");
    EXPECT_LT(constant.low, 4.0);
    EXPECT_GT(constant.high, 4.0);
}

TEST(PlotLabels, StayWhereTheyAreWantedIfThereIsRoom) {
    EXPECT_EQ(spread_labels({50.0, 10.0}, 16.0, 0.0, 100.0), (std::vector<double>{50.0, 10.0}));
}

TEST(PlotLabels, MoveApartAboutTheirMiddle) {
    const std::vector<double> placed = spread_labels({50.0, 52.0, 48.0}, 10.0, 0.0, 100.0);
    EXPECT_NEAR(placed[0], 50.0, 1e-9);
    EXPECT_NEAR(placed[1], 60.0, 1e-9);
    EXPECT_NEAR(placed[2], 40.0, 1e-9);
}

TEST(PlotLabels, PushNeighboursOnAndStayInside) {
    const std::vector<double> placed = spread_labels({1.0, 2.0, 14.0, 99.0}, 10.0, 0.0, 100.0);
    EXPECT_NEAR(placed[0], 0.0, 1e-9);
    for (std::size_t i = 1; i < placed.size(); ++i) {
        EXPECT_GE(placed[i] - placed[i - 1], 10.0 - 1e-9);
    }
    EXPECT_LE(placed.back(), 100.0);
    EXPECT_TRUE(spread_labels({}, 10.0, 0.0, 1.0).empty());
}

}  // namespace
}  // namespace raybundle
