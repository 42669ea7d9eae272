// SPDX-License-Identifier: Apache-2.0
#include "scheduling/change_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scheduling/scheduling_settings.h"

namespace raybundle {
namespace {

constexpr double iteration_share = ChangeSettings().iteration_share;
constexpr ViewerId kFirstDragger = 1;
constexpr ViewerId kSecondDragger = 2;
constexpr ViewerId kFirstWatcher = 3;
constexpr ViewerId kSecondWatcher = 4;
constexpr std::array kEverybody{kFirstDragger, kSecondDragger, kFirstWatcher, kSecondWatcher};

struct Costs {
    double change_ms = 0.0;
    double frame_ms = 0.0;
    double iteration_ms = 0.0;
};

/// A render loop with a clock of its own, in which the next change waits always: two viewers drag,
/// and two more watch. A turn draws one frame and makes one iteration, as far as they are wanted.
struct BusyLoop {
    explicit BusyLoop(const Costs& each) : costs(each) {}

    /// The next change, as soon as it may begin. False: it may not for a thousand turns.
    bool change() {
        for (int turn = 0; !gate.open(solver_rests); ++turn) {
            if (turn == 1000) {
                return false;
            }
            draw(next);
            next = (next + 1) % kEverybody.size();
            iterate();
        }
        constexpr int slices = 8;
        gate.begin_change(0.0);
        for (int i = 0; i < slices; ++i) {
            gate.note_change(costs.change_ms / slices);
        }
        now_ms += costs.change_ms;
        gate.end_change(kEverybody);
        return true;
    }

    void draw(std::size_t viewer) {
        if (kEverybody.at(viewer) == away) {
            gate.excuse(kEverybody.at(viewer));
            return;
        }
        gate.note_frame(kEverybody.at(viewer), costs.frame_ms);
        now_ms += costs.frame_ms;
        ++frames.at(viewer);
    }

    void iterate() {
        if (!solver_rests) {
            gate.note_iteration(costs.iteration_ms);
            now_ms += costs.iteration_ms;
            iterations_ms += costs.iteration_ms;
            ++iterations;
        }
    }

    Costs costs;
    ChangeGate gate{iteration_share};
    bool solver_rests = false;
    ViewerId away = 0;
    double now_ms = 0.0;
    double iterations_ms = 0.0;
    int iterations = 0;
    std::size_t next = 0;
    std::array<int, kEverybody.size()> frames{};
};

TEST(ChangeGate, IsOpenBeforeTheFirstChange) {
    EXPECT_TRUE(ChangeGate(iteration_share).open(false));
}

TEST(ChangeGate, EveryViewerGetsAFrameOfEachChangeHoweverLongAnythingTakes) {
    constexpr int kChanges = 100;
    for (const Costs costs : {Costs{100.0, 10.0, 10.0}, Costs{2000.0, 1.0, 50.0},
                              Costs{5.0, 80.0, 300.0}, Costs{0.0, 0.0, 0.0}}) {
        BusyLoop loop(costs);
        for (int i = 0; i < kChanges; ++i) {
            ASSERT_TRUE(loop.change());
        }
        for (const int frames : loop.frames) {
            EXPECT_GE(frames, kChanges - 1);
        }
        EXPECT_GE(loop.iterations, kChanges - 1);
    }
}

TEST(ChangeGate, IterationsHaveTheirShareHoweverLongAnythingTakes) {
    for (const Costs costs :
         {Costs{100.0, 10.0, 10.0}, Costs{2000.0, 1.0, 50.0}, Costs{5.0, 80.0, 300.0}}) {
        BusyLoop loop(costs);
        for (int i = 0; i < 100; ++i) {
            ASSERT_TRUE(loop.change());
        }
        EXPECT_GE(loop.iterations_ms, iteration_share * (loop.now_ms - costs.change_ms));
    }
}

TEST(ChangeGate, ChangesDoNotWaitForIterationsLongerThanTheirShare) {
    BusyLoop loop({1000.0, 10.0, 1.0});
    for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(loop.change()) << "frames of every turn keep the gate closed";
    }
    constexpr double owed_ms = 260.0;  // a quarter of the change and of one frame for each viewer
    EXPECT_NEAR(loop.iterations_ms / 99.0, owed_ms, 1.0);
}

TEST(ChangeGate, DoesNotWaitForWhoCannotTakeAFrame) {
    BusyLoop loop({100.0, 10.0, 10.0});
    loop.away = kSecondWatcher;
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(loop.change());
    }
    EXPECT_EQ(loop.frames.back(), 0);
}

TEST(ChangeGate, DoesNotWaitForASolverThatRests) {
    BusyLoop loop({100.0, 10.0, 10.0});
    loop.solver_rests = true;
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(loop.change());
    }
    loop.solver_rests = false;
    ASSERT_TRUE(loop.change());
    EXPECT_LE(loop.iterations_ms, 100.0) << "what was not wanted is not made up for";
}

}  // namespace
}  // namespace raybundle
