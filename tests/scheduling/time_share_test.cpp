// SPDX-License-Identifier: Apache-2.0
#include "scheduling/time_share.h"

#include "scheduling/time_budget.h"

#include <gtest/gtest.h>

namespace raybundle {
namespace {

/// Extra time over usual time, where an iteration costs `usual` and taking part `extra` more, in
/// groups of eight.
double measured_share(double share, double usual, double extra) {
    TimeShare time(share, 500.0, 0.1);
    double spent = 0.0;
    constexpr int kGroups = 20000;
    for (int group = 0; group < kGroups; ++group) {
        const bool takes_part = time.may();
        for (int i = 0; i < 8; ++i) {
            time.note_iteration(usual + (takes_part ? extra : 0.0), takes_part);
            spent += takes_part ? extra : 0.0;
        }
    }
    return spent / (8.0 * kGroups * usual);
}

TEST(TimeShareTest, WhatIsAddedStaysBelowItsShareWhateverItCosts) {
    for (const double extra : {3.0, 10.0, 100.0, 2000.0}) {
        const double share = measured_share(0.15, 20.0, extra);
        EXPECT_LE(share, 0.16) << extra;
        EXPECT_GE(share, 0.13) << extra << ": it gets what it may have";
    }
    EXPECT_NEAR(measured_share(0.15, 20.0, 1.0), 0.05, 0.01) << "what is cheap always takes part";
}

TEST(TimeShareTest, WaitsUntilTheUsualCostIsKnown) {
    TimeShare time(0.15, 500.0, 0.1);
    EXPECT_FALSE(time.may());
    time.note_iteration(20.0, false);
    EXPECT_TRUE(time.may());
    time.charge(4.0);
    EXPECT_FALSE(time.may());
}

TEST(TimeShareTest, DoesNotSaveUpWithoutBounds) {
    TimeShare time(0.15, 500.0, 0.1);
    for (int i = 0; i < 100000; ++i) {
        time.note_iteration(20.0, false);
    }
    time.charge(500.0);
    EXPECT_FALSE(time.may());
}

TEST(TimeBudgetTest, WorkStaysBelowItsShareWhateverAPieceCosts) {
    for (const double piece_ms : {1.0, 30.0, 500.0}) {
        TimeBudget budget({0.1, 100.0});
        constexpr double kTotalMs = 1e6;
        double spent = 0.0;
        for (double now = 0.0; now < kTotalMs; now += 5.0) {
            if (budget.may(now)) {
                budget.charge(piece_ms);
                spent += piece_ms;
            }
        }
        EXPECT_LE(spent, 0.1 * kTotalMs + 100.0 + piece_ms) << piece_ms;
        EXPECT_GE(spent, 0.099 * kTotalMs) << piece_ms;
    }
}

TEST(TimeBudgetTest, SavesUpNoMoreThanItsBurstAndSurvivesAClockThatJumps) {
    TimeBudget budget({0.5, 100.0});
    EXPECT_TRUE(budget.may(1e9));
    budget.charge(100.0);
    EXPECT_FALSE(budget.may(1e9));
    EXPECT_FALSE(budget.may(0.0));
    EXPECT_TRUE(budget.may(10.0)) << "earns again from where the clock is now";
}

}  // namespace
}  // namespace raybundle
