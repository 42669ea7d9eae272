// SPDX-License-Identifier: Apache-2.0
// Many viewers, and bad ones among them.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"
#include "stream/video_encoder.h"

namespace raybundle {
namespace {

double metric(std::uint16_t port, const std::string& name) {
    const std::string text =
        http_exchange(port, "GET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
    const std::size_t found = text.find("\n" + name + " ");
    return found == std::string::npos ? -1.0 : std::stod(text.substr(found + name.size() + 2));
}

/// Waits for a metric to reach a value. False: only what hangs takes so long.
bool reaches(std::uint16_t port, const std::string& name, double value) {
    for (int i = 0; i < 3000; ++i) {
        if (metric(port, name) == value) {
            return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return false;
}

class ViewersTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        daemon_ = std::make_unique<Daemon>(scene_file("cornell_box.gltf"));
    }
    static void TearDownTestSuite() { daemon_.reset(); }

    static std::unique_ptr<Daemon> daemon_;
};

std::unique_ptr<Daemon> ViewersTest::daemon_;

using Viewers = std::vector<std::unique_ptr<JsonViewer>>;

/// Adds viewers with pictures of 4K until one is refused: its refusal; empty where twelve are
/// admitted.
Json refusal_of_large_pictures(std::uint16_t port, Viewers& large) {
    Json refusal;
    for (int i = 0; i < 12 && refusal.empty(); ++i) {
        large.push_back(std::make_unique<JsonViewer>(port));
        const Json answer = large.back()->join("", 3840, 2160);
        if (answer.contains("error") || !answer.contains("welcome")) {
            refusal = answer;
        }
    }
    return refusal;
}

/// Whoever is alone is admitted, however slow a machine is.
TEST(AdmissionTest, ThePictureThatWouldStarveTheOthersIsRefusedWithWhatFits) {
    const Daemon daemon(scene_file("cornell_box.gltf"), {"--min-frames-per-second", "60"});
    JsonViewer first(daemon.port());
    EXPECT_TRUE(first.join().contains("welcome"));
    Viewers large;
    const Json refusal = refusal_of_large_pictures(daemon.port(), large);
    ASSERT_FALSE(refusal.empty()) << "twelve 4K pictures were admitted";
    EXPECT_EQ(refusal.at("error").at("code"), "RESOURCE_EXHAUSTED");
    EXPECT_NE(refusal.at("error").at("message").get<std::string>().find("fit"), std::string::npos);
    EXPECT_GE(metric(daemon.port(), "raybundle_viewers_refused_total"), 1.0);
}

/// Two small pictures fit into half a second where a machine is not too busy.
TEST(AdmissionHeavyTest, APictureThatGrowsTooLargeIsRefused) {
    const Daemon daemon(scene_file("cornell_box.gltf"), {"--min-frames-per-second", "2"});
    JsonViewer small(daemon.port());
    EXPECT_TRUE(small.join().contains("welcome"));
    JsonViewer another(daemon.port());
    EXPECT_TRUE(another.join().contains("welcome"));
    Viewers large;
    const Json refusal = refusal_of_large_pictures(daemon.port(), large);
    ASSERT_FALSE(refusal.empty()) << "twelve 4K pictures were admitted";
    const Json grown = small.request({{"setViewport", {{"width", 3840}, {"height", 2160}}}});
    EXPECT_EQ(grown.at("error").at("code"), "RESOURCE_EXHAUSTED") << grown.dump();
}

TEST_F(ViewersTest, AViewerThatAcknowledgesNothingIsPausedAndComesBack) {
    JsonViewer active(daemon_->port());
    active.join();
    RawClient hidden(daemon_->port());
    hidden.upgrade();
    hidden.send_text(
        R"({"id":1,"hello":{"protocol":"1.0","viewport":{"width":160,"height":120}}})");
    // The active one must keep acknowledging meanwhile.
    bool paused = false;
    for (int i = 0; i < 5000 && !paused; ++i) {
        active.request({{"ping", Json::object()}});
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        paused = metric(daemon_->port(), "raybundle_paused_viewers") == 1.0;
    }
    EXPECT_TRUE(paused);
    for (int frame = 1; frame <= 50; ++frame) {
        hidden.send_text(R"({"ack":{"frame":)" + std::to_string(frame) + R"(,"decodeMs":1}})");
    }
    EXPECT_TRUE(reaches(daemon_->port(), "raybundle_paused_viewers", 0.0));
}

TEST_F(ViewersTest, EndsInTheMiddleOfEverythingLeaveNothingBehind) {
    for (int i = 0; i < 20; ++i) {
        RawClient client(daemon_->port());
        client.upgrade();
        client.send_text(
            R"({"id":1,"hello":{"protocol":"1.0","viewport":{"width":160,"height":120}}})");
        if (i % 4 == 1) {
            client.read_message();
        }
        if (i % 4 >= 2) {
            client.send(std::string("\x81\xfe\x01\x00\x11\x22\x33\x44{\"set", 13));
        }
        client.reset();
    }
    EXPECT_TRUE(reaches(daemon_->port(), "raybundle_viewers", 0.0));
    EXPECT_TRUE(reaches(daemon_->port(), "raybundle_rendered_viewers", 0.0));
    JsonViewer viewer(daemon_->port());
    EXPECT_TRUE(viewer.join().contains("welcome"));
}

TEST_F(ViewersTest, EveryMovingViewerGetsFramesOfItsOwnCamera) {
    constexpr int kViewers = 6;
    std::vector<std::unique_ptr<JsonViewer>> viewers;
    for (int i = 0; i < kViewers; ++i) {
        viewers.push_back(std::make_unique<JsonViewer>(daemon_->port()));
        ASSERT_TRUE(viewers.back()->join("", 320, 180).contains("welcome"));
    }
    for (int turn = 1; turn <= 5; ++turn) {
        for (int i = 0; i < kViewers; ++i) {
            viewers[static_cast<std::size_t>(i)]->send(
                {{"id", turn},
                 {"setCamera",
                  {{"eye", {{"x", 2.7 + 0.1 * turn}, {"y", 2.7}, {"z", -7.5 + 0.1 * i}}},
                   {"target", {{"x", 2.7}, {"y", 2.7}, {"z", 2.7}}}}}});
        }
        for (auto& viewer : viewers) {
            EXPECT_FALSE(
                viewer->next_frame([&](const Json& f) { return f["cameraId"] == turn; }).empty());
        }
    }
}

/// As the protocol's page has it: hello.codecs, and the frame header's codec and key.
TEST_F(ViewersTest, WhoOffersVp9FirstGetsVideoWhileItMovesAndAPictureAtRest) {
    if (!VideoEncoder::available()) {
        GTEST_SKIP() << "built without libvpx";
    }
    JsonViewer viewer(daemon_->port());
    const Json welcome =
        viewer.request({{"hello",
                         {{"protocol", "1.0"},
                          {"lenient", true},
                          {"codecs", {"AV1", "VP9", "JPEG"}},  // of which it knows the second
                          {"viewport", {{"width", 160}, {"height", 121}}}}}});
    ASSERT_TRUE(welcome.contains("welcome")) << welcome.dump();
    int turn = 0;
    const auto next_video = [&] {
        for (int i = 0; i < 100; ++i) {
            ++turn;
            viewer.send({{"id", turn},
                         {"setCamera",
                          {{"eye", {{"x", 2.7 + 0.001 * turn}, {"y", 2.7}, {"z", -7.5}}},
                           {"target", {{"x", 2.7}, {"y", 2.7}, {"z", 2.7}}}}}});
            Json header = viewer.next_frame([&](const Json& f) { return f["cameraId"] == turn; });
            if (header.value("codec", "") == "VP9") {
                return header;
            }
        }
        return Json::object();
    };
    const Json first = next_video();
    ASSERT_EQ(first.value("codec", ""), "VP9") << first.dump();
    EXPECT_TRUE(first.at("key"));
    Json last = first;
    bool other = false;
    for (int i = 0; i < 5 && !other; ++i) {
        last = next_video();
        other = !last.value("key", true);
    }
    EXPECT_TRUE(other) << "each frame is a key frame";
    viewer.send({{"ack", {{"frame", last.at("frame")}, {"wantsKey", true}}}});
    viewer.request({{"ping", Json::object()}});  // it has been read
    EXPECT_TRUE(next_video().at("key"));
    const Json rest = viewer.next_frame([](const Json& f) { return f["codec"] != "VP9"; });
    EXPECT_EQ(rest.value("codec", ""), "JPEG");
    EXPECT_FALSE(rest.contains("key"));
    EXPECT_TRUE(reaches(daemon_->port(), "raybundle_video_encoders", 0.0));
}

/// Pictures in motion may be smaller where there is no time for more; probes mean the full ones.
TEST_F(ViewersTest, APictureInMotionMayBeSmallerAndIsFullAgainAtRest) {
    static constexpr int kWidth = 1280;
    constexpr int kHeight = 960;
    JsonViewer viewer(daemon_->port());
    const Json welcome = viewer.join("", kWidth, kHeight);
    const auto is_full = [](const Json& f) { return f["width"] == kWidth; };
    const auto expect_whole = [](const Json& f) {
        EXPECT_GE(f.value("width", 0), kWidth * 5 / 8);
        EXPECT_LE(f.value("width", 0), kWidth);
        EXPECT_NEAR(f.value("width", 0) / 4.0, f.value("height", 0) / 3.0, 0.5);
    };
    for (int turn = 1; turn <= 12; ++turn) {
        viewer.send({{"id", turn},
                     {"setCamera",
                      {{"eye", {{"x", 2.7 + 0.02 * turn}, {"y", 2.7}, {"z", -7.5}}},
                       {"target", {{"x", 2.7}, {"y", 2.7}, {"z", 2.7}}}}}});
        expect_whole(viewer.next_frame([&](const Json& f) { return f["cameraId"] == turn; }));
    }
    const Json corner = {{"probe", {{"pixel", {{"x", kWidth / 2}, {"y", kHeight - 250}}}}}};
    EXPECT_TRUE(viewer.request(corner).at("probeResult").at("hit"));
    EXPECT_FALSE(viewer.next_frame(is_full).empty());
    Json transform = welcome["welcome"]["scene"]["objects"][kShortBox - 1]["transform"];
    for (int step = 1; step <= 6; ++step) {
        transform["translation"]["x"] = 0.02 * step;
        const Json moved = viewer.request(
            {{"moveObject",
              {{"object", kShortBox}, {"transform", transform}, {"final", step == 6}}}});
        const int epoch = moved.at("sceneChanged").at("epoch");
        expect_whole(viewer.next_frame([&](const Json& f) { return f["epoch"] == epoch; }));
    }
    EXPECT_FALSE(viewer.next_frame(is_full).empty());
}

/// A picture of another size knows nothing of its brightness, and is as bright as the last one.
TEST_F(ViewersTest, APictureOfAnotherSizeDoesNotFlash) {
    JsonViewer viewer(daemon_->port());
    viewer.join("", 320, 240);
    const Json before =
        viewer.next_frame([](const Json& header) { return header.value("iterations", 0) >= 64; });
    const double exposure = before.at("exposure").get<double>();
    EXPECT_GT(std::abs(exposure), 2.0) << "the room is not lit for 0 EV";
    for (const int width : {200, 400, 240}) {
        viewer.send({{"setViewport", {{"width", width}, {"height", 240}}}});
        for (int frames = 0; frames < 4; ++frames) {
            const Json header = viewer.next_frame(
                [&](const Json& frame) { return frame.value("width", 0) == width; });
            ASSERT_FALSE(header.empty());
            EXPECT_NEAR(header.at("exposure").get<double>(), exposure, 0.5) << width;
        }
    }
}

/// A window that shrinks to nothing and comes back before a small picture has been drawn: memory is
/// counted by the picture that is there.
TEST_F(ViewersTest, AWindowThatShrinksMayGrowAgainAtOnce) {
    JsonViewer viewer(daemon_->port());
    viewer.join("", 640, 480);
    ASSERT_FALSE(viewer.next_frame([](const Json& f) { return f["width"] == 640; }).empty());
    for (int turn = 0; turn < 3; ++turn) {
        EXPECT_TRUE(
            viewer.request({{"setViewport", {{"width", 1}, {"height", 1}}}}).contains("ok"));
        const Json grown = viewer.request({{"setViewport", {{"width", 640}, {"height", 480}}}});
        ASSERT_TRUE(grown.contains("ok")) << grown.dump();
        EXPECT_FALSE(grown.at("ok").contains("viewport")) << grown.dump();
    }
}

TEST_F(ViewersTest, RequestsThatDrawWaitTheirTurnAndAreAllAnswered) {
    constexpr int kRequests = 60;  // fewer than may wait
    JsonViewer moving(daemon_->port());
    ASSERT_TRUE(moving.join().contains("welcome"));
    JsonViewer greedy(daemon_->port());
    ASSERT_TRUE(greedy.join().contains("welcome"));
    for (int id = 2; id < 2 + kRequests; ++id) {
        const Json resize = {{"id", id}, {"setViewport", {{"width", 640 + id}, {"height", 360}}}};
        const Json probe = {{"id", id}, {"probe", {{"pixel", {{"x", 9}, {"y", 9}}}}}};
        greedy.send(id % 2 == 0 ? resize : probe);
    }
    for (int turn = 1; turn <= 5; ++turn) {
        moving.send({{"id", turn},
                     {"setCamera",
                      {{"eye", {{"x", 2.7 + 0.1 * turn}, {"y", 2.7}, {"z", -7.5}}},
                       {"target", {{"x", 2.7}, {"y", 2.7}, {"z", 2.7}}}}}});
        EXPECT_FALSE(
            moving.next_frame([&](const Json& f) { return f["cameraId"] == turn; }).empty());
    }
    for (unsigned id = 2; id < 2 + kRequests; ++id) {
        const Json answer = greedy.answer_to(id);
        EXPECT_TRUE(answer.contains(id % 2 == 0 ? "ok" : "probeResult")) << id << answer.dump();
    }
}

TEST_F(ViewersTest, WhoDoesNotMaskHisFramesIsSentAway) {
    RawClient client(daemon_->port());
    ASSERT_TRUE(has(client.upgrade(), " 101 "));
    const std::string hello = R"({"id":1,"hello":{"protocol":"1.0"}})";
    client.send("\x81" + std::string(1, static_cast<char>(hello.size())) + hello);
    const auto answer = client.read_frame();
    ASSERT_TRUE(answer.has_value());
    EXPECT_EQ(answer->close_code(), 1002) << answer->payload;
    EXPECT_TRUE(client.closed());
}

TEST_F(ViewersTest, DepthsGoToWhoAsksForThemAndToNobodyElse) {
    JsonViewer asks(daemon_->port());
    JsonViewer other(daemon_->port());
    asks.join("", 160, 120);
    other.join("", 160, 120);
    EXPECT_TRUE(asks.request({{"setDepths", {{"columns", 41}}}}).contains("ok"));
    const auto has_depths = [](const Json& frame) { return frame.contains("depthBytes"); };
    const Json frame = asks.next_frame(has_depths);
    EXPECT_EQ(frame.value("depthColumns", 0), 41);
    EXPECT_EQ(frame.value("depthRows", 0), 31);
    EXPECT_GT(frame.value("depthNearest", 0.0), 7.5);  // the room begins there
    EXPECT_LT(frame.value("depthNearest", 0.0), 9.5);
    EXPECT_LT(frame.value("depthBytes", 0), 2 * 41 * 31 + 64);
    for (int i = 0; i < 3; ++i) {
        EXPECT_FALSE(has_depths(other.next_frame([](const Json&) { return true; })));
    }
    asks.request({{"setDepths", {{"columns", 0}}}});
    EXPECT_FALSE(asks.next_frame([&](const Json& f) { return !has_depths(f); }).empty());
    EXPECT_EQ(asks.request({{"setDepths", {{"columns", 1}}}}).at("error").at("code"),
              "INVALID_ARGUMENT");
}

TEST(SilentViewersTest, WhoNeverAcknowledgesGetsOneFrameAndHoldsNoPicture) {
    constexpr double kPictures = 6.0;
    constexpr double kLeastBytes = 1280.0 * 720.0 * 60.0;  // of one picture
    const Daemon daemon(scene_file("cornell_box.gltf"), {"--min-frames-per-second", "0.1"});
    JsonViewer active(daemon.port());
    active.join();
    ASSERT_FALSE(active.next_frame([](const Json&) { return true; }).empty());
    ASSERT_TRUE(reaches(daemon.port(), "raybundle_rendered_viewers", 1.0));
    const double before = metric(daemon.port(), "raybundle_gl_memory_bytes");
    std::vector<std::unique_ptr<RawClient>> silent;
    for (int i = 0; i < static_cast<int>(kPictures); ++i) {
        silent.push_back(std::make_unique<RawClient>(daemon.port()));
        silent.back()->upgrade();
        silent.back()->send_text(
            R"({"id":1,"hello":{"protocol":"1.0","viewport":{"width":1280,"height":720}}})");
    }
    for (auto& client : silent) {
        std::optional<RawFrame> message;
        while ((message = client->read_message()) && message->opcode != 2) {
        }
        EXPECT_TRUE(message.has_value()) << "no first frame";
    }
    ASSERT_TRUE(reaches(daemon.port(), "raybundle_rendered_viewers", kPictures + 1.0));
    const double after = metric(daemon.port(), "raybundle_gl_memory_bytes");
    EXPECT_LT(after - before, 0.5 * kPictures * kLeastBytes);
}

}  // namespace
}  // namespace raybundle
