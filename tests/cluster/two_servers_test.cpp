// SPDX-License-Identifier: Apache-2.0
// Two servers of one project share its changes and what reviewers leave.
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "daemon.h"
#include "journal/redis/redis_log.h"
#include "journal/session_journal.h"
#include "json_viewer.h"
#include "raw_client.h"
#include "redis_server.h"

namespace raybundle {
namespace {

Json light(double intensity) {
    return {{"setLight", {{"light", 1}, {"intensity", intensity}}}};
}

Json box_at(double x) {
    return {{"moveObject",
             {{"object", kShortBox},
              {"transform", {{"translation", {{"x", x}, {"y", 0.825}, {"z", 1.7}}}}}}}};
}

Json pin_at_floor() {
    return {{"addPin", {{"text", "glare"}, {"position", {{"x", 1.0}, {"y", 0.0}, {"z", 1.0}}}}}};
}

Json zone() {
    const auto corner = [](double x, double z) { return Json{{"x", x}, {"y", 3.0}, {"z", z}}; };
    return {{"measure",
             {{"name", "desk"},
              {"quantity", "HORIZONTAL"},
              {"keep", true},
              {"relativeError", 0.5},
              {"columns", 2},
              {"rows", 2},
              {"outline", {corner(1, 1), corner(4, 1), corner(4, 4)}}}}};
}

std::uint32_t epoch_of(const Json& answer) {
    return answer.at("sceneChanged").at("epoch").get<std::uint32_t>();
}

/// Two servers for all tests: each test goes on where the one before has left the project.
class TwoServers : public testing::Test {
  protected:
    struct Project {
        RedisServer redis;
        std::vector<std::string> options{"--redis", redis.text(), "--project", "box"};
        Daemon one{scene_file("cornell_box.gltf"), options};
        Daemon other{scene_file("cornell_box.gltf"), options};
    };

    static void SetUpTestSuite() { project_ = std::make_unique<Project>(); }
    static void TearDownTestSuite() { project_.reset(); }

    /// Both servers know of all changes.
    void SetUp() override {
        ASSERT_TRUE(one().says("is ready")) << one().output();
        ASSERT_TRUE(other().says("is ready")) << other().output();
        do {
            base = epoch_at(one());
        } while (epoch_at(other()) != base);
    }

    static Daemon& one() { return project_->one; }
    static Daemon& other() { return project_->other; }
    static RedisServer& redis() { return project_->redis; }
    static const std::vector<std::string>& options() { return project_->options; }

    /// What a server says to a newcomer.
    static Json scene_at(const Daemon& server) {
        const std::string answer = http_exchange(
            server.port(),
            "GET /api/v1/scene HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n");
        return Json::parse(answer.substr(answer.find("\r\n\r\n")));
    }
    static std::uint32_t epoch_at(const Daemon& server) {
        return scene_at(server).at("epoch").get<std::uint32_t>();
    }

    std::uint32_t base = 0;  ///< epoch that the test begins at

  private:
    static inline std::unique_ptr<Project> project_;
};

/// Small pictures, so that servers have time for what is tested.
Json join(JsonViewer& viewer) {
    return viewer.join({}, 32, 24).at("welcome");
}

TEST_F(TwoServers, AChangeSentToOneArrivesAtTheOther) {
    JsonViewer here(one().port());
    const Json lamp = join(here).at("scene").at("lights").at(0);
    JsonViewer there(other().port());
    join(there);
    EXPECT_EQ(epoch_of(here.request(box_at(2.0))), base + 1);
    Json news = there.next_with("sceneChanged");
    EXPECT_EQ(epoch_of(news), base + 1);
    EXPECT_EQ(news.at("sceneChanged").at("by"), 0) << "viewers' numbers are each server's own";
    EXPECT_EQ(news.at("sceneChanged").at("byName"), "test");
    EXPECT_NEAR(news.at("sceneChanged").at("moveObject").at("transform").at("translation").at("x"),
                2.0, 1e-6);
    EXPECT_EQ(epoch_of(there.request(light(500.0))), base + 2);
    EXPECT_EQ(epoch_of(here.next_with("sceneChanged")), base + 2);
    // The pictures of both show it.
    for (JsonViewer* viewer : {&here, &there}) {
        EXPECT_FALSE(
            viewer->next_frame([&](const Json& header) { return header.at("epoch") == base + 2; })
                .empty());
    }
    // An undo at one is one at the other.
    EXPECT_TRUE(here.request({{"undo", {{"epoch", base + 1}}}}).contains("ok"));
    news = there.next_with("sceneChanged");
    EXPECT_EQ(epoch_of(news), base + 3);
    EXPECT_EQ(news.at("sceneChanged").at("setLight").at("intensity"), lamp.at("intensity"));
}

TEST_F(TwoServers, SoDoPinsViewpointsAndLightingScenes) {
    JsonViewer here(one().port());
    join(here);
    JsonViewer there(other().port());
    join(there);
    const Json pin = here.request(
        {{"addPin", {{"text", "glare"}, {"position", {{"x", 1.0}, {"y", 0.0}, {"z", 1.0}}}}}});
    const auto first = pin.at("pinChanged").at("pin").get<std::uint32_t>();
    EXPECT_EQ(there.next_with("pinChanged").at("pinChanged").at("text"), "glare");
    const Json second = there.request(
        {{"addPin", {{"text", "dark"}, {"position", {{"x", 2.0}, {"y", 0.0}, {"z", 1.0}}}}}});
    EXPECT_GT(second.at("pinChanged").at("pin"), first) << "no number is given twice";
    here.request({{"saveLightingScene", {{"name", "evening"}}}});
    EXPECT_EQ(there.next_with("lightingSceneChanged").at("lightingSceneChanged").at("name"),
              "evening");
    EXPECT_TRUE(there.request({{"applyLightingScene", {{"name", "evening"}}}}).contains("ok"));
    there.request({{"removePin", {{"pin", first}}}});
    const Json removed = here.next([](const Json& message) {
        return message.contains("pinChanged") && message.at("pinChanged").at("removed") == true;
    });
    EXPECT_EQ(removed.at("pinChanged").at("pin"), first);
    // A fade is one entry, which each plays.
    there.request({{"setLight", {{"light", 1}, {"dim", 0.5}, {"fadeSeconds", 60.0}}}});
    const Json fading = here.next_with("sceneChanged").at("sceneChanged").at("setLight");
    EXPECT_EQ(fading.at("fadeSeconds"), 60.0);
    EXPECT_EQ(scene_at(one()).at("scene").at("fades").at(0).at("light"), 1);
    there.request({{"setLight", {{"light", 1}, {"dim", 1.0}}}});
    EXPECT_EQ(here.next_with("sceneChanged").at("sceneChanged").at("setLight").at("dim"), 1.0);
    // Who comes later finds all of it.
    Daemon third(scene_file("cornell_box.gltf"), options());
    ASSERT_TRUE(third.says("is ready"));
    const Json welcome = scene_at(third);
    for (const Json& there_is : welcome.at("pins")) {
        EXPECT_NE(there_is.at("pin"), first);
    }
    EXPECT_EQ(welcome.at("pins").back().at("text"), "dark");
    EXPECT_EQ(welcome.at("scene").at("lightingScenes").size(), 1U);
}

TEST_F(TwoServers, WhatIsAskedForAgainUnderItsKeyIsMadeOnce) {
    JsonViewer here(one().port());
    join(here);
    JsonViewer there(other().port());
    join(there);
    Json request = box_at(2.25);
    request["requestKey"] = "a-1";
    EXPECT_EQ(epoch_of(here.request(request)), base + 1);
    EXPECT_EQ(epoch_of(there.request(request)), base + 1) << "whether it has heard of it or not";
    EXPECT_EQ(epoch_of(here.request(request)), base + 1);
    EXPECT_EQ(epoch_of(there.request(light(410.0))), base + 2);
    // What stands for several changes, too, though what it would lead to now is something else.
    Json back = {{"requestKey", "a-2"}, {"undo", {{"epoch", base}}}};
    EXPECT_TRUE(here.request(back).contains("ok"));
    EXPECT_EQ(epoch_of(here.request(light(300.0))), base + 5);
    EXPECT_EQ(epoch_of(there.next([&](const Json& message) {
                  return message.contains("sceneChanged") && epoch_of(message) == base + 5;
              })),
              base + 5);
    EXPECT_TRUE(there.request(back).contains("ok"));
    EXPECT_EQ(epoch_of(there.request(light(200.0))), base + 6) << "nothing was taken back";
}

TEST_F(TwoServers, BothChangeAtATimeAndAgreeInTheEnd) {
    JsonViewer here(one().port());
    join(here);
    JsonViewer there(other().port());
    join(there);
    constexpr int rounds = 10;
    std::vector<std::uint32_t> epochs;
    for (int i = 0; i < rounds; ++i) {
        Json a = box_at(1.5 + 0.05 * i);
        Json b = light(300.0 + i);
        a["id"] = 1 + i;
        b["id"] = 1 + i;
        here.send(a);
        there.send(b);
        epochs.push_back(epoch_of(here.answer_to(static_cast<std::uint32_t>(1 + i))));
        epochs.push_back(epoch_of(there.answer_to(static_cast<std::uint32_t>(1 + i))));
    }
    std::sort(epochs.begin(), epochs.end());
    for (std::uint32_t i = 0; i < 2 * rounds; ++i) {
        EXPECT_EQ(epochs[i], base + i + 1) << "each epoch is of one change";
    }
    for (const Daemon* server : {&one(), &other()}) {
        Json welcome;
        do {  // who was second hears of the last one
            welcome = scene_at(*server);
        } while (welcome.at("epoch") != base + 2 * rounds);
        for (const Json& object : welcome.at("scene").at("objects")) {
            if (object.at("id") == kShortBox) {
                EXPECT_NEAR(object.at("transform").at("translation").at("x"),
                            1.5 + 0.05 * (rounds - 1), 1e-5);
            }
        }
        EXPECT_NEAR(welcome.at("scene").at("lights").at(0).at("intensity"), 300.0 + rounds - 1,
                    1e-3);
    }
}

/// Both give out the same number before they hear of each other.
TEST_F(TwoServers, WhatBothAddAtATimeIsThereTwice) {
    JsonViewer here(one().port());
    join(here);
    JsonViewer there(other().port());
    join(there);
    constexpr std::uint32_t rounds = 2;
    std::set<std::uint32_t> added;
    for (std::uint32_t i = 1; i <= rounds; ++i) {
        const Json addition = {{"id", i}, {"addObject", {{"copyOf", kShortBox}, {"name", "copy"}}}};
        here.send(addition);
        there.send(addition);
        for (JsonViewer* viewer : {&here, &there}) {
            const Json answer = viewer->answer_to(i);
            ASSERT_TRUE(answer.contains("sceneChanged")) << answer;
            added.insert(
                answer.at("sceneChanged").at("addObject").at("object").get<std::uint32_t>());
        }
    }
    EXPECT_EQ(added.size(), 2 * rounds) << "no number is given twice";
    for (const Daemon* server : {&one(), &other()}) {
        Json welcome;
        do {  // who was second hears of the last one
            welcome = scene_at(*server);
        } while (welcome.at("epoch") != base + 2 * rounds);
        std::set<std::uint32_t> present;
        for (const Json& object : welcome.at("scene").at("objects")) {
            present.insert(object.at("id").get<std::uint32_t>());
        }
        EXPECT_TRUE(std::includes(present.begin(), present.end(), added.begin(), added.end()));
    }
}

TEST_F(TwoServers, WithoutRedisLookingGoesOnAndChangesAreRefused) {
    JsonViewer here(one().port());
    join(here);
    JsonViewer there(other().port());
    join(there);
    ASSERT_EQ(epoch_of(here.request(light(500.0))), base + 1);
    const std::uint32_t pin =
        here.request(pin_at_floor()).at("pinChanged").at("pin").get<std::uint32_t>();
    const Json measured = here.request(zone());
    ASSERT_TRUE(measured.contains("measured")) << measured;
    const Json zone_number = measured.at("measured").at("measurement");
    redis().kill_it();
    for (const Json& request :
         {light(600.0), zone(), Json{{"replyToPin", {{"pin", pin}, {"text", "since when?"}}}},
          Json{{"setPin", {{"pin", pin}, {"resolved", true}}}}, Json{{"removePin", {{"pin", pin}}}},
          Json{{"setZone", {{"measurement", zone_number}, {"name", "aisle"}}}},
          Json{{"removeMeasurement", {{"measurement", zone_number}}}},
          Json{{"setRequirement", {{"requirement", {{"name", "Lobby"}, {"mean", 200.0}}}}}},
          Json{{"removeRequirement", {{"name", "Corridor"}}}},
          Json{{"setTarget", {{"relativeError", 0.02}}}}, pin_at_floor(),
          Json{{"saveLightingScene", {{"name", "evening"}}}}, Json{{"undo", {{"epoch", 0}}}}}) {
        const Json answer = here.request(request);
        ASSERT_TRUE(answer.contains("error")) << request << answer;
        EXPECT_EQ(answer.at("error").at("code"), "UNAVAILABLE") << request;
        EXPECT_NE(answer.at("error").at("message").get<std::string>().find("ask again later"),
                  std::string::npos);
    }
    const Json before = here.next_with("solution");
    EXPECT_EQ(here.next([](const Json& m) {
                      return m.contains("solution") && m.at("solution").at("saving") == "FAILING";
                  })
                  .empty(),
              false);
    EXPECT_FALSE(here.next([&](const Json& m) {
                         return m.contains("solution") &&
                                m.at("solution").at("iterations") >
                                    before.at("solution").at("iterations");
                     })
                     .empty())
        << "solving goes on";
    here.send({{"id", 77},
               {"setCamera",
                {{"eye", {{"x", 2.7}, {"y", 2.7}, {"z", -6.0}}},
                 {"target", {{"x", 2.7}, {"y", 2.7}, {"z", 2.7}}}}}});
    EXPECT_FALSE(here.next_frame([](const Json& h) { return h.at("cameraId") == 77; }).empty());
    redis().start();
    here.next([](const Json& m) {
        return m.contains("solution") && m.at("solution").at("saving") == "SAVED";
    });
    EXPECT_EQ(epoch_of(here.request(light(700.0))), base + 2)
        << "nothing of what was refused is there";
    const Json news = there.next([&](const Json& m) {
        return m.contains("sceneChanged") && m.at("sceneChanged").at("epoch") == base + 2;
    });
    EXPECT_NEAR(news.at("sceneChanged").at("setLight").at("intensity"), 700.0, 1e-3);
}

/// The viewer of that name in a presence; null where there is none.
Json person_in(const Json& message, const std::string& name) {
    if (message.contains("presence")) {
        for (const Json& viewer : message.at("presence").at("viewers")) {
            if (viewer.at("name") == name) {
                return viewer;
            }
        }
    }
    return {};
}

TEST_F(TwoServers, ViewersSeeAndFollowThoseOfTheOther) {
    JsonViewer here(one().port());
    const Json own = join(here).at("viewer");
    std::optional<JsonViewer> there(other().port());
    there->request(
        {{"hello",
          {{"protocol", "1.0"}, {"name", "Ada"}, {"viewport", {{"width", 32}, {"height", 24}}}}}});
    const Json peer = person_in(
        here.next([](const Json& message) { return !person_in(message, "Ada").is_null(); }), "Ada");
    ASSERT_TRUE(peer.contains("viewer"));
    constexpr unsigned first_peer = 1U << 31U;
    EXPECT_GE(peer.at("viewer"), first_peer);
    EXPECT_TRUE(here.request({{"follow", {{"viewer", peer.at("viewer")}}}}).contains("ok"));
    there->request({{"setCamera",
                     {{"eye", {{"x", 2.7}, {"y", 2.7}, {"z", -6.5}}},
                      {"target", {{"x", 2.7}, {"y", 2.7}, {"z", 2.7}}}}}});
    const Json followed = here.next([&](const Json& message) {
        if (!message.contains("presence")) {
            return false;
        }
        for (const Json& viewer : message.at("presence").at("viewers")) {
            if (viewer.at("viewer") == own && viewer.at("eye").at("z") == -6.5) {
                return true;
            }
        }
        return false;
    });
    EXPECT_FALSE(followed.empty()) << "who follows looks where the other one looks";
    there->request({{"pointAt", {{"position", {{"x", 1.0}, {"y", 0.0}, {"z", 1.0}}}}}});
    EXPECT_EQ(here.next_with("pointed").at("pointed").at("by"), peer.at("viewer"));
    there.reset();
    EXPECT_FALSE(here.next([](const Json& message) {
                         return message.contains("presence") &&
                                message.at("presence").at("viewers").size() == 1;
                     })
                     .empty())
        << "who leaves is gone";
}

TEST(ClusterStart, ASecretOnTheCommandLineIsNoOption) {
    for (const char* flag : {"--redis-password", "--redis-user"}) {
        Daemon daemon(Daemon::Unready{}, scene_file("cornell_box.gltf"), {flag, "secret"});
        EXPECT_EQ(daemon.wait(), 2);
    }
}

TEST(ClusterStart, ASecretInTheFileIsNotPrinted) {
    const TestFolder folder;
    folder.write("a.json", R"({"redisPassword": "open sesame", "redisUser": "office"})");
    Daemon daemon(Daemon::Unready{}, scene_file("cornell_box.gltf"),
                  {"--config", folder.path("a.json"), "--print-config"});
    EXPECT_EQ(daemon.wait(), 0);
    EXPECT_EQ(daemon.output().find("sesame"), std::string::npos) << daemon.output();
}

/// One that was recorded alone, as by an earlier version: its sky comes undimmed, and nobody adds
/// changes to the log for that.
TEST_F(TwoServers, DaylightOfAnotherServerIsNoReasonForFurtherChanges) {
    JsonViewer here(one().port());
    join(here);
    const Json day = here.request({{"setDaylight", {{"sky", "clear"}, {"sunElevation", 40.0}}}});
    ASSERT_EQ(epoch_of(day), base + 1);
    Json told = day.at("sceneChanged").at("setDaylight");
    const Json sky = told.at("lights").at(0).at("id");
    ASSERT_EQ(epoch_of(here.request({{"setLight", {{"light", sky}, {"on", false}}}})), base + 2);

    RedisLogSettings settings;
    settings.address = redis().address();
    settings.project = "box";
    settings.scene_digest = *file_digest(scene_file("cornell_box.gltf"));
    RedisLog log(settings);
    v1::SceneChanged recorded;
    recorded.set_epoch(base + 3);
    told.erase("lights");
    ASSERT_TRUE(
        google::protobuf::util::JsonStringToMessage(told.dump(), recorded.mutable_set_daylight())
            .ok());
    ASSERT_EQ(log.append(recorded, {}, {}), Appended::yes);
    const auto shows_it = [&](const Json& m) {
        return m.contains("sceneChanged") && m.at("sceneChanged").at("epoch") == base + 3;
    };
    EXPECT_TRUE(here.next(shows_it).at("sceneChanged").contains("setDaylight"));
    EXPECT_EQ(epoch_of(here.request(light(500.0))), base + 4) << "nothing came between";
}

}  // namespace
}  // namespace raybundle
