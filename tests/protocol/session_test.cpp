// SPDX-License-Identifier: Apache-2.0
#include "net/ws/session.h"

#include <gtest/gtest.h>

#include <string>

#include "same_json.h"

namespace raybundle {
namespace {

constexpr std::string_view kFirstHello = R"({"id":1,"hello":{"protocol":"1.0"}})";

class SessionTest : public testing::Test {
  protected:
    void receive(std::string_view text, double now_ms = 0.0) {
        session_.on_fragment(text, true, true, false, now_ms);
    }

    /// Next message to the viewer; empty where there is none.
    std::string sent() {
        const auto message = link_.take(0.0);
        return message
                   ? std::string(message->bytes.begin() + Outgoing::kHeadroom, message->bytes.end())
                   : std::string();
    }

    ViewerLink link_{3, 100000, {}};
    Inbox inbox_{4};
    Gate gate_{8};
    Session session_{link_, inbox_, gate_, {}, 10.0};
};

TEST_F(SessionTest, HelloJoins) {
    receive(kFirstHello);
    const auto events = inbox_.drain();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].kind, ClientEvent::Kind::joined);
    EXPECT_EQ(events[0].viewer, 3U);
    EXPECT_EQ(sent(), "");
    receive(kFirstHello);
    EXPECT_NE(sent().find("has been said already"), std::string::npos);
    session_.on_hello_timeout();
    EXPECT_FALSE(link_.closing());
}

TEST_F(SessionTest, NothingComesBeforeHello) {
    receive(R"({"id":5,"ping":{}})");
    EXPECT_PRED_FORMAT2(SameJson, sent(),
                        R"({"replyTo":5,"error":{"code":"UNAUTHENTICATED",)"
                        R"("message":"hello must come first"}})");
    EXPECT_TRUE(inbox_.drain().empty());
    session_.on_closed();
    EXPECT_TRUE(inbox_.drain().empty());
}

TEST_F(SessionTest, HelloMustComeInTime) {
    session_.on_hello_timeout();
    EXPECT_NE(sent().find("UNAUTHENTICATED"), std::string::npos);
    EXPECT_EQ(link_.close_due()->code, CloseCode::policy_violation);
}

TEST_F(SessionTest, AnotherMajorVersionIsRefusedWithBothVersions) {
    receive(R"({"id":1,"hello":{"protocol":"2.3"}})");
    const std::string answer = sent();
    EXPECT_NE(answer.find("client speaks 2.3, server speaks 1.0"), std::string::npos) << answer;
    EXPECT_EQ(link_.close_due()->code, CloseCode::protocol_error);
    receive(kFirstHello);
    EXPECT_TRUE(inbox_.drain().empty());
}

TEST_F(SessionTest, MinorVersionsAreAccepted) {
    receive(R"({"hello":{"protocol":"1.9"}})");
    EXPECT_TRUE(session_.has_joined());
}

TEST_F(SessionTest, MisspeltFieldsAreRefusedUnlessHelloAsksForLeniency) {
    const std::string light = R"({"id":2,"setLight":{"light":1,"on":true,"lumens":5}})";
    receive(kFirstHello);
    receive(light);
    EXPECT_NE(sent().find("setLight.lumens: unknown field"), std::string::npos);
    EXPECT_EQ(inbox_.drain().size(), 1U);
    for (const char* hello : {R"({"hello":{"protocol":"1.0","lenient":true,"mood":1}})",
                              R"({"hello":{"protocol":"1.99","mood":1}})"}) {
        ViewerLink link{4, 100000, {}};
        Session session{link, inbox_, gate_, {}, 10.0};
        session.on_fragment(hello, true, true, false, 0.0);
        session.on_fragment(light, true, true, false, 0.0);
        EXPECT_FALSE(link.has_output()) << hello;
        EXPECT_EQ(inbox_.drain().size(), 2U) << hello;
    }
}

TEST_F(SessionTest, AnAcknowledgementWithAnIdIsAnswered) {
    receive(kFirstHello);
    receive(R"({"ack":{"frame":1}})");
    EXPECT_EQ(sent(), "");
    receive(R"({"id":9,"ack":{"frame":1}})");
    EXPECT_PRED_FORMAT2(SameJson, sent(), R"({"replyTo":9,"ok":{}})");
}

TEST_F(SessionTest, NonsenseVersionsAreInvalid) {
    for (const char* version :
         {"1", "1.", ".1", "one", "1.0.0", "-1.0", "1.-1", " 1.0", "99999999999.0"}) {
        ViewerLink link(1, 100000, {});
        Session session(link, inbox_, gate_, {}, 10.0);
        const std::string hello = R"({"hello":{"protocol":")" + std::string(version) + "\"}}";
        session.on_fragment(hello, true, true, false, 0.0);
        EXPECT_FALSE(session.has_joined()) << version;
        EXPECT_TRUE(link.has_output()) << version;
    }
}

TEST_F(SessionTest, PutsFragmentsTogether) {
    session_.on_fragment(kFirstHello.substr(0, 10), true, false, false, 0.0);
    session_.on_fragment(kFirstHello.substr(10, 1), false, false, false, 0.0);
    EXPECT_FALSE(session_.has_joined());
    session_.on_fragment(kFirstHello.substr(11), false, true, false, 0.0);
    EXPECT_TRUE(session_.has_joined());
}

TEST_F(SessionTest, UnderstandsBinary) {
    v1::ClientMessage hello;
    hello.mutable_hello()->set_protocol("1.0");
    session_.on_fragment(hello.SerializeAsString(), true, true, true, 0.0);
    EXPECT_TRUE(session_.has_joined());
}

TEST_F(SessionTest, DoesNotCollectMoreThanTheLimit) {
    const std::string piece(40000, ' ');
    session_.on_fragment(piece, true, false, false, 0.0);
    session_.on_fragment(piece, false, false, false, 0.0);
    EXPECT_NE(sent().find("RESOURCE_EXHAUSTED"), std::string::npos);
    EXPECT_EQ(link_.close_due()->code, CloseCode::too_large);
}

TEST_F(SessionTest, AnswersPingItself) {
    receive(kFirstHello);
    inbox_.drain();
    receive(R"({"id":8,"ping":{}})");
    const std::string pong = sent();
    EXPECT_NE(pong.find(R"("pong":{"serverTimeMs":)"), std::string::npos);
    EXPECT_NE(pong.find(R"("replyTo":8)"), std::string::npos);
    EXPECT_TRUE(inbox_.drain().empty());
}

TEST_F(SessionTest, AFloodIsAnsweredAndDropped) {
    receive(kFirstHello);
    inbox_.drain();
    for (int i = 0; i < 10; ++i) {
        receive(R"({"id":2,"probe":{"pixel":{}}})");
    }
    EXPECT_EQ(inbox_.drain().size(), 4U);
    EXPECT_NE(sent().find("RESOURCE_EXHAUSTED"), std::string::npos);
    for (int i = 0; i < 1000; ++i) {
        receive(R"({"ping":{}})");
    }
    int answers = 0;
    while (!sent().empty()) {
        ++answers;
    }
    EXPECT_LT(answers, 20);
    receive(R"({"id":9,"ping":{}})", 10000.0);
    EXPECT_NE(sent().find("pong"), std::string::npos);
}

TEST_F(SessionTest, ACameraThatNewerOnesReplaceIsAnsweredHoweverLongNobodyTakesThem) {
    receive(kFirstHello);
    inbox_.drain();
    while (!sent().empty()) {
    }
    for (int id = 101; id <= 112; ++id) {
        receive(R"({"id":)" + std::to_string(id) +
                R"(,"setCamera":{"eye":{"x":1},"target":{},"up":{"y":1},"verticalFov":1}})");
    }
    int answered = 0;
    for (std::string answer = sent(); !answer.empty(); answer = sent()) {
        EXPECT_NE(answer.find(R"("ok":{})"), std::string::npos) << answer;
        ++answered;
    }
    const auto events = inbox_.drain();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].message.id(), 112U);
    EXPECT_EQ(answered + events[0].superseded.size() + 1U, 12U);
}

TEST_F(SessionTest, LeavingIsReported) {
    receive(kFirstHello);
    inbox_.drain();
    session_.on_closed();
    ASSERT_EQ(inbox_.drain().size(), 1U);
}

}  // namespace
}  // namespace raybundle
