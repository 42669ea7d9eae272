// SPDX-License-Identifier: Apache-2.0
#include "net/ws/inbox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <thread>

namespace raybundle {
namespace {

using std::chrono::milliseconds;

v1::ClientMessage camera(std::uint32_t id, float x) {
    v1::ClientMessage message;
    message.set_id(id);
    message.mutable_set_camera()->mutable_eye()->set_x(x);
    return message;
}

v1::ClientMessage move(std::uint32_t object, bool final, float x) {
    v1::ClientMessage message;
    message.mutable_move_object()->set_object(object);
    message.mutable_move_object()->set_final(final);
    message.mutable_move_object()->mutable_transform()->mutable_translation()->set_x(x);
    return message;
}

v1::ClientMessage probe() {
    v1::ClientMessage message;
    message.mutable_probe();
    return message;
}

TEST(Inbox, KeepsOnlyTheNewestCameraButAllIds) {
    Inbox inbox;
    for (std::uint32_t id = 1; id <= 5; ++id) {
        EXPECT_TRUE(inbox.push(7, camera(id, static_cast<float>(id))));
    }
    const auto events = inbox.drain();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].message.id(), 5U);
    EXPECT_EQ(events[0].message.set_camera().eye().x(), 5.0F);
    EXPECT_EQ(events[0].superseded, (std::vector<std::uint32_t>{1, 2, 3, 4}));
    EXPECT_TRUE(inbox.drain().empty());
}

TEST(Inbox, OtherViewersAndOtherRequestsAreBarriers) {
    Inbox inbox;
    ASSERT_TRUE(inbox.push(1, camera(1, 1)));
    ASSERT_TRUE(inbox.push(2, camera(2, 2)));
    ASSERT_TRUE(inbox.push(1, probe()));
    ASSERT_TRUE(inbox.push(1, camera(3, 3)));
    ASSERT_TRUE(inbox.push(2, camera(4, 4)));
    const auto events = inbox.drain();
    ASSERT_EQ(events.size(), 4U);
    EXPECT_EQ(events[0].message.id(), 1U);
    EXPECT_TRUE(events[1].message.has_probe());
    EXPECT_EQ(events[2].message.id(), 3U);
    EXPECT_EQ(events[3].message.id(), 4U);
    EXPECT_EQ(events[3].superseded.size(), 1U);
}

TEST(Inbox, MergesUnfinishedMovesOfOneObjectOnly) {
    Inbox inbox;
    ASSERT_TRUE(inbox.push(1, move(1, false, 1)));
    ASSERT_TRUE(inbox.push(1, move(2, false, 2)));
    ASSERT_TRUE(inbox.push(1, move(1, false, 3)));
    ASSERT_TRUE(inbox.push(1, move(1, true, 4)));
    ASSERT_TRUE(inbox.push(1, move(1, false, 5)));
    const auto events = inbox.drain();
    ASSERT_EQ(events.size(), 3U);
    EXPECT_EQ(events[0].message.move_object().object(), 2U);
    EXPECT_EQ(events[1].message.move_object().transform().translation().x(), 4.0F);
    EXPECT_EQ(events[2].message.move_object().transform().translation().x(), 5.0F);
}

TEST(Inbox, RefusesAFlood) {
    Inbox inbox(4);
    for (int i = 0; i < 4; ++i) {
        EXPECT_TRUE(inbox.push(1, probe()));
    }
    EXPECT_FALSE(inbox.push(1, probe()));
    EXPECT_TRUE(inbox.push(2, probe()));
    EXPECT_EQ(inbox.drain().size(), 5U);
    EXPECT_TRUE(inbox.push(1, probe()));
}

TEST(Inbox, ThoseWhoAreToWaitKeepTheirOrderAndHoldUpNobody) {
    Inbox inbox;
    inbox.joined(1, {});
    ASSERT_TRUE(inbox.push(1, camera(1, 1)));
    ASSERT_TRUE(inbox.push(1, probe()));
    ASSERT_TRUE(inbox.push(2, probe()));
    EXPECT_EQ(inbox.size(), 4U);
    EXPECT_EQ(inbox.take({1})->kind, ClientEvent::Kind::joined) << "no message";
    EXPECT_EQ(inbox.take({1})->viewer, 2U);
    EXPECT_FALSE(inbox.take({1}).has_value());
    EXPECT_TRUE(inbox.take({})->message.has_set_camera());
    EXPECT_TRUE(inbox.take({2})->message.has_probe());
    EXPECT_FALSE(inbox.take({}).has_value());
    ASSERT_TRUE(inbox.push(1, probe()));
    inbox.left(1);
    EXPECT_EQ(inbox.take({1})->kind, ClientEvent::Kind::left);
    EXPECT_EQ(inbox.size(), 0U);
}

// Somebody walks on while the render thread is busy for seconds: the newest camera is taken all
// the same, and every request is answered.
TEST(Inbox, BoundsTheIdsOfMergedRequestsAndRefusesNone) {
    Inbox inbox(4);
    std::vector<std::uint32_t> replaced;
    for (std::uint32_t id = 1; id <= 100; ++id) {
        v1::ClientMessage message = id % 2 == 1 ? camera(id, 0) : move(1, false, 0);
        message.set_id(id);
        const auto pushed = inbox.push(1, std::move(message));
        ASSERT_TRUE(pushed) << id;
        if (pushed.replaced) {
            replaced.push_back(*pushed.replaced);
        }
    }
    auto answered = replaced;
    for (const ClientEvent& event : inbox.drain()) {
        EXPECT_LE(event.superseded.size(), 4U);
        answered.insert(answered.end(), event.superseded.begin(), event.superseded.end());
        answered.push_back(event.message.id());
        EXPECT_GT(event.message.id(), 98U);
    }
    std::sort(answered.begin(), answered.end());
    std::vector<std::uint32_t> all(100);
    std::iota(all.begin(), all.end(), 1U);
    EXPECT_EQ(answered, all);
}

TEST(Inbox, ForgetsAViewerThatLeavesUnheard) {
    Inbox inbox;
    inbox.joined(1, {});
    ASSERT_TRUE(inbox.push(1, probe()));
    inbox.left(1);
    EXPECT_TRUE(inbox.drain().empty());
    inbox.joined(2, {});
    inbox.drain();
    ASSERT_TRUE(inbox.push(2, probe()));
    inbox.left(2);
    const auto events = inbox.drain();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].kind, ClientEvent::Kind::left);
}

TEST(Inbox, WaitEndsByEventByInterruptAndByTime) {
    Inbox inbox;
    EXPECT_FALSE(inbox.wait_for(milliseconds(1)));
    inbox.interrupt();
    EXPECT_FALSE(inbox.wait_for(std::chrono::hours(1)));
    std::thread writer([&inbox] { EXPECT_TRUE(inbox.push(1, probe())); });
    EXPECT_TRUE(inbox.wait_for(std::chrono::hours(1)));
    writer.join();
}

TEST(Inbox, CallersHaveOneShareTogetherAndWaitOutside) {
    Inbox inbox;
    v1::ClientMessage hello;
    hello.mutable_hello();
    v1::ClientMessage message;
    message.mutable_list_changes();
    inbox.joined(7, hello, v1::EDITOR, true);
    ASSERT_TRUE(inbox.push(7, message, v1::EDITOR, true));
    inbox.joined(8, hello);
    ASSERT_TRUE(inbox.push(8, message));
    const std::set<ViewerId> callers_wait{0};
    EXPECT_EQ(inbox.take(callers_wait)->viewer, 8U);
    EXPECT_EQ(inbox.take(callers_wait)->viewer, 8U);
    EXPECT_FALSE(inbox.take(callers_wait));
    EXPECT_EQ(inbox.take({7})->kind, ClientEvent::Kind::joined);
    EXPECT_EQ(inbox.take({7})->kind, ClientEvent::Kind::message);
}

}  // namespace
}  // namespace raybundle
