// SPDX-License-Identifier: Apache-2.0
#include "scheduling/frame_policy.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace raybundle {
namespace {

constexpr double picture = 800.0 * 600.0;

ViewerLoad walker(ViewerId viewer, double full_frame_ms = 0.0) {
    return {viewer, true, true, false, picture, picture, full_frame_ms};
}

ViewerLoad watcher(ViewerId viewer) {
    return {viewer, true, false, false, picture, picture, 0.0};
}

/// A render loop on a clock that is set by hand: a frame of everybody who moves, then a step of the
/// solver if the policy lets it.
struct Walk {
    Walk(int walkers, double frame_cost, double step_cost)
        : policy(SchedulingSettings(), clock), frame_ms(frame_cost), step_ms(step_cost) {
        for (int i = 1; i <= walkers; ++i) {
            loads.push_back(walker(static_cast<ViewerId>(i)));
        }
    }

    void turn() {
        policy.begin_frames(loads, true);
        for (const ViewerLoad& load : loads) {
            clock.advance_ms(frame_ms);
            policy.note_frame(load.viewer, frame_ms, picture);
        }
        if (policy.solver_may_run(loads, false)) {
            clock.advance_ms(step_ms);
            policy.note_step(step_ms, loads);
            solved_ms += step_ms;
        }
    }

    /// Part of the time that the solver has over so many turns, once costs are known.
    double solver_share(int turns) {
        for (int i = 0; i < 100; ++i) {
            turn();
        }
        const TimePoint begun = clock.now();
        solved_ms = 0.0;
        for (int i = 0; i < turns; ++i) {
            turn();
        }
        return solved_ms / clock.ms_since(begun);
    }

    ManualClock clock;
    FramePolicy policy;
    std::vector<ViewerLoad> loads;
    double frame_ms, step_ms;
    double solved_ms = 0.0;
};

TEST(FramePolicy, TheSolverKeepsAFifthOfTheTimeBesideFramesOfAWalk) {
    for (const double frame_ms : {40.0, 60.0, 100.0}) {
        EXPECT_NEAR(Walk(1, frame_ms, 30.0).solver_share(4000), 0.2, 0.02) << frame_ms;
    }
    EXPECT_NEAR(Walk(3, 30.0, 30.0).solver_share(4000), 0.2, 0.02) << "several walk";
}

TEST(FramePolicy, TheSolverHasAStepAfterEachRoundOfFramesThatTakeLonger) {
    EXPECT_NEAR(Walk(1, 200.0, 30.0).solver_share(4000), 30.0 / 230.0, 0.01);
}

TEST(FramePolicy, TheSolverHasWhatFramesOfAWalkLeave) {
    EXPECT_NEAR(Walk(1, 20.0, 30.0).solver_share(4000), 0.5, 0.05);
    EXPECT_GT(Walk(1, 5.0, 30.0).solver_share(4000), 0.8);
}

TEST(FramePolicy, AWalkEndsWhereNoFrameIsSentForAWhile) {
    Walk walk(1, 50.0, 30.0);
    walk.turn();
    EXPECT_TRUE(walk.policy.walking(walk.loads));
    walk.clock.advance_ms(RoundSettings().walk_pause_ms + 1.0);
    EXPECT_FALSE(walk.policy.walking(walk.loads));
    EXPECT_TRUE(walk.policy.solver_may_run(walk.loads, false));
}

TEST(FramePolicy, ASpecialPhaseDoesNotWaitForFrames) {
    Walk walk(1, 40.0, 100.0);
    for (int i = 0; i < 10; ++i) {
        walk.turn();
    }
    EXPECT_FALSE(walk.policy.solver_may_run(walk.loads, false));
    EXPECT_TRUE(walk.policy.solver_may_run(walk.loads, true)) << "no frame is drawn meanwhile";
}

TEST(FramePolicy, WhoMovesWaitsForNoLongStep) {
    Walk walk(1, 10.0, 200.0);
    walk.turn();
    const RoundSettings round;
    EXPECT_EQ(walk.policy.frame_slice_ms(false), round.frame_slice_ms);
    EXPECT_EQ(walk.policy.frame_slice_ms(true), round.slice_steps * 200.0);
}

TEST(FramePolicy, PicturesInMotionShrinkWhereFramesTakeTooLong) {
    const ManualClock clock;
    FramePolicy policy(SchedulingSettings(), clock);
    policy.begin_frames(std::vector{walker(1, 25.0)}, true);
    EXPECT_EQ(policy.moving_scale(), 1.0);
    policy.begin_frames(std::vector{walker(1, 25.0), walker(2, 25.0)}, true);
    EXPECT_LT(policy.moving_scale(), 1.0);
}

TEST(FramePolicy, AllPicturesShrinkWhileADragTakesTooLong) {
    ManualClock clock;
    FramePolicy policy(SchedulingSettings(), clock);
    ChangePolicy& changes = policy.changes();
    const std::array<ViewerId, 1> watchers{1};
    changes.begin_phase(true);
    clock.advance_ms(400.0);
    changes.note_bundle(400.0, true, picture, picture);
    changes.end_change(watchers);
    EXPECT_TRUE(changes.dragging());
    EXPECT_LT(policy.moving_scale(), 1.0);
    clock.advance_ms(ChangeSettings().drag_pause_ms + 1.0);
    EXPECT_FALSE(changes.dragging());
    EXPECT_EQ(policy.moving_scale(), 1.0);
}

TEST(FramePolicy, NobodyWhoLooksAwayGathersLightWhileOthersWatch) {
    const ManualClock clock;
    FramePolicy policy(SchedulingSettings(), clock);
    std::vector<ViewerLoad> loads{watcher(1), watcher(2)};
    loads[1].paused = true;
    EXPECT_EQ(policy.choose_receivers(loads), std::vector<ViewerId>{1});
    loads[0].paused = true;
    EXPECT_EQ(policy.choose_receivers(loads).size(), 2U) << "nobody watches: all go on";
}

TEST(FramePolicy, RequestsOfOneViewerWaitOnceTheyHaveHadTheirShare) {
    ManualClock clock;
    FramePolicy policy(SchedulingSettings(), clock);
    EXPECT_TRUE(policy.exhausted_requests().empty());
    policy.note_request(1, 1.0, 2);
    policy.note_request(2, 1.0, 2);
    EXPECT_TRUE(policy.exhausted_requests().empty());
    policy.note_request(1, 1000.0, 2);
    policy.note_request(2, 1.0, 2);
    EXPECT_EQ(policy.exhausted_requests(), std::set<ViewerId>{1});
    clock.advance_ms(4000.0);
    EXPECT_TRUE(policy.exhausted_requests().empty());
    policy.note_request(1, 1000.0, 2);
    policy.forget(1);
    EXPECT_TRUE(policy.exhausted_requests().empty()) << "who has left owes nothing";
}

TEST(FramePolicy, FirstFramesHaveABudgetOfTheirOwnForThoseWhoDoNotAnswer) {
    ManualClock clock;
    FramePolicy policy(SchedulingSettings(), clock);
    EXPECT_TRUE(policy.may_greet(false));
    policy.note_greeting(false, 1000.0);
    EXPECT_FALSE(policy.may_greet(false));
    EXPECT_TRUE(policy.may_greet(true));
}

TEST(FramePolicy, RefusesNobodyWhereNoFrameRateIsAskedFor) {
    const ManualClock clock;
    SchedulingSettings settings;
    FramePolicy generous(settings, clock);
    settings.min_frames_per_second = 10.0;
    FramePolicy strict(settings, clock);
    for (int i = 0; i < 100; ++i) {
        generous.note_frame(1, 90.0, picture);
        strict.note_frame(1, 90.0, picture);
    }
    EXPECT_TRUE(generous.admit(800, 600, picture).fits);
    EXPECT_FALSE(strict.admit(800, 600, picture).fits);
    EXPECT_TRUE(strict.admit(800, 600, 0.0).fits) << "the first one is never refused";
}

}  // namespace
}  // namespace raybundle
