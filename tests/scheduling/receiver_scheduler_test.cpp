// SPDX-License-Identifier: Apache-2.0
#include "scheduling/receiver_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace raybundle {
namespace {

std::vector<ReceiverRequest> members(int resting, int moving, double cost_ms) {
    std::vector<ReceiverRequest> all;
    for (int i = 0; i < resting + moving; ++i) {
        all.push_back({static_cast<ViewerId>(i + 1), i >= resting, cost_ms});
    }
    return all;
}

TEST(ReceiverScheduler, AllGatherWhereThereIsTime) {
    ReceiverScheduler scheduler;
    EXPECT_EQ(scheduler.next(members(3, 2, 8.0), 40.0).size(), 5U);
    EXPECT_TRUE(scheduler.next({}, 40.0).empty());
}

TEST(ReceiverScheduler, OneGathersHoweverMuchItCosts) {
    ReceiverScheduler scheduler;
    EXPECT_EQ(scheduler.next(members(2, 0, 1000.0), 40.0).size(), 1U);
}

TEST(ReceiverScheduler, ThoseAtRestHaveEqualTurnsAndNobodyTwoInAGroup) {
    ReceiverScheduler scheduler;
    std::map<ViewerId, int> turns;
    constexpr int kGroups = 700;
    for (int group = 0; group < kGroups; ++group) {
        const std::vector<ViewerId> chosen = scheduler.next(members(7, 0, 10.0), 30.0);
        ASSERT_EQ(std::set<ViewerId>(chosen.begin(), chosen.end()).size(), 3U);
        for (const ViewerId viewer : chosen) {
            ++turns[viewer];
        }
    }
    for (const auto& [viewer, count] : turns) {
        EXPECT_NEAR(count, kGroups * 3 / 7, 1) << viewer;
    }
}

/// Groups are parts of low-discrepancy sequences: a viewer that had every fourth group would see a
/// biased part of them. Binomial counts of 4000 groups in 4 places: six standard deviations.
TEST(ReceiverScheduler, TurnsComeAtEveryPlaceOfTheSequence) {
    ReceiverScheduler scheduler;
    std::map<int, int> places;
    for (int group = 0; group < 16000; ++group) {
        const std::vector<ViewerId> chosen = scheduler.next(members(4, 0, 10.0), 10.0);
        places[group % 4] += chosen.front() == 1 ? 1 : 0;
    }
    for (const auto& [place, count] : places) {
        EXPECT_NEAR(count, 1000, 165) << place;
    }
}

TEST(ReceiverScheduler, WhoMovesGathersOnlyInTimeThatIsLeft) {
    ReceiverScheduler scheduler;
    for (int group = 0; group < 50; ++group) {
        for (const ViewerId viewer : scheduler.next(members(3, 4, 10.0), 30.0)) {
            EXPECT_LE(viewer, 3U);
        }
        const std::vector<ViewerId> more = scheduler.next(members(3, 4, 10.0), 50.0);
        EXPECT_EQ(more.size(), 5U);
        EXPECT_EQ(std::count_if(more.begin(), more.end(), [](ViewerId v) { return v <= 3; }), 3);
    }
}

TEST(ReceiverScheduler, WhoComesLateDoesNotCatchUp) {
    ReceiverScheduler scheduler;
    for (int group = 0; group < 100; ++group) {
        scheduler.next(members(2, 0, 10.0), 10.0);
    }
    std::map<ViewerId, int> turns;
    for (int group = 0; group < 30; ++group) {
        ++turns[scheduler.next(members(3, 0, 10.0), 10.0).front()];
    }
    EXPECT_NEAR(turns[3], 10, 1);
}

}  // namespace
}  // namespace raybundle
