// SPDX-License-Identifier: Apache-2.0
#include "scene/animation_script.h"

#include <gtest/gtest.h>

namespace raybundle {
namespace {

Scene room() {
    Scene scene;
    Object fixed;
    fixed.id = 1;
    fixed.name = "room";
    Object box;
    box.id = 2;
    box.name = "box";
    box.movable = true;
    box.transform.translation = {1.0F, 0.0F, 0.0F};
    scene.objects = {fixed, box};
    Material wall;
    wall.name = "wall";
    Material lamp;
    lamp.name = "lamp";
    lamp.emission = glm::vec3(100.0F);
    scene.materials = {wall, lamp};
    Light light;
    light.id = 1;
    light.name = "ceiling";
    light.material = 1;
    light.radiance = lamp.emission;
    scene.lights = {light};
    return scene;
}

AnimationScript read(const std::string& text) {
    return {text, "move.json", room(), Camera()};
}

std::string refusal(const std::string& text) {
    try {
        read(text);
    } catch (const ScriptError& error) {
        return error.what();
    }
    return {};
}

TEST(AnimationScript, MovesEvenlyFromWhereThingsAre) {
    const AnimationScript script = read(R"({"framesPerSecond": 10, "frames": 21, "keys": [
        {"time": 2, "object": "box", "translation": [3, 0, 0], "rotation": [0, 1, 0, 1]},
        {"time": 0, "camera": {"eye": [0, 0, 5], "target": [0, 0, 0]}},
        {"time": 1, "camera": {"eye": [2, 0, 5]}}]})");
    EXPECT_EQ(script.frames(), 21U);
    EXPECT_DOUBLE_EQ(script.time_of(20), 2.0);
    ASSERT_EQ(script.moving_objects(), std::vector<std::uint32_t>{1});
    EXPECT_EQ(script.transform_at(1, 0.0).translation.x, 1.0F);
    EXPECT_EQ(script.transform_at(1, 1.0).translation.x, 2.0F);
    EXPECT_EQ(script.transform_at(1, 9.0).translation.x, 3.0F);
    // Half of a quarter turn.
    EXPECT_NEAR(glm::degrees(glm::angle(script.transform_at(1, 1.0).rotation)), 45.0F, 1e-3F);
    EXPECT_EQ(script.camera_at(0.5).eye.x, 1.0F);
    EXPECT_EQ(script.camera_at(5.0).eye.x, 2.0F);
    EXPECT_EQ(script.camera_at(1.0).target.z, 0.0F);
}

TEST(AnimationScript, LightsAndMaterialsChangeAtTheirTime) {
    const AnimationScript script = read(R"({"frames": 2, "keys": [
        {"time": 0, "light": "ceiling", "intensity": 5},
        {"time": 1, "light": 1, "on": false, "colour": [1, 0, 0]},
        {"time": 1, "material": "wall", "baseColour": [0.2, 0.5, 0.2], "roughness": 0.4}]})");
    ASSERT_EQ(script.lights_between(-1.0, 0.0).size(), 1U);
    EXPECT_EQ(script.lights_between(-1.0, 0.0)[0].intensity, 5.0F);
    EXPECT_TRUE(script.lights_between(0.0, 0.99).empty());
    const auto later = script.lights_between(0.0, 1.0);
    ASSERT_EQ(later.size(), 1U);
    EXPECT_EQ(later[0].on, false);
    EXPECT_FALSE(later[0].intensity.has_value());
    const auto materials = script.materials_between(0.5, 1.5);
    ASSERT_EQ(materials.size(), 1U);
    EXPECT_EQ(materials[0].material, 1U);
    EXPECT_EQ(materials[0].base_colour->g, 0.5F);
    EXPECT_EQ(materials[0].roughness, 0.4F);
}

TEST(AnimationScript, SaysFilePathAndReasonOfWhatItRefuses) {
    const auto expect = [](const std::string& text, const std::string& part) {
        const std::string reason = refusal(text);
        EXPECT_EQ(reason.rfind("move.json: ", 0), 0U) << text;
        EXPECT_NE(reason.find(part), std::string::npos) << reason;
    };
    const auto key = [](const std::string& body) {
        return R"({"frames": 2, "keys": [{"time": 0, "light": 1}, )" + body + "]}";
    };
    expect("{", "parse error");
    expect("[]", "the script: must be an object");
    expect(R"({"keys": []})", "needs \"frames\"");
    expect(R"({"frames": 1.5, "keys": []})", "frames: must be a whole number");
    expect(R"({"frames": 0, "keys": []})", "frames: must be a number from 1");
    expect(R"({"frames": 1})", "needs \"keys\"");
    expect(R"({"frames": 1, "keys": [], "fps": 3})", "fps: is not known here");
    expect(key(R"(3)"), "keys[1]: must be an object with a \"time\"");
    expect(key(R"({"time": -1, "light": 1})"), "keys[1].time: must be a number from 0");
    expect(key(R"({"time": 1})"), "keys[1]: needs one of camera, object, light, material");
    expect(key(R"({"time": 1, "light": 1, "object": 2})"), "keys[1]: needs one of");
    expect(key(R"({"time": 1, "object": "boz"})"), "keys[1].object: \"boz\" is not in the scene");
    expect(key(R"({"time": 1, "object": 1})"), "keys[1].object: cannot be moved");
    expect(key(R"({"time": 1, "object": 2, "scale": [1, 0, 1]})"),
           "keys[1].scale: must not be zero");
    expect(key(R"({"time": 1, "object": 2, "rotation": [0, 0, 0, 0]})"),
           "keys[1].rotation: must not be zero");
    expect(key(R"({"time": 1, "object": 2, "translation": [1, 2]})"),
           "keys[1].translation: must be an array of 3 numbers");
    expect(key(R"({"time": 1, "object": 2, "translation": [1, "x", 2]})"),
           "keys[1].translation[1]: must be a number");
    expect(key(R"({"time": 1, "light": 1, "intensity": -3})"), "keys[1].intensity: must be");
    expect(key(R"({"time": 1, "light": 1, "colour": [0, 0, 0]})"),
           "keys[1].colour: must not be black");
    expect(key(R"({"time": 1, "light": 1, "on": 1})"), "keys[1].on: must be true or false");
    expect(key(R"({"time": 1, "material": 9})"), "keys[1].material: 9 is not in the scene");
    expect(key(R"({"time": 1, "material": 1, "metallic": 2})"), "keys[1].metallic: must be");
    expect(key(R"({"time": 1, "camera": {"eye": [0, 0, 0], "target": [0, 0, 0]}})"),
           "keys[1].camera: target must differ from eye");
    expect(key(R"({"time": 1, "camera": {"eye": [0, 5, 0], "target": [0, 0, 0]}})"),
           "keys[1].camera: up must not lie");
    EXPECT_EQ(refusal(key(R"({"time": 1, "light": 1})")), "");
}

TEST(AnimationScript, FilesAreNumbered) {
    EXPECT_EQ(numbered_file("a/frame_%04d.png", 7), "a/frame_0007.png");
    EXPECT_EQ(numbered_file("f%d.exr", 12), "f12.exr");
    for (const char* bad : {"frame.png", "%s.png", "%04d_%d.png", "%", "%0", "%04", "%00d.png"}) {
        EXPECT_THROW(numbered_file(bad, 1), ScriptError) << bad;
    }
}

}  // namespace
}  // namespace raybundle
