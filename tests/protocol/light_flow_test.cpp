// SPDX-License-Identifier: Apache-2.0
// Light on its way to viewers: acknowledgements, the window that follows them, files named by their
// contents.
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "net/http/content_store.h"
#include "net/http/http_response.h"
#include "net/ws/light_acks.h"
#include "net/ws/viewer_link.h"
#include "stream/light_window.h"

namespace raybundle {
namespace {

using namespace std::chrono_literals;

TEST(LightWindow, GrowsWhileAcknowledgementsComeAsFastAsEver) {
    LightWindow window;
    double now = 0.0;
    for (std::uint32_t i = 1; i <= 200; ++i, now += 20.0) {
        window.on_sent(i, 30000, now);
        window.on_ack(i, now + 20.0);
    }
    EXPECT_EQ(window.bytes(), LightWindow::kMax);
}

TEST(LightWindow, ShrinksWhereTheyQueueAndNeverToNothing) {
    LightWindow window;
    window.on_sent(1, 1000, 0.0);
    window.on_ack(1, 10.0);
    for (std::uint32_t i = 2; i <= 20; ++i) {
        window.on_sent(i, 1000, 100.0 * i);
        window.on_ack(i, 100.0 * i + 500.0);
    }
    EXPECT_EQ(window.bytes(), LightWindow::kMin);
}

TEST(LightWindow, ToleratesNumbersThatWereNeverSent) {
    LightWindow window;
    window.on_ack(7, 0.0);
    window.on_sent(1, 1000, 0.0);
    window.on_ack(0, 1.0);
    window.on_ack(5, 1.0);
    EXPECT_EQ(window.bytes(), LightWindow::kStart);
    window.on_ack(1, 1.0);
    EXPECT_EQ(window.bytes(), LightWindow::kStart + 1000);
}

TEST(LightAcks, KeepTheNewestOfEachAndLeaveWhatIsOthers) {
    LightAcks acks;
    acks.acknowledge(1, 4);
    acks.acknowledge(1, 3);
    acks.acknowledge(2, 9);
    const auto first = [](ViewerId viewer) { return viewer == 1; };
    EXPECT_EQ(acks.take(first, 0ms), (LightAcks::Numbers{{1, 4}}));
    EXPECT_EQ(acks.take(first, 0ms), LightAcks::Numbers());
    acks.forget(2);
    EXPECT_EQ(acks.take([](ViewerId) { return true; }, 0ms), LightAcks::Numbers());
    acks.interrupt();
    EXPECT_EQ(acks.take(first, 1h), LightAcks::Numbers());
}

TEST(ViewerLinkLight, ComesAfterTheFrameAndIsDroppedWithTheConnection) {
    ViewerLink link(1, 1000, {});
    v1::LightHeader header;
    header.set_light(3);
    link.send_light(header, "blocks");
    link.send_frame(v1::FrameHeader(), {1});
    EXPECT_EQ(link.take(0)->kind, Outgoing::Kind::ping);
    EXPECT_EQ(link.take(0)->kind, Outgoing::Kind::frame);
    const auto light = link.take(0);
    ASSERT_TRUE(light.has_value());
    EXPECT_EQ(light->kind, Outgoing::Kind::light);
    const std::string text(light->bytes.begin() + Outgoing::kHeadroom, light->bytes.end());
    EXPECT_TRUE(text.ends_with("blocks"));
    EXPECT_NE(text.find("\"light\":3"), std::string::npos) << text;
    link.send_light(header, "blocks");
    link.close(CloseCode::going_away, "over");
    link.send_light(header, "blocks");
    EXPECT_FALSE(link.take(0).has_value());
}

TEST(ViewerLinkLight, AcknowledgementsReachWhoSends) {
    LightAcks acks;
    ViewerLink link(5, 1000, {});
    link.on_light_ack(1);  // nobody sends light
    link.report_light_to(&acks);
    link.on_light_ack(2);
    EXPECT_TRUE(link.answers());
    EXPECT_EQ(acks.take([](ViewerId) { return true; }, 0ms), (LightAcks::Numbers{{5, 2}}));
}

TEST(ContentStore, NamesFoldersByTheirContentsAndKeepsTwoOfAKind) {
    ContentStore store;
    const std::string even(5000, 'a');
    const std::string first = store.add("scene", {{"a.bin", even}, {"b.txt", "b"}});
    EXPECT_EQ(first, store.add("scene", {{"a.bin", even}, {"b.txt", "b"}}));
    EXPECT_NE(first, store.add("scene", {{"a.bin", even}, {"c.txt", "b"}}));
    EXPECT_EQ(first.size(), std::string("/light/").size() + 64 + 1);
    ASSERT_NE(store.find(first + "a.bin"), nullptr);
    EXPECT_EQ(*store.find(first + "a.bin")->bytes, even);
    EXPECT_EQ(store.find(first + "a"), nullptr);
    EXPECT_EQ(store.find(first), nullptr);
    EXPECT_EQ(store.find("/light/x/a.bin"), nullptr);
    const std::string sky = store.add("sky", {{"sky.bin", "s"}});
    store.add("scene", {{"a.bin", "2"}});
    EXPECT_EQ(store.find(first + "a.bin"), nullptr);
    EXPECT_NE(store.find(sky + "sky.bin"), nullptr);
}

TEST(ContentStore, IsServedToBeKeptForEver) {
    ContentStore store;
    const std::string folder =
        store.add("scene", {{"geometry.bin", std::string(5000, 'a')}, {"b.jpg", "b"}});
    HttpContent content;
    content.contents = &store;
    content.accept_encoding = "gzip";
    const HttpResponse packed = http_response(HttpMethod::get, folder + "geometry.bin", content);
    EXPECT_EQ(packed.status, 200);
    EXPECT_LT(packed.content().size(), 500U);
    const auto header = [](const HttpResponse& response, const std::string& name) {
        for (const auto& [key, value] : response.headers) {
            if (key == name) {
                return value;
            }
        }
        return std::string();
    };
    EXPECT_EQ(header(packed, "content-encoding:"), "gzip");
    EXPECT_EQ(header(packed, "cache-control:"), "private, max-age=31536000, immutable");
    const HttpResponse plain = http_response(HttpMethod::get, folder + "b.jpg", content);
    EXPECT_EQ(plain.content(), "b");
    EXPECT_EQ(plain.content_type, "image/jpeg");
    EXPECT_EQ(header(plain, "content-encoding:"), "");
    EXPECT_EQ(http_response(HttpMethod::get, folder, content).status, 404);
    EXPECT_EQ(http_response(HttpMethod::get, "/light/../metrics", content).status, 404);
}

}  // namespace
}  // namespace raybundle
