// SPDX-License-Identifier: Apache-2.0
// What plays when, by a clock that stands still until it is set.
#include "session/animation/animation_player.h"

#include <gtest/gtest.h>

#include <memory>

#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

/// Two boxes in a file: "both" slides both by 4 m in 4 s, "second" lifts the second one.
Scene two_boxes() {
    Scene scene;
    for (std::uint32_t id = 1; id <= 2; ++id) {
        Object box;
        box.id = id;
        box.movable = true;
        box.bounds.add(glm::vec3(0.0F));
        box.bounds.add(glm::vec3(1.0F));
        scene.objects.push_back(box);
    }
    scene.materials.emplace_back();
    scene.bounds.add(glm::vec3(-10.0F));
    scene.bounds.add(glm::vec3(10.0F));
    auto all = std::make_shared<SceneAnimations>();
    all->tracks = {{Interpolation::linear, 3, {0.0F, 4.0F}, {0, 0, 0, 4, 0, 0}},
                   {Interpolation::linear, 3, {0.0F, 4.0F}, {0, 0, 0, 0, 4, 0}}};
    all->nodes.resize(2);
    all->objects = {{0, 0, true}, {1, 1, true}};
    Animation both;
    both.name = "both";
    both.seconds = 4.0;
    both.objects = {0, 1};
    both.channels = {{AnimatedValue::translation, 0, 0}, {AnimatedValue::translation, 1, 0}};
    Animation second;
    second.name = "second";
    second.seconds = 4.0;
    second.objects = {1};
    second.channels = {{AnimatedValue::translation, 1, 1}};
    all->animations = {both, second};
    scene.animations = all;
    return scene;
}

class Playing : public testing::Test {
  protected:
    v1::PlayAnimation request(const std::string& name = "both") {
        v1::PlayAnimation message;
        message.set_animation(name);
        return message;
    }
    std::vector<std::size_t> start(const std::string& name = "both") {
        v1::PlayAnimation message = request(name);
        message.set_playing(true);
        return player.play(message, 7, "Ada");
    }
    std::vector<std::size_t> pause() {
        v1::PlayAnimation message = request();
        message.set_playing(false);
        return player.play(message, 7, "Ada");
    }
    void seek(double seconds, std::uint32_t by = 7) {
        v1::PlayAnimation message = request();
        message.set_seconds(static_cast<float>(seconds));
        (void)player.play(message, by, "Ada");
    }
    /// Makes the changes of a step, as ChangeCoordinator does.
    std::vector<v1::SceneChanged> step(bool watched = true) {
        std::vector<v1::SceneChanged> changes = player.step(watched);
        for (v1::SceneChanged& change : changes) {
            player.number(change, ++epoch);
            player.note_recorded(change, epoch);
            apply(scene, change);
        }
        return changes;
    }
    [[nodiscard]] float x(std::size_t object = 0) const {
        return scene.objects[object].transform.translation.x;
    }

    Scene scene = two_boxes();
    ManualClock clock;
    AnimationPlayer player{scene, clock};
    std::uint32_t epoch = 0;
};

TEST_F(Playing, FollowsTheClockAndEndsFinally) {
    EXPECT_TRUE(step().empty());
    EXPECT_EQ(start(), std::vector<std::size_t>{0});
    EXPECT_TRUE(step().empty());  // it is there already
    clock.advance_ms(1500.0);
    std::vector<v1::SceneChanged> changes = step();
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_FALSE(changes[0].move_object().final());
    EXPECT_EQ(changes[0].by(), 7U);
    EXPECT_EQ(changes[0].by_name(), "Ada");
    EXPECT_FLOAT_EQ(changes[0].animation().seconds(), 1.5F);
    EXPECT_FLOAT_EQ(x(0), 1.5F);
    EXPECT_FLOAT_EQ(x(1), 1.5F);
    EXPECT_TRUE(step().empty());
    clock.advance_ms(9000.0);
    changes = step();
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_TRUE(changes[0].move_object().final());
    EXPECT_EQ(x(), 4.0F);
    EXPECT_EQ(player.take_ended(), std::vector<std::size_t>{0});
    EXPECT_FALSE(player.state_of(0).playing());
    EXPECT_EQ(player.state_of(0).seconds(), 4.0F);
    EXPECT_TRUE(step().empty());
    start();  // begins anew
    clock.advance_ms(1000.0);
    step();
    EXPECT_FLOAT_EQ(x(), 1.0F);
}

TEST_F(Playing, PausesWhereItIsWithALastStep) {
    start();
    clock.advance_ms(1000.0);
    step();
    clock.advance_ms(250.0);
    pause();
    clock.advance_ms(5000.0);
    const auto changes = step();
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_TRUE(changes[0].move_object().final());
    EXPECT_FLOAT_EQ(x(), 1.25F);
    EXPECT_TRUE(step().empty());
    start();
    clock.advance_ms(500.0);
    step();
    EXPECT_FLOAT_EQ(x(), 1.75F);
}

/// What stops right after a step is said to stand, although it stands there already.
TEST_F(Playing, TheLastStepIsFinalEvenIfNothingHasMovedSince) {
    start();
    clock.advance_ms(1000.0);
    step();
    pause();
    const auto changes = step();
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_TRUE(changes[1].move_object().final());
}

TEST_F(Playing, SpeedBackwardsAndLoop) {
    v1::PlayAnimation message = request();
    message.set_playing(true);
    message.set_loop(true);
    message.set_speed(2.0F);
    (void)player.play(message, 7, "Ada");
    clock.advance_ms(1000.0);
    step();
    EXPECT_FLOAT_EQ(x(), 2.0F);
    clock.advance_ms(1500.0);
    step();
    EXPECT_NEAR(x(), 1.0F, 1e-5F);
    message.set_speed(-1.0F);
    message.set_loop(false);
    (void)player.play(message, 7, "Ada");
    clock.advance_ms(500.0);
    step();
    EXPECT_NEAR(x(), 0.5F, 1e-5F);
    clock.advance_ms(2000.0);
    step();
    EXPECT_EQ(x(), 0.0F);
    EXPECT_EQ(player.take_ended(), std::vector<std::size_t>{0});
}

TEST_F(Playing, SeeksWhileItStandsAndNotBeyondTheEnd) {
    seek(3.0);
    ASSERT_EQ(step().size(), 2U);
    EXPECT_EQ(x(), 3.0F);
    seek(99.0);
    step();
    EXPECT_EQ(x(), 4.0F);
    EXPECT_EQ(player.state_of(0).seconds(), 4.0F);
}

TEST_F(Playing, NobodyWatchesNothingIsDrawnButItEnds) {
    start();
    clock.advance_ms(1000.0);
    EXPECT_TRUE(step(false).empty());
    EXPECT_FLOAT_EQ(player.state_of(0).seconds(), 1.0F);
    clock.advance_ms(5000.0);
    EXPECT_EQ(step(false).size(), 2U);
    EXPECT_EQ(x(), 4.0F);
}

/// Later ones find what the others have moved, and two never pull at one thing.
TEST_F(Playing, StartingOnePausesThoseThatMoveTheSame) {
    start();
    clock.advance_ms(1000.0);
    step();
    EXPECT_EQ(start("second"), (std::vector<std::size_t>{1, 0}));
    EXPECT_FALSE(player.state_of(0).playing());
    clock.advance_ms(1000.0);
    step();
    EXPECT_EQ(x(0), 1.0F);
    EXPECT_FLOAT_EQ(scene.objects[1].transform.translation.y, 1.0F);
}

TEST_F(Playing, WhoMovesSomethingByHandHasIt) {
    start();
    clock.advance_ms(1000.0);
    step();
    v1::SceneChanged hand;
    hand.mutable_move_object()->set_object(1);
    EXPECT_EQ(player.make_way(hand), std::vector<std::size_t>{0});
    scene.objects[0].transform.translation.x = -5.0F;
    clock.advance_ms(1000.0);
    const auto changes = step();
    ASSERT_EQ(changes.size(), 1U);  // the other one stops
    EXPECT_EQ(changes[0].move_object().object(), 2U);
    EXPECT_TRUE(changes[0].move_object().final());
    EXPECT_EQ(x(0), -5.0F);
    EXPECT_TRUE(player.make_way(hand).empty());
}

TEST_F(Playing, OneRunIsOneStepOfUndo) {
    start();
    clock.advance_ms(1000.0);
    EXPECT_EQ(step().back().animation().first_epoch(), 1U);
    clock.advance_ms(1000.0);
    step();
    pause();
    EXPECT_EQ(step().back().animation().first_epoch(), 1U);
    const std::uint32_t end = epoch;
    clock.advance_ms(3000.0);
    seek(0.5);
    EXPECT_EQ(step().back().animation().first_epoch(), end + 1);
    seek(0.6);  // the slider is still held
    EXPECT_EQ(step().back().animation().first_epoch(), end + 1);
    seek(0.7, 8);  // somebody else
    EXPECT_GT(step().back().animation().first_epoch(), end + 1);
    EXPECT_TRUE(player.stop_all().empty());
    player.note_undo(end);
    EXPECT_FLOAT_EQ(player.state_of(0).seconds(), 2.0F);
    player.note_undo(0);
    EXPECT_EQ(player.state_of(0).seconds(), 0.0F);
}

TEST_F(Playing, UnknownOnesAreRefusedWithTheNamesOfAll) {
    const v1::Error problem = player.problem_of(request("dance"));
    EXPECT_EQ(problem.code(), v1::Error::NOT_FOUND);
    EXPECT_EQ(problem.message(),
              "playAnimation.animation: no animation 'dance'; there are: 'both', 'second'");
    EXPECT_EQ(player.problem_of(request()).code(), v1::Error::CODE_UNSPECIFIED);
    const Scene still;
    EXPECT_NE(AnimationPlayer(still, clock).problem_of(request()).message().find("none"),
              std::string::npos);
}

TEST_F(Playing, TakesUpWhereItStood) {
    v1::AnimationStep stood;
    stood.set_animation("both");
    stood.set_seconds(2.5F);
    player.restore({stood});
    EXPECT_EQ(player.state_of(0).seconds(), 2.5F);
    EXPECT_FALSE(player.state_of(0).playing());
    v1::Scene message;
    player.describe(&message);
    ASSERT_EQ(message.animations_size(), 2);
    EXPECT_EQ(message.animations(0).seconds(), 4.0F);
    EXPECT_EQ(message.animations(1).objects(0), 2U);
}

}  // namespace
}  // namespace raybundle
