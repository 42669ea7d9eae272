// SPDX-License-Identifier: Apache-2.0
// What effects cost, measured for a viewer while the scene is served, and by `inspect --costs`.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "daemon.h"
#include "json_viewer.h"

namespace raybundle {
namespace {

TEST(EffectCosts, HeavyAreMeasuredBesideTheSceneWhichGoesOnAfterwards) {
    Daemon daemon(scene_file("effects/overcast_sky.gltf"));
    JsonViewer viewer(daemon.port());
    viewer.join();
    for (int i = 0; i < 2; ++i) {
        const Json answer = viewer.request({{"measureEffects", Json::object()}});
        ASSERT_TRUE(answer.contains("effectCosts")) << answer.dump();
        bool sky = false;
        for (const Json& effect : answer.at("effectCosts").at("effects")) {
            const std::string name = effect.at("name");
            EXPECT_EQ(effect.contains("msPerIteration"), effect.at("active").get<bool>()) << name;
            if (name == "diffuse") {
                EXPECT_GT(effect.at("msPerIteration").get<double>(), 0.0);
            }
            sky = sky || (name == "sky" && effect.at("active").get<bool>());
        }
        EXPECT_TRUE(sky);
    }
    const Json camera = {{"id", 77},
                         {"setCamera",
                          {{"eye", {{"x", 0.5}, {"y", 1.5}, {"z", 0.5}}},
                           {"target", {{"x", 1}, {"y", 1}, {"z", 1}}}}}};
    viewer.send(camera);
    const Json frame =
        viewer.next_frame([](const Json& header) { return header.at("cameraId") == 77; });
    EXPECT_FALSE(frame.empty()) << "no pictures after it";
    EXPECT_EQ(daemon.end(), 0);
}

TEST(EffectCosts, DoNotHoldUpTheEnd) {
    Daemon daemon(scene_file("effects/overcast_sky.gltf"));
    JsonViewer viewer(daemon.port());
    viewer.join();
    viewer.send({{"id", 5}, {"measureEffects", Json::object()}});
    viewer.send({{"id", 6}, {"measureEffects", Json::object()}});
    EXPECT_EQ(viewer.answer_to(6).at("error").at("code"), "RESOURCE_EXHAUSTED");
    EXPECT_EQ(daemon.end(), 0);
}

Json inspected(const std::string& arguments) {
    const std::string command = std::string(RAYBUNDLE_EXECUTABLE) +
                                " inspect --json --log-level off '" +
                                scene_file("effects/overcast_sky.gltf") + "' " + arguments;
    std::FILE* const pipe = popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> part{};
    while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe)) {
        text.append(part.data(), count);
    }
    EXPECT_EQ(pclose(pipe), 0);
    return Json::parse(text, nullptr, false);
}

TEST(EffectCosts, AreMeasuredByInspectOnlyWhenAskedFor) {
    for (const bool asked : {false, true}) {
        const Json report = inspected(asked ? "--costs" : "");
        ASSERT_TRUE(report.is_object());
        for (const Json& effect : report.at("effects")) {
            const bool measured = asked && effect.at("active").get<bool>();
            EXPECT_EQ(effect.at("msPerIteration").is_null(), !measured) << effect;
        }
    }
}

}  // namespace
}  // namespace raybundle
