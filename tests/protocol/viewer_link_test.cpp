// SPDX-License-Identifier: Apache-2.0
#include "net/ws/viewer_link.h"

#include <gtest/gtest.h>

#include "same_json.h"

namespace raybundle {
namespace {

constexpr FrameDemand kLinkDemand{true, false, 640.0 * 360.0};

v1::ServerMessage ok(std::uint32_t id) {
    v1::ServerMessage message;
    message.set_reply_to(id);
    message.mutable_ok();
    return message;
}

v1::FrameHeader frame(std::uint32_t number) {
    v1::FrameHeader header;
    header.set_frame(number);
    header.set_width(640);
    header.set_height(360);
    header.set_quality(80);
    return header;
}

std::string payload(const Outgoing& message) {
    return {message.bytes.begin() + Outgoing::kHeadroom, message.bytes.end()};
}

TEST(ViewerLink, MessagesGoBeforeTheFrameInOrder) {
    ViewerLink link(1, 1000, {});
    link.send_frame(frame(1), {1, 2, 3});
    link.send(ok(1));
    link.send(ok(2));
    EXPECT_PRED_FORMAT2(SameJson, payload(*link.take(0)), R"({"replyTo":1,"ok":{}})");
    EXPECT_PRED_FORMAT2(SameJson, payload(*link.take(0)), R"({"replyTo":2,"ok":{}})");
    EXPECT_EQ(link.take(0)->kind, Outgoing::Kind::ping);
    EXPECT_EQ(link.take(0)->kind, Outgoing::Kind::frame);
    EXPECT_FALSE(link.take(0).has_value());
    EXPECT_FALSE(link.has_output());
}

TEST(ViewerLink, TheNewestFrameWins) {
    ViewerLink link(1, 1000, {});
    EXPECT_FALSE(link.send_frame(frame(1), {1}));
    EXPECT_TRUE(link.send_frame(frame(2), {2}));
    EXPECT_EQ(link.take(0)->kind, Outgoing::Kind::ping);
    const std::string bytes = payload(*link.take(0));
    EXPECT_NE(bytes.find("\"frame\":2"), std::string::npos);
    EXPECT_FALSE(link.take(0).has_value());
}

TEST(ViewerLink, ASilentViewerGetsOneFrame) {
    ViewerLink link(1, 1000, {});
    EXPECT_TRUE(link.advise(kLinkDemand, 0).send);
    link.send_frame(frame(1), {1});
    EXPECT_FALSE(link.advise(kLinkDemand, 1).send);  // it still waits
    link.take(2);                                    // ping
    link.take(2);
    EXPECT_FALSE(link.advise(kLinkDemand, 1e6).send);  // it has not been acknowledged
    v1::Ack ack;
    ack.set_frame(1);
    link.on_ack(ack, 1e6);
    EXPECT_TRUE(link.advise(kLinkDemand, 1e6).send);
}

TEST(ViewerLink, APingAfterTheWelcomeTellsWhetherAnybodyIsThere) {
    ViewerLink link(1, 1000, {});
    v1::ServerMessage welcome;
    welcome.mutable_welcome();
    link.send(welcome);
    link.send_frame(frame(1), {1});
    EXPECT_EQ(link.take(0)->kind, Outgoing::Kind::text);
    ASSERT_TRUE(link.has_output());
    const Outgoing greeting = *link.take(0);
    EXPECT_EQ(greeting.kind, Outgoing::Kind::ping);
    EXPECT_EQ(link.take(0)->kind, Outgoing::Kind::ping) << "the one that measures";
    EXPECT_EQ(link.take(0)->kind, Outgoing::Kind::frame);
    EXPECT_FALSE(link.has_output());
    EXPECT_FALSE(link.answers());
    link.on_pong("unasked", 1);
    EXPECT_FALSE(link.answers());
    link.on_pong(payload(greeting), 1);
    EXPECT_TRUE(link.answers());
}

TEST(ViewerLink, OverflowClosesInsteadOfGrowing) {
    ViewerLink link(1, 100, {});
    for (std::uint32_t i = 0; i < 100; ++i) {
        link.send(ok(i));
    }
    EXPECT_TRUE(link.closing());
    EXPECT_FALSE(link.take(0).has_value());
    EXPECT_EQ(link.close_due()->code, CloseCode::policy_violation);
    EXPECT_FALSE(link.advise(kLinkDemand, 0).send);
}

TEST(ViewerLink, ClosesAfterWhatWaitsIsWritten) {
    ViewerLink link(1, 1000, {});
    link.send(ok(1));
    link.close(CloseCode::protocol_error, "first");
    link.close(CloseCode::going_away, "second");
    link.send(ok(2));
    EXPECT_FALSE(link.close_due().has_value());
    EXPECT_TRUE(link.take(0).has_value());
    EXPECT_FALSE(link.take(0).has_value());
    EXPECT_EQ(link.close_due()->reason, "first");
}

TEST(ViewerLink, BroadcastsReachOnlyTheWelcomed) {
    ViewerLink link(1, 1000, {});
    link.send_if_welcomed("{}");
    EXPECT_FALSE(link.has_output());
    v1::ServerMessage message;
    message.mutable_welcome();
    link.send(message);
    link.take(0);
    link.send_if_welcomed("{}");
    EXPECT_EQ(payload(*link.take(0)), "{}");
}

/// Acknowledgements alone do not make room: a client may send them and read nothing.
TEST(ViewerLink, LightThatNobodyReadsIsBounded) {
    constexpr std::size_t most_bytes = 1000;
    ViewerLink link(1, most_bytes, {});
    std::size_t sent = 0;
    while (link.has_room_for_light()) {
        ASSERT_LE(++sent, most_bytes / 100) << "by bytes";
        link.send_light({}, std::string(100, 'x'));
        link.on_light_ack(static_cast<std::uint32_t>(sent));
    }
    while (link.has_output()) {
        link.take(0);
    }
    EXPECT_TRUE(link.has_room_for_light()) << "it has read all";
    ViewerLink small(1, std::size_t{1} << 30U, {});
    for (sent = 0; small.has_room_for_light(); ++sent) {
        ASSERT_LT(sent, ViewerLink::max_light_messages) << "by number";
        small.send_light({}, {});
    }
}

}  // namespace
}  // namespace raybundle
