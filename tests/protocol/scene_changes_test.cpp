// SPDX-License-Identifier: Apache-2.0
// Changes on their way to the solver: joined, in order, none lost; and the way back.
#include <gtest/gtest.h>

#include "session/changes/change_queue.h"
#include "session/changes/scene_history.h"

namespace raybundle {
namespace {

ClientEvent request(ViewerId viewer, std::uint32_t id) {
    ClientEvent event;
    event.viewer = viewer;
    event.message.set_id(id);
    return event;
}

ClientEvent move(std::uint32_t id, std::uint32_t object, float x) {
    ClientEvent event = request(1, id);
    event.message.mutable_move_object()->set_object(object);
    event.message.mutable_move_object()->mutable_transform()->mutable_translation()->set_x(x);
    return event;
}

ClientEvent light(std::uint32_t id, float intensity) {
    ClientEvent event = request(1, id);
    event.message.mutable_set_light()->set_light(1);
    event.message.mutable_set_light()->set_intensity(intensity);
    return event;
}

ClientEvent undo(std::uint32_t id, std::uint32_t epoch) {
    ClientEvent event = request(2, id);
    event.message.mutable_undo()->set_epoch(epoch);
    return event;
}

TEST(ChangeQueue, ChangesOfOneSubjectBecomeOneAndKeepTheirTurn) {
    ChangeQueue queue;
    queue.add(move(1, 2, 1.0F));
    queue.add(light(2, 100.0F));
    queue.add(move(3, 3, 5.0F));
    queue.add(move(4, 2, 2.0F));
    ClientEvent off = request(1, 5);
    off.message.mutable_set_light()->set_light(1);
    off.message.mutable_set_light()->set_on(false);
    queue.add(off);
    ASSERT_EQ(queue.size(), 3U);
    const PendingChange first = queue.take();
    EXPECT_EQ(first.change.move_object().transform().translation().x(), 2.0F);
    ASSERT_EQ(first.requests.size(), 2U);
    EXPECT_EQ(first.requests[1].message.id(), 4U);
    const PendingChange second = queue.take();
    EXPECT_EQ(second.change.set_light().intensity(), 100.0F);
    EXPECT_TRUE(second.change.set_light().has_on());
    EXPECT_FALSE(second.change.set_light().on());
    EXPECT_EQ(queue.take().change.move_object().object(), 3U);
    EXPECT_TRUE(queue.empty());
}

/// Components that are 0 count too.
TEST(ChangeQueue, ANewColourReplacesAllOfTheOld) {
    ChangeQueue queue;
    ClientEvent red = light(1, 5.0F);
    red.message.mutable_set_light()->mutable_colour()->set_x(1.0F);
    ClientEvent green = request(1, 2);
    green.message.mutable_set_light()->set_light(1);
    green.message.mutable_set_light()->mutable_colour()->set_y(1.0F);
    queue.add(red);
    queue.add(green);
    const v1::SetLight sum = queue.take().change.set_light();
    EXPECT_EQ(sum.intensity(), 5.0F);
    EXPECT_EQ(sum.colour().x(), 0.0F);
    EXPECT_EQ(sum.colour().y(), 1.0F);
}

TEST(ChangeQueue, NothingIsJoinedAcrossAnUndo) {
    ChangeQueue queue;
    queue.add(move(1, 2, 1.0F));
    queue.add(undo(2, 0));
    queue.add(move(3, 2, 2.0F));
    queue.add(move(4, 2, 3.0F));
    EXPECT_EQ(queue.take().change.move_object().transform().translation().x(), 1.0F);
    const PendingChange back = queue.take();
    ASSERT_TRUE(back.stands_for_several());
    queue.add_expanded({change_of(light(0, 7.0F))}, back);
    EXPECT_EQ(queue.front().change.by(), 2U);
    EXPECT_TRUE(queue.take().requests.empty());
    EXPECT_TRUE(queue.take().expanded);
    EXPECT_EQ(queue.take().change.move_object().transform().translation().x(), 3.0F);
}

/// Each says which part of the request it is, so that the log knows when all have been made.
TEST(ChangeQueue, WhatARequestStandsForHasItsKey) {
    ChangeQueue queue;
    ClientEvent back = undo(2, 0);
    back.message.set_request_key("k");
    queue.add(back);
    const std::vector<v1::SceneChanged> changes{change_of(light(0, 7.0F)),
                                                change_of(move(0, 2, 1.0F))};
    queue.add_expanded(changes, queue.take(), 3);
    for (const std::uint32_t part : {4U, 5U}) {
        const auto keys = keys_of(queue.take());
        ASSERT_EQ(keys.size(), 1U);
        EXPECT_EQ(keys[0].text, "k");
        EXPECT_EQ(keys[0].part, part);
        EXPECT_EQ(keys[0].parts, 5U);
    }
    EXPECT_TRUE(queue.take().expanded);
}

ClientEvent dim_group(std::uint32_t id, const std::string& name, float dim) {
    ClientEvent event = request(1, id);
    event.message.mutable_set_group()->set_group(name);
    event.message.mutable_set_group()->set_dim(dim);
    return event;
}

/// Who drags a slider fills no queue.
TEST(ChangeQueue, DimmingOfOneGroupIsJoined) {
    ChangeQueue queue;
    for (std::uint32_t id = 1; id <= 20; ++id) {
        queue.add(dim_group(id, "desks", 0.05F * static_cast<float>(id)));
    }
    queue.add(dim_group(21, "wall", 0.5F));
    queue.add(dim_group(22, "desks", 0.1F));
    ASSERT_EQ(queue.size(), 3U);
    const PendingChange first = queue.take();
    EXPECT_EQ(first.requests.size(), 20U);
    // Nothing joins what has begun.
    queue.add_expanded({change_of(light(0, 7.0F))}, first);
    queue.take();
    EXPECT_TRUE(queue.take().expanded);
    EXPECT_EQ(queue.size(), 2U);
}

/// The newer of flux and intensity counts, and of colour and its temperature.
TEST(ChangeQueue, OneWayToSayItReplacesTheOther) {
    ChangeQueue queue;
    ClientEvent flux = request(1, 2);
    flux.message.mutable_set_light()->set_light(1);
    flux.message.mutable_set_light()->set_flux(800.0F);
    flux.message.mutable_set_light()->mutable_aim()->set_z(1.0F);
    ClientEvent aim = request(1, 3);
    aim.message.mutable_set_light()->set_light(1);
    aim.message.mutable_set_light()->mutable_aim()->set_x(1.0F);
    queue.add(light(1, 5.0F));
    queue.add(flux);
    queue.add(aim);
    const v1::SetLight sum = queue.take().change.set_light();
    EXPECT_FALSE(sum.has_intensity());
    EXPECT_EQ(sum.flux(), 800.0F);
    EXPECT_EQ(sum.aim().x(), 1.0F);
    EXPECT_EQ(sum.aim().z(), 0.0F);
}

LogEntry recorded(std::uint32_t epoch) {
    LogEntry entry;
    entry.change = change_of(light(0, static_cast<float>(epoch)));
    entry.change.set_epoch(epoch);
    return entry;
}

TEST(ChangeQueue, ChangesOfOtherServersComeFirstInTheirOrder) {
    ChangeQueue queue;
    queue.add(move(1, 2, 1.0F));
    queue.add_recorded(recorded(7));
    queue.add_recorded(recorded(8));
    queue.add(light(2, 100.0F));
    queue.put_back({});  // nothing: what waits keeps its requests
    ASSERT_EQ(queue.size(), 4U);
    EXPECT_EQ(queue.take().change.epoch(), 7U);
    PendingChange again = queue.take();
    EXPECT_EQ(again.change.epoch(), 8U);
    EXPECT_EQ(again.change.set_light().intensity(), 8.0F) << "nothing joins what is in the log";
    const PendingChange moved = queue.take();
    ASSERT_EQ(moved.requests.size(), 1U);
    EXPECT_EQ(moved.requests[0].message.id(), 1U);
    queue.add_recorded(recorded(9));
    queue.put_back({moved});
    EXPECT_EQ(queue.take().change.epoch(), 9U);
    EXPECT_EQ(queue.take().requests.size(), 1U) << "what is put back comes before what waits";
    EXPECT_EQ(queue.take().requests[0].message.id(), 2U);
}

TEST(ChangeQueue, AllRequestsAreHandedOutWhenTheServerStops) {
    ChangeQueue queue;
    for (std::uint32_t id = 1; id <= 200; ++id) {
        queue.add(move(id, 1 + id % 2, 0.0F));
    }
    EXPECT_EQ(queue.take_requests().size(), 200U);
    EXPECT_TRUE(queue.empty());
}

v1::SceneChanged placed(std::uint32_t epoch, std::uint32_t object, float x) {
    v1::SceneChanged change = change_of(move(0, object, x));
    change.set_epoch(epoch);
    return change;
}

TEST(SceneHistory, GoesBackToEveryEpoch) {
    SceneHistory history;
    history.note(placed(0, 1, 0.0F), placed(1, 1, 1.0F));
    history.note(placed(0, 2, 0.0F), placed(2, 2, 5.0F));
    history.note(placed(1, 1, 1.0F), placed(3, 1, 2.0F));
    EXPECT_TRUE(history.back_to(3)->empty());
    const auto two = history.back_to(2);
    ASSERT_EQ(two->size(), 1U);
    EXPECT_EQ(two->front().move_object().transform().translation().x(), 1.0F);
    const auto zero = history.back_to(0);
    ASSERT_EQ(zero->size(), 2U);
    for (const v1::SceneChanged& change : *zero) {
        EXPECT_EQ(change.move_object().transform().translation().x(), 0.0F);
    }
    EXPECT_FALSE(history.back_to(4).has_value());
    // The undo is a change like any other, so it can be undone.
    history.note(placed(3, 1, 2.0F), placed(4, 1, 1.0F));
    const auto three = history.back_to(3);
    ASSERT_EQ(three->size(), 1U);
    EXPECT_EQ(three->front().move_object().transform().translation().x(), 2.0F);
}

TEST(SceneHistory, IsBoundedAndSaysHowFarBackItGoes) {
    SceneHistory history(10);
    EXPECT_FALSE(history.back_to(9).has_value());
    const auto changes = static_cast<std::uint32_t>(SceneHistory::max_changes + 10);
    for (std::uint32_t i = 0; i < changes; ++i) {
        const auto x = static_cast<float>(i);
        history.note(placed(10 + i, 1, x), placed(11 + i, 1, x + 1.0F));
    }
    EXPECT_GT(history.oldest(), 10U);
    EXPECT_FALSE(history.back_to(history.oldest() - 1).has_value());
    const auto oldest = history.back_to(history.oldest());
    ASSERT_EQ(oldest->size(), 1U);
    EXPECT_EQ(oldest->front().move_object().transform().translation().x(),
              static_cast<float>(history.oldest() - 10));
}

}  // namespace
}  // namespace raybundle
