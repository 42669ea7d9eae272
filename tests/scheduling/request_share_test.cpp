// SPDX-License-Identifier: Apache-2.0
#include "scheduling/request_share.h"

#include <gtest/gtest.h>

namespace raybundle {
namespace {

/// Share of the time that requests take of which there are always more: `greedy` of all viewers
/// make one after the other as they may, each of `cost_ms`, and 20 ms of other work come between.
double measured_share(std::size_t greedy, std::size_t viewers, double cost_ms) {
    constexpr double kEnd = 1e6;
    constexpr double kOtherWork = 20.0;
    RequestShare share;
    double now = 0.0;
    double spent = 0.0;
    while (now < kEnd) {
        now += kOtherWork;
        for (ViewerId viewer = 1; viewer <= greedy; ++viewer) {
            while (!share.exhausted(now).contains(viewer)) {
                share.charge(viewer, cost_ms, viewers);
                now += cost_ms;
                spent += cost_ms;
            }
        }
    }
    return spent / now;
}

TEST(RequestShare, OneViewerTakesAQuarterWhateverARequestCosts) {
    for (const double cost : {1.0, 5.0, 100.0, 3000.0}) {
        EXPECT_NEAR(measured_share(1, 1, cost), 0.25, 0.01) << cost;
        EXPECT_NEAR(measured_share(1, 2, cost), 0.25, 0.01) << cost;
    }
}

TEST(RequestShare, AllTogetherTakeHalf) {
    for (const std::size_t viewers : {2U, 5U, 16U}) {
        EXPECT_NEAR(measured_share(viewers, viewers, 5.0), 0.5, 0.02) << viewers;
    }
    EXPECT_NEAR(measured_share(1, 16, 5.0), 0.5 / 16.0, 0.005) << "one of many has its own";
}

TEST(RequestShare, WhoAsksNowAndThenNeverWaits) {
    RequestShare share;
    for (double now = 0.0; now < 1e5; now += 100.0) {
        EXPECT_TRUE(share.exhausted(now).empty());
        share.charge(7, 20.0, 2);
    }
}

TEST(RequestShare, ANewViewerOwesNothing) {
    RequestShare share;
    share.charge(7, 1000.0, 1);
    EXPECT_TRUE(share.exhausted(1.0).contains(7));
    share.forget(7);
    EXPECT_TRUE(share.exhausted(1.0).empty());
}

}  // namespace
}  // namespace raybundle
