// SPDX-License-Identifier: Apache-2.0
// What lighting designers do with the lights of a scene: place, aim, group, dim, and save how all
// of them are set.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"
#include "session/changes/lighting_scenes.h"
#include "test_folder.h"

namespace raybundle {
namespace {

using std::numbers::pi;

const std::string five_lamps = RAYBUNDLE_ROOT "/tests/cases/lights/lamps.gltf";

Json scene_of(const Json& welcome) {
    return welcome.at("welcome").at("scene");
}

Json light_in(const Json& scene, const std::string& name) {
    for (const Json& light : scene.at("lights")) {
        if (light.at("name") == name) {
            return light;
        }
    }
    return {};
}

/// Whether something comes true. False: only what hangs takes so long.
bool eventually(const std::function<bool()>& true_now) {
    for (int i = 0; i < 3000; ++i) {
        if (true_now()) {
            return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

/// A viewer of the five lamps over a floor; looks straight down from 1.9 m at z = 2.
class Lighting : public testing::Test {
  protected:
    void begin() {
        daemon_.emplace(five_lamps,
                        std::vector<std::string>{"--journal", folder_.path("session.db")});
        viewer_.emplace(daemon_->port());
        scene_ = scene_of(viewer_->join("", 65, 65));
    }
    /// Ends the server and starts it again.
    void restart() {
        viewer_.reset();
        EXPECT_EQ(daemon_->end(), 0);
        begin();
    }
    Json scene_now() {
        JsonViewer other(daemon_->port());
        return scene_of(other.join());
    }
    Json light_now(const std::string& name) { return light_in(scene_now(), name); }
    Json set(const std::string& name, Json fields) {
        fields["light"] = light_in(scene_, name).at("id");
        return viewer_->request({{"setLight", fields}});
    }
    Json ask(const char* what, const Json& body) { return viewer_->request({{what, body}}); }

    const TestFolder folder_;
    std::optional<Daemon> daemon_;
    std::optional<JsonViewer> viewer_;
    Json scene_;
};

/// 1000 cd and E = I / h², at another height and place; aimed away no light comes straight down.
TEST_F(Lighting, LuminaireIsPlacedAndAimed) {
    begin();
    for (const Json& light : scene_.at("lights")) {
        if (light.at("name") != "downlight") {
            viewer_->request({{"setLight", {{"light", light.at("id")}, {"on", false}}}});
        }
    }
    const auto below = [&](double x, double z) {
        ask("setCamera", {{"eye", {{"x", x}, {"y", 0.9}, {"z", z}}},
                          {"target", {{"x", x}, {"y", 0.0}, {"z", z}}},
                          {"up", {{"x", 0.0}, {"y", 0.0}, {"z", -1.0}}}});
        return ask("probe", {{"pixel", {{"x", 32.5}, {"y", 32.5}}}})
            .at("probeResult")
            .at("illuminance")
            .get<double>();
    };
    const Json made = set(
        "downlight", {{"flux", 1000.0 * pi}, {"position", {{"x", 0.5}, {"y", 1.0}, {"z", -0.5}}}});
    ASSERT_TRUE(made.contains("sceneChanged")) << made;
    EXPECT_NEAR(made.at("sceneChanged").at("setLight").at("intensity").get<double>(), 1000.0 * pi,
                1.0);
    EXPECT_NEAR(below(0.5, -0.5), 1000.0, 10.0);
    EXPECT_EQ(light_now("downlight").at("position"), Json({{"x", 0.5}, {"y", 1.0}, {"z", -0.5}}));
    // It is set so at once, and shown on its way; the newer setting wins.
    ASSERT_TRUE(set("downlight", {{"dim", 0.0}, {"fadeSeconds", 60.0}}).contains("sceneChanged"));
    EXPECT_GT(below(0.5, -0.5), 0.0);
    EXPECT_EQ(light_now("downlight").at("dim"), 0.0);
    EXPECT_EQ(scene_now().at("fades").at(0).at("light"), light_in(scene_, "downlight").at("id"));
    ASSERT_TRUE(eventually([&] { return below(0.5, -0.5) < 990.0; }));
    ASSERT_TRUE(set("downlight", {{"dim", 1.0}}).contains("sceneChanged"));
    EXPECT_NEAR(below(0.5, -0.5), 1000.0, 10.0);
    ASSERT_TRUE(set("downlight", {{"dim", 0.5}, {"fadeSeconds", 0.2}}).contains("sceneChanged"));
    ASSERT_TRUE(eventually([&] { return scene_now().value("fades", Json::array()).empty(); }));
    ASSERT_TRUE(eventually([&] { return std::abs(below(0.5, -0.5) - 500.0) < 5.0; }));
    set("downlight", {{"dim", 1.0}});
    ASSERT_TRUE(
        set("downlight", {{"aim", {{"x", 1.0}, {"y", 0.0}, {"z", 0.0}}}}).contains("sceneChanged"));
    EXPECT_NEAR(below(0.5, -0.5), 0.0, 5.0);
    EXPECT_NEAR(light_now("downlight").at("aim").at("x").get<double>(), 1.0, 1e-6);
    EXPECT_TRUE(ask("undo", {{"epoch", 0}}).contains("ok"));
    const Json home = light_now("downlight");
    EXPECT_NEAR(home.at("position").at("y").get<double>(), 2.0, 1e-6);
    EXPECT_NEAR(home.at("aim").at("y").get<double>(), -1.0, 1e-6);
}

TEST_F(Lighting, SaysWhyALightCannotBePlaced) {
    begin();
    const Json aim = {{"aim", {{"x", 1.0}}}};
    const auto problem = [this](const std::string& name, const Json& fields) {
        return set(name, fields).at("error").at("message").get<std::string>();
    };
    EXPECT_NE(problem("panel", aim).find("is a surface"), std::string::npos);
    EXPECT_NE(problem("sun", {{"position", {{"x", 1.0}}}}).find("no position"), std::string::npos);
    EXPECT_NE(problem("sun", {{"flux", 100.0}}).find("setLight.flux: "), std::string::npos);
    EXPECT_EQ(problem("sun", {{"aim", {{"x", 1.0}}}, {"on", true}, {"fadeSeconds", 1.0}})
                  .find("setLight.fadeSeconds: "),
              0U);
    EXPECT_NE(problem("bulb", {{"outerCone", 20.0}}).find("only spots have cones"),
              std::string::npos);
}

TEST_F(Lighting, GroupIsDimmedAndSwitchedAsOne) {
    begin();
    const auto number = [this](const char* name) { return light_in(scene_, name).at("id"); };
    ASSERT_TRUE(set("bulb", {{"group", "desks"}}).contains("sceneChanged"));
    ASSERT_TRUE(
        ask("setGroup", {{"group", "desks"}, {"lights", {number("panel")}}}).contains("ok"));
    EXPECT_EQ(ask("setGroup", {{"group", "desks"}, {"lights", {99}}}).at("error").at("message"),
              "setGroup.lights: light: no light 99");
    EXPECT_EQ(
        scene_now().at("groups"),
        Json::array({{{"name", "desks"},
                      {"lights",
                       {light_in(scene_, "panel").at("id"), light_in(scene_, "bulb").at("id")}}}}));
    const Json answer = ask("setGroup", {{"group", "desks"}, {"dim", 0.5}, {"on", true}});
    ASSERT_TRUE(answer.contains("ok")) << answer;
    EXPECT_FLOAT_EQ(light_now("bulb").at("dim").get<float>(), 0.5F);
    EXPECT_FLOAT_EQ(light_now("panel").at("dim").get<float>(), 0.5F);
    EXPECT_EQ(light_now("panel").at("intensity"), light_in(scene_, "panel").at("intensity"));
    EXPECT_FLOAT_EQ(light_now("spot").at("dim").get<float>(), 1.0F);
    EXPECT_EQ(ask("setGroup", {{"group", "wall"}, {"on", false}}).at("error").at("code"),
              "NOT_FOUND");
    ASSERT_TRUE(ask("undo", {{"epoch", 2}}).contains("ok"));
    EXPECT_FLOAT_EQ(light_now("bulb").at("dim").get<float>(), 1.0F);
}

TEST_F(Lighting, ScenesComeBackAfterARestart) {
    begin();
    set("bulb", {{"dim", 0.25}});
    set("spot", {{"on", false}});
    const Json saved = ask("saveLightingScene", {{"name", "presentation"}});
    ASSERT_TRUE(saved.contains("lightingSceneChanged")) << saved;
    set("bulb", {{"dim", 1.0}});
    set("spot", {{"on", true}});
    set("spot", {{"position", {{"x", 1.0}, {"y", 2.0}, {"z", 0.0}}}});
    restart();
    EXPECT_EQ(scene_.at("lightingScenes").at(0).at("name"), "presentation");
    const Json applied = ask("applyLightingScene", {{"name", "presentation"}});
    ASSERT_TRUE(applied.contains("ok")) << applied;
    EXPECT_FLOAT_EQ(light_now("bulb").at("dim").get<float>(), 0.25F);
    EXPECT_EQ(light_now("spot").at("on"), false);
    EXPECT_EQ(light_now("spot").at("position").at("x"), 1.0);  // a scene of light moves nothing
    EXPECT_EQ(ask("applyLightingScene", {{"name", "cleaning"}}).at("error").at("code"),
              "NOT_FOUND");
    EXPECT_TRUE(ask("removeLightingScene", {{"name", "presentation"}})
                    .at("lightingSceneChanged")
                    .at("removed"));
    EXPECT_TRUE(scene_now().value("lightingScenes", Json::array()).empty());
}

/// The floor has the illuminance of the sky and of the sun that `sceneChanged` states, in a scene
/// that was opened without either; by night it has none.
TEST_F(Lighting, HeavyDaylightComesByTheClockAndGoes) {
    begin();
    for (const Json& light : scene_.at("lights")) {
        viewer_->request({{"setLight", {{"light", light.at("id")}, {"on", false}}}});
    }
    ask("setCamera", {{"eye", {{"x", 1.0}, {"y", 2.5}, {"z", 1.0}}},
                      {"target", {{"x", 1.0}, {"y", 0.0}, {"z", 1.0}}},
                      {"up", {{"x", 0.0}, {"y", 0.0}, {"z", -1.0}}}});
    const auto floor_lux = [&] {
        viewer_->next([](const Json& message) {
            return message.contains("solution") && message["solution"].value("iterations", 0) > 0 &&
                   message["solution"].value("settled", 0.0) > 0.9;
        });
        return ask("probe", {{"pixel", {{"x", 32.5}, {"y", 32.5}}}})
            .at("probeResult")
            .at("illuminance")
            .get<double>();
    };
    const Json berlin = {{"latitude", 52.52}, {"longitude", 13.4}};
    EXPECT_EQ(ask("setDaylight", {{"time", "2026-06-21T15:00:00+02:00"}}).at("error").at("code"),
              "INVALID_ARGUMENT");
    const Json day =
        ask("setDaylight",
            {{"sky", "clear"}, {"place", berlin}, {"time", "2026-06-21T15:00:00+02:00"}});
    ASSERT_TRUE(day.contains("sceneChanged")) << day;
    const Json& told = day.at("sceneChanged").at("setDaylight");
    EXPECT_NEAR(told.at("sunElevation").get<double>(), 55.0, 1.5);
    const Json sun = light_in(told, "sun");
    const Json sky = light_in(told, "sky");
    EXPECT_EQ(sun.at("id"), 6);
    EXPECT_EQ(sky.at("id"), 7);
    const double sine = std::sin(told.at("sunElevation").get<double>() * pi / 180.0);
    const double exact =
        sky.at("intensity").get<double>() + sine * sun.at("intensity").get<double>();
    EXPECT_GT(exact, 50'000.0);
    EXPECT_NEAR(floor_lux(), exact, 0.03 * exact);
    ask("setLight", {{"light", 6}, {"on", false}});
    const Json night = ask("setDaylight", {{"time", "2026-06-21T23:30:00+02:00"}});
    EXPECT_LT(night.at("sceneChanged").at("setDaylight").at("sunElevation").get<double>(), 0.0);
    EXPECT_EQ(scene_now().at("daylight").at("place"), berlin);
    restart();
    EXPECT_EQ(scene_.at("daylight").at("time"), "2026-06-21T23:30:00+02:00");
    const auto sky_sun = [](const Json& scene) { return scene.at("lights").at(5); };
    EXPECT_EQ(sky_sun(scene_).at("intensity"), 0.0);
    // Back to the afternoon without its sun, then to the scene as it was opened.
    ASSERT_TRUE(ask("undo", {{"epoch", 7}}).contains("ok"));
    EXPECT_EQ(sky_sun(scene_now()).at("on"), false);
    EXPECT_NEAR(sky_sun(scene_now()).at("intensity").get<double>(),
                sun.at("intensity").get<double>(), 1.0);
    ASSERT_TRUE(ask("undo", {{"epoch", 5}}).contains("ok"));
    EXPECT_EQ(scene_now().at("daylight").at("sky"), "loaded");
    EXPECT_EQ(light_now("sky").at("intensity"), 0.0);
}

TEST(LightingScenes, AreBoundedAndReplacedByName) {
    ChangeLog log;
    LightingScenes scenes(log);
    Scene scene;
    scene.lights.resize(1);
    scene.lights[0].material = 0;
    scene.lights[0].radiance = glm::vec3(5.0F);
    scene.materials.resize(1);
    ASSERT_TRUE(scenes.save("a", "who", scene));
    EXPECT_TRUE(scenes.changes_to("a", scene)->empty());
    scene.lights[0].on = false;
    ASSERT_EQ(scenes.changes_to("a", scene)->size(), 1U);
    EXPECT_TRUE(scenes.changes_to("a", scene)->front().set_light().on());
    ASSERT_TRUE(scenes.save("a", "who", scene));
    EXPECT_TRUE(scenes.changes_to("a", scene)->empty());
    EXPECT_FALSE(scenes.changes_to("b", scene).has_value());
    for (std::size_t i = 1; i < LightingScenes::max_scenes; ++i) {
        ASSERT_TRUE(scenes.save(std::to_string(i), "who", scene));
    }
    EXPECT_FALSE(scenes.save("one too many", "who", scene));
    EXPECT_EQ(scenes.refusal().code(), v1::Error::RESOURCE_EXHAUSTED);
    EXPECT_TRUE(scenes.save("a", "who", scene));
    // Saved by day, applied by night: the sun stays where the day has it.
    PunctualLight sun;
    sun.kind = PunctualKind::directional;
    sun.of_sky = true;
    sun.intensity = glm::vec3(9e4F);
    scene.punctual_lights.push_back(sun);
    ASSERT_TRUE(scenes.save("a", "who", scene));
    scene.punctual_lights[0].intensity = glm::vec3(0.0F);
    EXPECT_TRUE(scenes.changes_to("a", scene)->empty());
    EXPECT_FALSE(scenes.remove("c"));
    EXPECT_EQ(scenes.refusal().code(), v1::Error::NOT_FOUND);
}

}  // namespace
}  // namespace raybundle
