// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "net/access/gate.h"
#include "net/ws/rules/message_rules.h"
#include "net/ws/session.h"

namespace raybundle {
namespace {

const std::string kEditor(64, 'e');
const std::string kReviewer(64, 'r');
const std::string kViewer(64, 'v');

Access three_tokens() {
    return {AccessTokens({{"lead", v1::EDITOR, token_digest(kEditor)},
                          {"client", v1::REVIEWER, token_digest(kReviewer)},
                          {"screen", v1::VIEWER, token_digest(kViewer)}}),
            {}};
}

v1::Hello hello_with(const std::string& token) {
    v1::Hello hello;
    hello.set_token(token);
    return hello;
}

TEST(AccessTokens, DigestIsSha256) {
    // FIPS 180-4, example "abc".
    EXPECT_EQ(to_hex(token_digest("abc")),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(parse_digest(to_hex(token_digest("abc"))), token_digest("abc"));
    EXPECT_FALSE(parse_digest("ba78"));
    EXPECT_FALSE(parse_digest(std::string(63, '0') + "g"));
}

TEST(AccessTokens, RandomTokensAre256BitsAndDiffer) {
    const std::string token = random_token();
    EXPECT_EQ(token.size(), 64U);
    EXPECT_TRUE(parse_digest(token).has_value());
    EXPECT_NE(token, random_token());
}

TEST(AccessTokens, WithoutTokensEverybodyMayDoEverything) {
    EXPECT_EQ(AccessTokens().role_of(token_digest("anything")), v1::EDITOR);
}

TEST(AccessTokens, EachTokenGivesItsRoleAndNoOtherTokenAny) {
    const Access access = three_tokens();
    EXPECT_EQ(access.tokens.role_of(token_digest(kEditor)), v1::EDITOR);
    EXPECT_EQ(access.tokens.role_of(token_digest(kReviewer)), v1::REVIEWER);
    EXPECT_EQ(access.tokens.role_of(token_digest(kViewer)), v1::VIEWER);
    EXPECT_FALSE(access.tokens.role_of(token_digest("")));
    EXPECT_FALSE(access.tokens.role_of(token_digest(std::string(63, 'e') + "f")));
}

TEST(RequiredRole, ReviewersLeaveNotesAndViewersLookAndMeasure) {
    using Body = v1::ClientMessage::BodyCase;
    for (const Body body : {Body::kAddPin, Body::kRemovePin, Body::kSaveViewpoint,
                            Body::kRemoveViewpoint, Body::kPointAt}) {
        EXPECT_EQ(required_role(body), v1::REVIEWER) << body;
    }
    for (const Body body : {Body::kFollow, Body::kProbe, Body::kProbeGrid, Body::kSetDisplay}) {
        EXPECT_EQ(required_role(body), v1::VIEWER) << body;
    }
    EXPECT_EQ(required_role(Body::kMeasureEffects), v1::EDITOR) << "it slows everybody down";
}

TEST(Gate, CountsWhoIsThere) {
    Gate gate(1, three_tokens());
    ASSERT_TRUE(std::holds_alternative<Pass>(gate.enter(hello_with(kViewer))));
    const auto full = gate.enter(hello_with(kEditor));
    ASSERT_TRUE(std::holds_alternative<Denial>(full));
    EXPECT_EQ(std::get<Denial>(full).close, CloseCode::try_again_later);
    gate.leave();
    EXPECT_TRUE(std::holds_alternative<Pass>(gate.enter(hello_with(kEditor))));
    EXPECT_EQ(gate.present(), 1U);
}

TEST(Gate, AWrongTokenTakesNoPlace) {
    Gate gate(1, three_tokens());
    for (const char* token : {"", "wrong"}) {
        const auto answer = gate.enter(hello_with(token));
        ASSERT_TRUE(std::holds_alternative<Denial>(answer));
        EXPECT_EQ(std::get<Denial>(answer).refusal.code, v1::Error::UNAUTHENTICATED);
    }
    EXPECT_EQ(gate.present(), 0U);
}

TEST(Gate, MetricsWantABearerTokenWhereThereAreTokens) {
    Gate gate(1);
    EXPECT_TRUE(gate.opens_metrics(""));
    gate.set_access(three_tokens());
    EXPECT_FALSE(gate.opens_metrics(""));
    EXPECT_FALSE(gate.opens_metrics("Bearer wrong"));
    EXPECT_FALSE(gate.opens_metrics(kViewer));
    EXPECT_TRUE(gate.opens_metrics("Bearer " + kViewer));
}

/// One viewer with a token in front of a gate with three.
class RoleTest : public testing::Test {
  protected:
    void join(const std::string& token) {
        receive(R"({"id":1,"hello":{"protocol":"1.0","token":")" + token + R"("}})");
    }
    void receive(std::string_view text) { session_.on_fragment(text, true, true, false, 0.0); }

    std::string sent() {
        const auto message = link_.take(0.0);
        return message
                   ? std::string(message->bytes.begin() + Outgoing::kHeadroom, message->bytes.end())
                   : std::string();
    }

    /// What the server says to a message; empty where it has gone to the render thread.
    std::string answer(std::string_view text) {
        receive(text);
        return sent();
    }

    ViewerLink link_{3, 100000, {}};
    Inbox inbox_{16};
    Gate gate_{8, three_tokens()};
    Session session_{link_, inbox_, gate_, {}, 1000.0};
};

constexpr std::string_view kMove =
    R"({"id":2,"moveObject":{"object":1,"transform":{"translation":{"x":1,"y":0,"z":0}}}})";
constexpr std::string_view kLight = R"({"id":3,"setLight":{"light":1,"on":false}})";
constexpr std::string_view kMaterial = R"({"id":4,"setMaterial":{"material":1,"roughness":1}})";
constexpr std::string_view kPin =
    R"({"id":5,"addPin":{"text":"a","position":{"x":0,"y":0,"z":0}}})";
constexpr std::string_view kProbe = R"({"id":6,"probe":{"pixel":{"x":1,"y":1}}})";
constexpr std::string_view kDenied = "PERMISSION_DENIED";

TEST_F(RoleTest, AViewerLooksAndProbes) {
    join(kViewer);
    for (const std::string_view message : {kMove, kLight, kMaterial, kPin}) {
        EXPECT_NE(answer(message).find(kDenied), std::string::npos) << message;
    }
    EXPECT_EQ(answer(kProbe), "");
    EXPECT_EQ(inbox_.drain().size(), 2U);  // hello and probe
}

TEST_F(RoleTest, AReviewerAlsoPins) {
    join(kReviewer);
    for (const std::string_view message : {kMove, kLight, kMaterial}) {
        EXPECT_NE(answer(message).find(kDenied), std::string::npos) << message;
    }
    EXPECT_EQ(answer(kPin), "");
}

TEST_F(RoleTest, AnEditorAlsoChangesTheScene) {
    join(kEditor);
    for (const std::string_view message : {kMove, kLight, kMaterial, kPin, kProbe}) {
        EXPECT_EQ(answer(message), "") << message;
    }
    const auto events = inbox_.drain();
    ASSERT_EQ(events.size(), 6U);
    EXPECT_EQ(events[0].role, v1::EDITOR);
    EXPECT_EQ(events[0].message.hello().token(), "") << "the token goes no further than the gate";
}

TEST_F(RoleTest, TheRefusalNamesMessageAndRoleAndIsAnAnswer) {
    join(kViewer);
    const std::string text = answer(kMove);
    EXPECT_NE(text.find("\"replyTo\":2"), std::string::npos) << text;
    EXPECT_NE(text.find("moveObject: needs the role EDITOR, this viewer has VIEWER"),
              std::string::npos)
        << text;
}

TEST_F(RoleTest, AWrongTokenMayBeCorrectedTwice) {
    join("wrong");
    EXPECT_NE(sent().find("UNAUTHENTICATED"), std::string::npos);
    EXPECT_FALSE(link_.closing());
    join("wrong again");
    EXPECT_FALSE(link_.closing());
    join(kViewer);
    EXPECT_TRUE(session_.has_joined());
}

TEST_F(RoleTest, TheThirdWrongTokenCloses) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_FALSE(link_.closing());
        join("wrong");
    }
    EXPECT_TRUE(link_.closing());
    EXPECT_TRUE(inbox_.drain().empty());
}

TEST_F(RoleTest, AWithdrawnTokenClosesAKeptOneStays) {
    join(kViewer);
    gate_.set_access(three_tokens());
    session_.check_pass();
    EXPECT_FALSE(link_.closing());
    gate_.set_access({AccessTokens({{"screen", v1::EDITOR, token_digest(kViewer)}}), {}});
    session_.check_pass();
    EXPECT_TRUE(link_.closing()) << "the token has another role now";
}

TEST_F(RoleTest, LeavingGivesThePlaceBack) {
    join(kViewer);
    EXPECT_EQ(gate_.present(), 1U);
    session_.on_closed();
    EXPECT_EQ(gate_.present(), 0U);
}

}  // namespace
}  // namespace raybundle
