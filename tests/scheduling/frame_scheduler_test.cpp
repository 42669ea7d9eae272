// SPDX-License-Identifier: Apache-2.0
#include "scheduling/frame_scheduler.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace raybundle {
namespace {

struct Viewer {
    ViewerId id;
    bool moving;
    double cost_ms;
};

/// Renders for `total_ms` with all viewers wanting frames all the time; returns each one's time.
std::map<ViewerId, double> share(FrameScheduler& scheduler, const std::vector<Viewer>& viewers,
                                 double total_ms) {
    std::vector<FrameRequest> requests;
    for (const Viewer& viewer : viewers) {
        requests.push_back({viewer.id, viewer.moving});
    }
    std::map<ViewerId, double> spent;
    for (double now = 0.0; now < total_ms;) {
        const ViewerId served = scheduler.next(requests).value();
        for (const Viewer& viewer : viewers) {
            if (viewer.id == served) {
                scheduler.charge(served, viewer.cost_ms);
                spent[served] += viewer.cost_ms;
                now += viewer.cost_ms;
            }
        }
    }
    return spent;
}

TEST(FrameScheduler, NobodyWantsAFrame) {
    FrameScheduler scheduler;
    EXPECT_FALSE(scheduler.next({}).has_value());
}

TEST(FrameScheduler, TimeIsSharedNotFrames) {
    FrameScheduler scheduler;
    const auto spent =
        share(scheduler, {{1, true, 3.0}, {2, true, 30.0}, {3, true, 110.0}}, 60000.0);
    for (const auto& [viewer, ms] : spent) {
        EXPECT_NEAR(ms, 20000.0, 300.0) << "viewer " << viewer;
    }
}

TEST(FrameScheduler, MovingViewersHaveALargerShareAndNobodyStarves) {
    FrameScheduler scheduler;
    const auto spent = share(scheduler, {{1, true, 10.0}, {2, false, 10.0}}, 50000.0);
    EXPECT_NEAR(spent.at(1), 40000.0, 300.0);
    EXPECT_NEAR(spent.at(2), 10000.0, 300.0);
}

TEST(FrameScheduler, TheMovingOneComesFirst) {
    FrameScheduler scheduler;
    const std::vector<FrameRequest> requests{{1, false}, {2, false}, {3, true}};
    EXPECT_EQ(scheduler.next(requests), 3U);
}

TEST(FrameScheduler, EqualViewersTakeTurns) {
    FrameScheduler scheduler;
    const std::vector<FrameRequest> requests{{4, true}, {7, true}, {9, true}};
    std::vector<ViewerId> order;
    for (int i = 0; i < 9; ++i) {
        order.push_back(*scheduler.next(requests));
        scheduler.charge(order.back(), 20.0);
    }
    for (std::size_t i = 3; i < order.size(); ++i) {
        EXPECT_EQ(order[i], order[i - 3]);
        EXPECT_NE(order[i], order[i - 1]);
    }
}

TEST(FrameScheduler, WhoWantsNothingSavesNothing) {
    FrameScheduler scheduler;
    const std::vector<FrameRequest> both{{1, true}, {2, true}};
    const std::vector<FrameRequest> second{{2, true}};
    for (int i = 0; i < 1000; ++i) {
        scheduler.charge(*scheduler.next(second), 10.0);
    }
    std::map<ViewerId, int> frames;
    for (int i = 0; i < 40; ++i) {
        const ViewerId viewer = *scheduler.next(both);
        scheduler.charge(viewer, 10.0);
        ++frames[viewer];
    }
    EXPECT_NEAR(frames[1], 20, 2) << "the one that was away must not take over";
}

TEST(FrameScheduler, OtherWorkIsPaidWithFrames) {
    FrameScheduler scheduler;
    const std::vector<FrameRequest> both{{1, true}, {2, true}};
    std::map<ViewerId, int> frames;
    for (int i = 0; i < 300; ++i) {
        const ViewerId viewer = *scheduler.next(both);
        scheduler.charge(viewer, 10.0);
        ++frames[viewer];
        if (viewer == 1) {
            scheduler.charge_besides(1, 20.0);  // resizes, probes
        }
    }
    EXPECT_NEAR(frames[2], 3 * frames[1], 6);
}

TEST(FrameScheduler, AVeryExpensiveViewerIsServedInOneStep) {
    FrameScheduler scheduler;
    const std::vector<FrameRequest> requests{{1, false}};
    for (int i = 0; i < 20; ++i) {
        ASSERT_EQ(scheduler.next(requests), 1U);
        scheduler.charge(1, 1e9);
    }
    EXPECT_LE(scheduler.cost_ms(1), FrameShareSettings().max_cost_ms);
}

}  // namespace
}  // namespace raybundle
