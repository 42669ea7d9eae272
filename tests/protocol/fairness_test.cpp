// SPDX-License-Identifier: Apache-2.0
// One viewer cannot take what belongs to all: the network thread, places for snapshots, names.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "net/access/peer_name.h"
#include "net/access/wrong_tokens.h"
#include "net/server.h"
#include "net/ws/receive_slice.h"
#include "net/ws/session.h"
#include "raw_client.h"
#include "session/snapshots/snapshot_quota.h"

namespace raybundle {
namespace {

TEST(ReceiveSlice, BoundsTheWorkForOneViewer) {
    ReceiveSlice slice;
    std::size_t messages = 0;
    while (slice.take(1, true)) {
        ++messages;
    }
    EXPECT_LE(messages, ReceiveSlice::max_cost / ReceiveSlice::cost_of_message);
    EXPECT_TRUE(slice.spent());
    slice.renew();
    EXPECT_FALSE(slice.spent());
    EXPECT_FALSE(slice.take(65536, false)) << "one that is large is the last one";
}

/// Many slices' worth at once: nothing is lost, and all is answered in order.
TEST(ReceiveSlice, AFloodIsAnsweredWhole) {
    ServerSettings settings;
    settings.port = 0;
    Server server(settings);
    server.start();
    RawClient flooding(server.port());
    flooding.upgrade();
    flooding.send_text(R"({"hello":{"protocol":"1.0"}})");
    constexpr int kPings = 1500;  // below what a viewer may send at once
    for (int i = 1; i <= kPings; ++i) {
        flooding.send_text("{\"id\":" + std::to_string(i) + ",\"ping\":{}}");
    }
    for (int i = 1; i <= kPings; ++i) {
        const auto answer = flooding.read_message();
        ASSERT_TRUE(answer) << i;
        ASSERT_TRUE(has(answer->payload, "\"replyTo\":" + std::to_string(i) + "}"))
            << answer->payload;
    }
}

TEST(SnapshotQuota, AViewerCannotFillAllPlaces) {
    std::vector<WaitingSnapshot> waiting;
    const auto ask = [&](ViewerId viewer, v1::Role role) {
        const WaitingSnapshot next{viewer, role};
        if (refuse_snapshot(waiting, next)) {
            return false;
        }
        waiting.insert(
            waiting.begin() + static_cast<std::ptrdiff_t>(place_of_snapshot(waiting, next)), next);
        return true;
    };
    int taken = 0;
    for (int i = 0; i < 20; ++i) {
        taken += ask(1, v1::VIEWER) ? 1 : 0;
    }
    EXPECT_EQ(taken, 2);
    for (ViewerId viewer = 2; viewer < 20; ++viewer) {
        ask(viewer, v1::VIEWER);
    }
    EXPECT_EQ(waiting.size(), max_snapshots_of_viewers) << "of all who only look";
    EXPECT_TRUE(ask(50, v1::EDITOR));
    EXPECT_TRUE(ask(51, v1::REVIEWER));
    EXPECT_TRUE(ask(50, v1::EDITOR));
    EXPECT_TRUE(ask(50, v1::EDITOR));
    EXPECT_FALSE(ask(52, v1::EDITOR)) << "all places are taken";
    EXPECT_NE(refuse_snapshot(waiting, {52, v1::EDITOR})->find("8 waiting"), std::string::npos);
}

TEST(SnapshotQuota, EverybodysFirstComesBeforeAnybodysSecond) {
    const std::vector<WaitingSnapshot> waiting{
        {1, v1::EDITOR}, {1, v1::EDITOR}, {1, v1::EDITOR}, {2, v1::VIEWER}};
    EXPECT_EQ(place_of_snapshot({}, {1, v1::EDITOR}), 0U);
    EXPECT_EQ(place_of_snapshot(waiting, {3, v1::VIEWER}), 1U) << "behind what is being made";
    EXPECT_EQ(place_of_snapshot(waiting, {2, v1::VIEWER}), 2U);
    EXPECT_EQ(place_of_snapshot(waiting, {1, v1::EDITOR}), 4U);
}

TEST(WrongTokens, AnswersWaitTheLongerTheMoreThereWere) {
    WrongTokens tokens;
    for (std::uint64_t i = 0; i < WrongTokens::free_tries; ++i) {
        EXPECT_EQ(tokens.note("a", 0.0).delay_ms, 0.0);
    }
    EXPECT_EQ(tokens.note("a", 0.0).delay_ms, 250.0);
    EXPECT_EQ(tokens.note("a", 0.0).delay_ms, 500.0);
    EXPECT_EQ(tokens.note("b", 0.0).delay_ms, 0.0) << "another peer";
    int lines = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto answer = tokens.note("a", 1.0);
        EXPECT_LE(answer.delay_ms, WrongTokens::last_delay_ms);
        lines += answer.worth_a_line ? 1 : 0;
    }
    EXPECT_LE(lines, 10) << "the log is not flooded";
    EXPECT_EQ(tokens.total(), 1006U);
    EXPECT_EQ(tokens.note("a", 1.0 + 2.0 * WrongTokens::forgotten_ms).delay_ms, 0.0);
}

TEST(WrongTokens, RemembersABoundedNumberOfPeers) {
    WrongTokens tokens;
    tokens.note("first", 0.0);
    for (std::size_t i = 0; i < 2 * WrongTokens::max_peers; ++i) {
        tokens.note(std::to_string(i), 1.0);
    }
    EXPECT_EQ(tokens.note("first", 2.0).of_this_peer, 1U) << "forgotten for newer ones";
}

TEST(WrongTokens, TheAnswerIsHeldBackAndNothingIsReadMeanwhile) {
    ViewerLink link{3, 100000, {}};
    Inbox inbox{4};
    Gate gate{8, Access{AccessTokens({{"lead", v1::EDITOR, token_digest("right")}}), {}}};
    for (std::uint64_t i = 0; i < WrongTokens::free_tries; ++i) {
        gate.note_wrong_token("192.0.2.7", "hello", 0.0);
    }
    Session session(link, inbox, gate, {}, 10.0, "192.0.2.7");
    const auto hello = [&](const char* token) {
        session.on_fragment(std::string(R"({"hello":{"protocol":"1.0","token":")") + token + "\"}}",
                            true, true, false, 0.0);
    };
    hello("wrong");
    EXPECT_FALSE(link.has_output());
    ASSERT_TRUE(session.held_until());
    EXPECT_EQ(*session.held_until(), 250.0);
    hello("right");
    EXPECT_FALSE(session.has_joined()) << "not before the answer";
    session.release_held();
    EXPECT_TRUE(link.has_output());
    hello("right");
    EXPECT_TRUE(session.has_joined());
    EXPECT_EQ(gate.wrong_tokens(), WrongTokens::free_tries + 1);
}

TEST(Names, OfATokenBelongToThatTokenAlone) {
    Gate gate{8, Access{AccessTokens({{"Lead Designer", v1::EDITOR, token_digest("e")},
                                      {"guest", v1::VIEWER, token_digest("v")}}),
                        {}}};
    const auto enter = [&](const char* token, const char* name) {
        v1::Hello hello;
        hello.set_token(token);
        hello.set_name(name);
        const auto answer = gate.enter(hello);
        const auto* denial = std::get_if<Denial>(&answer);
        return denial == nullptr ? v1::Error::CODE_UNSPECIFIED : denial->refusal.code;
    };
    EXPECT_EQ(enter("v", "Lead Designer"), v1::Error::PERMISSION_DENIED);
    EXPECT_EQ(enter("v", " lead designer "), v1::Error::PERMISSION_DENIED);
    EXPECT_EQ(enter("e", "lead designer"), v1::Error::CODE_UNSPECIFIED);
    EXPECT_EQ(enter("e", "anybody"), v1::Error::CODE_UNSPECIFIED);
    EXPECT_EQ(enter("v", "guest"), v1::Error::CODE_UNSPECIFIED);
    EXPECT_EQ(enter("v", ""), v1::Error::CODE_UNSPECIFIED);
}

TEST(PeerName, BelievesTrustedProxiesOnly) {
    const std::vector<std::string> proxies{"127.0.0.1", "192.0.2.1"};
    EXPECT_EQ(peer_name("198.51.100.4", "203.0.113.9", proxies), "198.51.100.4");
    EXPECT_EQ(peer_name("127.0.0.1", "203.0.113.9", proxies), "203.0.113.9");
    EXPECT_EQ(peer_name("127.0.0.1", "10.9.9.9, 203.0.113.9,192.0.2.1", proxies), "203.0.113.9");
    EXPECT_EQ(peer_name("127.0.0.1", "2001:db8::7", proxies), "2001:db8::7");
    EXPECT_EQ(peer_name("127.0.0.1", "nonsense", proxies), "127.0.0.1");
    EXPECT_EQ(peer_name("127.0.0.1", "", proxies), "127.0.0.1");
    EXPECT_EQ(peer_name("127.0.0.1", "203.0.113.9", {}), "127.0.0.1");
}

}  // namespace
}  // namespace raybundle
