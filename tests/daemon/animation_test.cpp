// SPDX-License-Identifier: Apache-2.0
// Animations of the file, played for everybody.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "daemon.h"
#include "json_viewer.h"
#include "test_folder.h"

namespace raybundle {
namespace {

/// Two rooms, a lamp in one of them, and a door between them that opens in 2 s.
const std::string door_file = RAYBUNDLE_ROOT "/tests/cases/animation/door.gltf";

Json scene_of(const Json& welcome) {
    return welcome.at("welcome").at("scene");
}

Json named(const Json& list, const std::string& name) {
    for (const Json& one : list) {
        if (one.at("name") == name) {
            return one;
        }
    }
    return {};
}

class Animations : public testing::Test {
  protected:
    void begin(const std::string& extra = {}) {
        std::vector<std::string> options{"--journal", folder_.path("session.db"), "--patch-size",
                                         "0.3"};
        if (!extra.empty()) {
            options.push_back(extra);
        }
        daemon_.emplace(door_file, options);
        viewer_.emplace(daemon_->port());
        scene_ = scene_of(viewer_->join("", 64, 48));
        door_ = named(scene_.at("objects"), "door").at("id");
    }
    void restart() {
        viewer_.reset();
        EXPECT_EQ(daemon_->end(), 0);
        begin();
    }
    Json play(const std::string& name, Json fields) {
        fields["animation"] = name;
        return viewer_->request({{"playAnimation", fields}});
    }
    Json scene_now() {
        JsonViewer other(daemon_->port());
        return scene_of(other.join());
    }
    Json state_now(const std::string& name) {
        return named(scene_now().at("animations"), name).at("state");
    }
    /// Waits for a change that an animation makes, with final or not.
    static Json step_of(JsonViewer& viewer, int object, bool final) {
        return viewer
            .next([&](const Json& message) {
                const Json change = message.value("sceneChanged", Json::object());
                const Json move = change.value("moveObject", Json::object());
                return change.contains("animation") && move.value("object", 0) == object &&
                       move.value("final", true) == final;
            })
            .at("sceneChanged");
    }
    /// Degrees about y.
    static double turn_of(const Json& transform) {
        const Json& q = transform.at("rotation");
        return 2.0 * std::atan2(q.at("y").get<double>(), q.at("w").get<double>()) * 180.0 /
               3.14159265358979;
    }
    double turn_now() { return turn_of(named(scene_now().at("objects"), "door").at("transform")); }

    const TestFolder folder_;
    std::optional<Daemon> daemon_;
    std::optional<JsonViewer> viewer_;
    Json scene_;
    int door_ = 0;
};

TEST_F(Animations, AreListedWithWhatTheyMove) {
    begin();
    const Json door = named(scene_.at("animations"), "door");
    EXPECT_EQ(door.at("seconds"), 2);
    const Json handle = named(scene_.at("objects"), "handle").at("id");
    EXPECT_EQ(door.at("objects"), Json::array({door_, handle}));
    EXPECT_EQ(door.at("state"), Json::parse(R"({"animation": "door", "playing": false,
        "seconds": 0, "speed": 1, "loop": false})"));
    EXPECT_EQ(named(scene_.at("animations"), "desk lamp").at("lights"),
              Json::array({named(scene_.at("lights"), "desk lamp").at("id")}));
    EXPECT_EQ(named(scene_.at("animations"), "paint").at("materials"),
              Json::array({named(scene_.at("materials"), "wood").at("id")}));
    EXPECT_TRUE(named(scene_.at("objects"), "door").at("movable").get<bool>());
}

TEST_F(Animations, RefusalsNameWhatThereIs) {
    begin();
    const auto error = [](const Json& answer) { return answer.at("error"); };
    EXPECT_EQ(error(play("gate", {{"playing", true}})).at("code"), "NOT_FOUND");
    EXPECT_EQ(error(play("gate", {{"playing", true}})).at("message"),
              "playAnimation.animation: no animation 'gate'; there are: 'door', 'handle', 'desk "
              "lamp', 'paint'");
    EXPECT_EQ(error(play("door", {{"seconds", -1}})).at("message"),
              "playAnimation.seconds: must not be negative");
    EXPECT_EQ(error(play("door", {{"speed", 101}})).at("message"),
              "playAnimation.speed: must be -100..100");
    EXPECT_EQ(error(play("door", Json::object())).at("message"),
              "playAnimation: changes nothing: needs playing, seconds, speed or loop");
}

TEST_F(Animations, PlayToTheEndForEverybodyAsOneStepOfUndo) {
    begin();
    JsonViewer other(daemon_->port());
    (void)other.join();
    const Json answer = play("door", {{"playing", true}});
    ASSERT_TRUE(answer.contains("animationChanged")) << answer;
    EXPECT_TRUE(answer.at("animationChanged").at("state").at("playing").get<bool>());
    EXPECT_TRUE(other.next_with("animationChanged")
                    .at("animationChanged")
                    .at("state")
                    .at("playing")
                    .get<bool>());
    const Json own = step_of(*viewer_, door_, true);
    const Json others = step_of(other, door_, true);
    EXPECT_EQ(own, others);
    EXPECT_NEAR(turn_of(own.at("moveObject").at("transform")), 100.0, 1e-3);
    EXPECT_EQ(own.at("animation").at("firstEpoch"), 1);
    EXPECT_NEAR(turn_of(own.at("objectBefore").at("transform")), 0.0, 1e-3);
    EXPECT_EQ(state_now("door").at("seconds"), 2);
    const Json changes =
        viewer_->request({{"listChanges", Json::object()}}).at("changeHistory").at("changes");
    ASSERT_EQ(changes.size(), 2U) << changes;  // door and handle
    EXPECT_EQ(changes.at(0).at("firstEpoch"), 1);
    EXPECT_EQ(changes.at(1).at("firstEpoch"), 1);
    EXPECT_TRUE(viewer_->request({{"undo", {{"epoch", 0}}}}).contains("ok"));
    EXPECT_NEAR(turn_now(), 0.0, 1e-3);
    EXPECT_EQ(state_now("door").at("seconds"), 0);
}

TEST_F(Animations, StandWhereTheyStoodAfterARestart) {
    begin();
    ASSERT_TRUE(play("door", {{"seconds", 1.5}}).contains("animationChanged"));
    step_of(*viewer_, door_, true);
    Json pin = {{"requestKey", "pin-1"},
                {"addPin", {{"text", "glare"}, {"position", {{"x", 0}, {"y", 0}, {"z", 0}}}}}};
    Json saved = {{"requestKey", "scene-1"}, {"saveLightingScene", {{"name", "evening"}}}};
    Json played = {{"requestKey", "play-1"},
                   {"playAnimation", {{"animation", "handle"}, {"seconds", 0.5}}}};
    const Json number = viewer_->request(pin).at("pinChanged").at("pin");
    ASSERT_TRUE(viewer_->request(saved).contains("lightingSceneChanged"));
    ASSERT_TRUE(viewer_->request(played).contains("animationChanged"));
    EXPECT_EQ(viewer_->request(pin).at("pinChanged").at("pin"), number);
    restart();
    EXPECT_NEAR(turn_now(), 75.0, 1e-3);
    EXPECT_EQ(named(scene_.at("animations"), "door").at("state").at("seconds"), 1.5);
    // The handle turns where the door is.
    ASSERT_TRUE(play("handle", {{"seconds", 1}}).contains("animationChanged"));
    const int handle = named(scene_.at("objects"), "handle").at("id");
    const Json at =
        step_of(*viewer_, handle, true).at("moveObject").at("transform").at("translation");
    EXPECT_TRUE(viewer_->request({{"undo", {{"epoch", 0}}}}).contains("ok"));
    const Json closed =
        named(scene_now().at("objects"), "handle").at("transform").at("translation");
    EXPECT_NE(at, closed);
    EXPECT_NEAR(turn_now(), 0.0, 1e-3);
    // What is asked for again is not done again.
    EXPECT_EQ(viewer_->request(pin).at("pinChanged").at("pin"), number);
    EXPECT_TRUE(viewer_->request({{"removePin", {{"pin", number}}}}).contains("pinChanged"));
    EXPECT_TRUE(viewer_->request(pin).at("pinChanged").at("removed").get<bool>());
    EXPECT_TRUE(viewer_->request({{"removeLightingScene", {{"name", "evening"}}}})
                    .contains("lightingSceneChanged"));
    EXPECT_TRUE(viewer_->request(saved).at("lightingSceneChanged").at("removed").get<bool>());
    EXPECT_TRUE(scene_now().at("lightingScenes").empty());
    ASSERT_TRUE(play("handle", {{"seconds", 0.25}}).contains("animationChanged"));
    EXPECT_EQ(viewer_->request(played).at("animationChanged").at("state").at("seconds"), 0.25);
}

TEST_F(Animations, AHandTakesWhatPlays) {
    begin();
    ASSERT_TRUE(play("door", {{"playing", true}, {"loop", true}}).contains("animationChanged"));
    step_of(*viewer_, door_, false);
    const Json moved = viewer_->request(
        {{"moveObject", {{"object", door_}, {"transform", {{"translation", {{"x", 2.0}}}}}}}});
    ASSERT_TRUE(moved.contains("sceneChanged")) << moved;
    const Json state = state_now("door");
    EXPECT_FALSE(state.at("playing").get<bool>());
    EXPECT_TRUE(state.at("loop").get<bool>());
    EXPECT_EQ(named(scene_now().at("objects"), "door").at("transform").at("translation").at("x"),
              2);
}

TEST_F(Animations, LightsAndMaterialsFollow) {
    begin();
    ASSERT_TRUE(play("desk lamp", {{"seconds", 1}}).contains("animationChanged"));
    const Json light = viewer_->next_with("sceneChanged").at("sceneChanged").at("setLight");
    EXPECT_NEAR(light.at("intensity").get<double>(), 50.0, 1e-3);
    EXPECT_NEAR(light.at("position").at("z").get<double>(), 1.5, 1e-5);
    ASSERT_TRUE(play("paint", {{"seconds", 1.25}}).contains("animationChanged"));
    const Json paint = viewer_->next_with("sceneChanged").at("sceneChanged").at("setMaterial");
    EXPECT_NEAR(paint.at("baseColour").at("z").get<double>(), 0.6, 1e-6);
}

/// The light of the opened door, against paths from the same points of the final scene; and of
/// the closed one again.
TEST_F(Animations, LightComesToRestWithTheDoor) {
    begin();
    const auto look = [this](double error) {
        viewer_->request({{"setTarget", {{"relativeError", error}}}});
        viewer_->next([&](const Json& message) {
            return message.value("solution", Json::object()).value("relativeError", 1.0) <= error;
        });
    };
    // The floor of the dark room, straight from above.
    viewer_->request({{"setCamera",
                       {{"eye", {{"x", 4.0}, {"y", 2.3}, {"z", 1.5}}},
                        {"target", {{"x", 4.0}, {"y", 0.0}, {"z", 1.5}}},
                        {"up", {{"x", 0.0}, {"y", 0.0}, {"z", -1.0}}}}}});
    viewer_->request(
        {{"setLight",
          {{"light", named(scene_.at("lights"), "desk lamp").at("id")}, {"on", false}}}});
    const auto probe = [this] {
        return viewer_->request({{"probe", {{"pixel", {{"x", 32.0}, {"y", 24.0}}}}}})
            .at("probeResult");
    };
    ASSERT_TRUE(play("door", {{"playing", true}, {"speed", 20}}).contains("animationChanged"));
    step_of(*viewer_, door_, true);
    look(0.02);
    const Json served = probe();
    const Json point = served.at("position");
    const Json paths = viewer_->request(
        {{"measure",
          {{"quantity", "HORIZONTAL"},
           {"points",
            Json::array(
                {{{"position", {{"x", point.at("x")}, {"y", 0.001}, {"z", point.at("z")}}}}})},
           {"relativeError", 0.02}}}});
    ASSERT_TRUE(paths.contains("measured")) << paths;
    const Json& right = paths.at("measured").at("points").at(0);
    const double open = served.at("illuminance").get<double>();
    const double noise = 2.0 * served.at("relativeError").get<double>() * open;
    EXPECT_GT(open + noise, right.at("low").get<double>());
    EXPECT_LT(open - noise, right.at("high").get<double>());
    EXPECT_GT(right.at("low").get<double>(), 1.0);
    ASSERT_TRUE(play("door", {{"playing", true}, {"speed", -20}}).contains("animationChanged"));
    step_of(*viewer_, door_, true);
    // Nothing but the door's gap lets light in; how fast it falls is the changes' tests' matter.
    double closed = open;
    for (int look_again = 0; look_again < 200 && closed > 0.2 * open; ++look_again) {
        viewer_->next_frame([](const Json&) { return true; });
        closed = probe().at("illuminance").get<double>();
    }
    EXPECT_LT(closed, 0.2 * open);
}

}  // namespace
}  // namespace raybundle
