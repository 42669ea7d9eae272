// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "net/server.h"
#include "raw_client.h"
#include "same_json.h"

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::string_view kHello =
    R"({"id":1,"hello":{"protocol":"1.0","name":"test","viewport":{"width":64,"height":48}}})";
constexpr FrameDemand kDemand{true, false, 64.0 * 48.0};

class ServerWebSocketTest : public testing::Test {
  protected:
    void start(ServerSettings settings = {}) {
        settings.port = 0;
        server_ = std::make_unique<Server>(settings);
        server_->start();
    }

    [[nodiscard]] std::uint16_t port() const { return server_->port(); }

    /// Waits for one event of the kind and takes everything up to it.
    ClientEvent wait_for(ClientEvent::Kind kind) {
        const auto end = Clock::now() + std::chrono::seconds(120);
        while (Clock::now() < end) {
            server_->inbox().wait_for(milliseconds(50));
            for (auto& event : server_->inbox().drain()) {
                if (event.kind == kind) {
                    return event;
                }
            }
        }
        ADD_FAILURE() << "no event";
        return {};
    }

    /// Handshake, hello and welcome.
    ViewerId join(RawClient& client) {
        EXPECT_TRUE(client.upgrade().starts_with("HTTP/1.1 101"));
        client.send_text(kHello);
        const ClientEvent joined = wait_for(ClientEvent::Kind::joined);
        v1::ServerMessage welcome;
        welcome.mutable_welcome()->set_viewer(joined.viewer);
        server_->reply(joined, welcome);
        const auto answer = client.read_message();
        EXPECT_TRUE(answer && has(answer->payload, R"("welcome":{)"));
        return joined.viewer;
    }

    void send_frame(ViewerId viewer, std::uint32_t number, std::size_t bytes) {
        v1::FrameHeader header;
        header.set_frame(number);
        header.set_width(64);
        header.set_height(48);
        header.set_quality(80);
        server_->send_frame(viewer, header, std::vector<std::uint8_t>(bytes, 7));
    }

    std::unique_ptr<Server> server_;
};

TEST_F(ServerWebSocketTest, HandshakeNamesTheSubprotocol) {
    start();
    RawClient client(port());
    const std::string head = client.upgrade();
    EXPECT_TRUE(has(head, "101")) << head;
    EXPECT_TRUE(has(head, "raybundle.v1")) << head;
    RawClient plain(port());
    EXPECT_TRUE(plain.upgrade("/ws", "").starts_with("HTTP/1.1 101"));
}

TEST_F(ServerWebSocketTest, RefusesOtherPathsSubprotocolsAndOrigins) {
    start();
    EXPECT_TRUE(has(RawClient(port()).upgrade("/other"), " 404 "));
    EXPECT_FALSE(has(RawClient(port()).upgrade("/ws", "Sec-WebSocket-Protocol: chat\r\n"), "101"));
    constexpr std::string_view kForeign =
        "Origin: http://evil.example\r\nSec-WebSocket-Protocol: raybundle.v1\r\n";
    EXPECT_TRUE(has(RawClient(port()).upgrade("/ws", kForeign), " 403 "));
}

TEST_F(ServerWebSocketTest, HelloIsAnsweredAndPingToo) {
    start();
    RawClient client(port());
    join(client);
    client.send_text(R"({"id":8,"ping":{}})");
    EXPECT_TRUE(has(client.read_message()->payload, R"("pong":{)"));
    client.send_frame(9, "control");
    const auto pong = client.read_frame();
    EXPECT_EQ(pong->opcode, 10);
    EXPECT_EQ(pong->payload, "control");
}

TEST_F(ServerWebSocketTest, FragmentsWithControlFramesBetween) {
    start();
    RawClient client(port());
    join(client);
    client.send_frame(1, R"({"id":5,"setView)", false);
    client.send_frame(9, "x");
    client.send_frame(0, R"(port":{"width":1280,)", false);
    client.send_frame(0, R"("height":720}})", true);
    const ClientEvent event = wait_for(ClientEvent::Kind::message);
    EXPECT_EQ(event.message.set_viewport().width(), 1280U);
    v1::ServerMessage ok;
    ok.mutable_ok();
    server_->reply(event, ok);
    EXPECT_PRED_FORMAT2(SameJson, client.read_message()->payload, R"({"replyTo":5,"ok":{}})");
}

TEST_F(ServerWebSocketTest, OtherMajorVersionIsToldAndClosed) {
    start();
    RawClient client(port());
    client.upgrade();
    client.send_text(R"({"id":1,"hello":{"protocol":"3.1"}})");
    EXPECT_TRUE(has(client.read_message()->payload, "client speaks 3.1, server speaks 1.0"));
    EXPECT_EQ(client.read_message()->close_code(), 1002);
    EXPECT_TRUE(client.closed());
}

TEST_F(ServerWebSocketTest, OversizedMessagesAreToldAndClosed) {
    start();
    RawClient client(port());
    join(client);
    client.send_text(std::string(70000, ' '));
    EXPECT_TRUE(has(client.read_message()->payload, "RESOURCE_EXHAUSTED"));
    EXPECT_EQ(client.read_message()->close_code(), 1009);
    wait_for(ClientEvent::Kind::left);
}

TEST_F(ServerWebSocketTest, HelloMustComeInTime) {
    ServerSettings settings;
    settings.hello_timeout_s = 0.1;
    start(settings);
    RawClient client(port());
    client.upgrade();
    EXPECT_TRUE(has(client.read_message()->payload, "UNAUTHENTICATED"));
    EXPECT_EQ(client.read_message()->close_code(), 1008);
}

TEST_F(ServerWebSocketTest, InvalidUtf8ClosesTheConnection) {
    start();
    RawClient client(port());
    join(client);
    client.send_text("{\"a\":\"\xc3\x28\"}");
    EXPECT_EQ(client.read_message()->close_code(), 1007);
    client.reset();
    wait_for(ClientEvent::Kind::left);
}

TEST_F(ServerWebSocketTest, TheServerIsFull) {
    ServerSettings settings;
    settings.max_viewers = 1;
    start(settings);
    RawClient first(port());
    join(first);
    RawClient second(port());
    second.upgrade();
    second.send_text(kHello);
    EXPECT_TRUE(has(second.read_message()->payload, "the server is full, it takes 1 viewer\""));
    EXPECT_EQ(second.read_message()->close_code(), 1013);
}

TEST_F(ServerWebSocketTest, LargeFramesArriveWhole) {
    start();
    RawClient client(port());
    const ViewerId viewer = join(client);
    ASSERT_TRUE(server_->advise(viewer, kDemand).send);
    send_frame(viewer, 1, 1000000);
    const auto frame = client.read_message();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->opcode, 2);
    const auto& bytes = frame->payload;
    const std::size_t header_size =
        static_cast<unsigned char>(bytes[0]) + 256U * static_cast<unsigned char>(bytes[1]);
    EXPECT_EQ(bytes.size(), 4 + header_size + 1000000);
    EXPECT_TRUE(bytes.substr(4, header_size).starts_with(R"({"frame":1,)"));
    EXPECT_EQ(bytes.substr(4 + header_size), std::string(1000000, 7));
    EXPECT_FALSE(server_->advise(viewer, kDemand).send);
    client.send_text(R"({"ack":{"frame":1,"decodeMs":1}})");
    client.send_text(R"({"id":2,"ping":{}})");
    client.read_message();
    EXPECT_TRUE(server_->advise(viewer, kDemand).send);
}

TEST_F(ServerWebSocketTest, ASlowReaderCostsOneFrameAndNobodyElsesTime) {
    start();
    RawClient slow(port(), 4096);
    const ViewerId slow_viewer = join(slow);
    RawClient good(port());
    const ViewerId good_viewer = join(good);
    for (std::uint32_t frame = 1; frame <= 50; ++frame) {
        send_frame(slow_viewer, frame, 4000000);
        send_frame(good_viewer, frame, 1000);
        const auto received = good.read_message();
        ASSERT_TRUE(received.has_value());
        good.send_text(R"({"ack":{"frame":)" + std::to_string(frame) + R"(,"decodeMs":0}})");
    }
    // What had begun to be written comes whole, then at once the newest.
    const auto first = slow.read_message();
    ASSERT_TRUE(first.has_value());
    EXPECT_FALSE(has(first->payload.substr(0, 300), "\"frame\":50,"));
    const auto second = slow.read_message();
    ASSERT_TRUE(second.has_value());
    EXPECT_TRUE(has(second->payload.substr(0, 300), "\"frame\":50,"));
}

TEST_F(ServerWebSocketTest, AReaderThatLetsMessagesPileUpIsDisconnected) {
    ServerSettings settings;
    settings.max_queued_bytes = 200000;
    start(settings);
    RawClient slow(port(), 4096);
    const ViewerId viewer = join(slow);
    v1::ServerMessage message;
    message.mutable_error()->set_message(std::string(50000, 'x'));
    for (int i = 0; i < 1000; ++i) {
        server_->send(viewer, message);
    }
    wait_for(ClientEvent::Kind::left);
}

TEST_F(ServerWebSocketTest, AbruptEndInTheMiddleOfAFrame) {
    start();
    for (int i = 0; i < 10; ++i) {
        RawClient client(port(), 4096);
        const ViewerId viewer = join(client);
        send_frame(viewer, 1, 4000000);
        client.read_until("frame");
        client.reset();
        EXPECT_EQ(wait_for(ClientEvent::Kind::left).viewer, viewer);
        send_frame(viewer, 2, 1000);  // nobody is there: nothing happens
        EXPECT_FALSE(server_->advise(viewer, kDemand).send);
    }
}

TEST_F(ServerWebSocketTest, BroadcastReachesEverybodyElse) {
    start();
    RawClient a(port());
    RawClient b(port());
    RawClient silent(port());
    const ViewerId from = join(a);
    join(b);
    silent.upgrade();
    v1::ServerMessage change;
    change.mutable_scene_changed()->set_epoch(1);
    server_->broadcast(change, from);
    EXPECT_PRED_FORMAT2(SameJson, b.read_message()->payload,
                        R"({"sceneChanged":{"epoch":1,"by":0,"objects":[],"lights":[],)"
                        R"("materials":[]}})");
    server_->broadcast(change);
    EXPECT_TRUE(a.read_message().has_value());
}

TEST_F(ServerWebSocketTest, RepliesToMergedRequestsAndErrorsWithoutId) {
    start();
    RawClient client(port());
    const ViewerId viewer = join(client);
    ClientEvent event{viewer, ClientEvent::Kind::message, {}, {3, 4}};
    event.message.set_id(5);
    v1::ServerMessage ok;
    ok.mutable_ok();
    server_->reply(event, ok);
    for (const char* expected :
         {R"({"replyTo":3,"ok":{}})", R"({"replyTo":4,"ok":{}})", R"({"replyTo":5,"ok":{}})"}) {
        EXPECT_PRED_FORMAT2(SameJson, client.read_message()->payload, expected);
    }
    server_->reply_error({viewer, ClientEvent::Kind::message, {}, {}}, v1::Error::NOT_FOUND, "no");
    EXPECT_PRED_FORMAT2(SameJson, client.read_message()->payload,
                        R"({"error":{"code":"NOT_FOUND","message":"no"}})");
    server_->disconnect(viewer, v1::Error::INTERNAL, "enough");
    EXPECT_TRUE(has(client.read_message()->payload, "enough"));
    EXPECT_EQ(client.read_message()->close_code(), 1008);
}

TEST_F(ServerWebSocketTest, StopsWithoutWaitingForAnybodyAndSaysGoodbye) {
    start();
    RawClient client(port());
    join(client);
    RawClient stuck(port(), 4096);
    send_frame(join(stuck), 1, 8000000);
    RawClient idle(port());
    server_->stop();  // never returns where it waits for those who do not read
    EXPECT_EQ(client.read_message()->close_code(), 1001);
    server_->send(1, {});  // harmless
    server_->stop();
}

TEST_F(ServerWebSocketTest, ManyThreadsMaySend) {
    start();
    RawClient client(port());
    const ViewerId viewer = join(client);
    v1::ServerMessage message;
    message.mutable_ok();
    std::vector<std::thread> threads;
    threads.reserve(4);
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&] {
            for (std::uint32_t i = 0; i < 100; ++i) {
                server_->send(viewer, message);
                server_->broadcast(message);
                server_->advise(viewer, kDemand);
                send_frame(viewer, i, 100);
            }
        });
    }
    int texts = 0;
    while (texts < 800) {
        const auto received = client.read_message();
        ASSERT_TRUE(received.has_value());
        texts += received->opcode == 1 ? 1 : 0;
    }
    for (auto& thread : threads) {
        thread.join();
    }
}

}  // namespace
}  // namespace raybundle
