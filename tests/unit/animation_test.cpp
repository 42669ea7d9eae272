// SPDX-License-Identifier: Apache-2.0
// Animations of glTF files: interpolation, what they move, and what is wrong with them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <sstream>

#include "gltf_builder.h"
#include "scene/animation/scene_animations.h"
#include "scene/animation_script.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene_report.h"

namespace raybundle::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(KeyTrack, LinearIsStraightAndStandsOutside) {
    const KeyTrack track{Interpolation::linear, 3, {1.0F, 3.0F}, {0, 0, 0, 2, 4, -6}};
    EXPECT_EQ(glm::vec3(track.at(0.0)), glm::vec3(0.0F));
    EXPECT_EQ(glm::vec3(track.at(1.5)), glm::vec3(0.5F, 1.0F, -1.5F));
    EXPECT_EQ(glm::vec3(track.at(9.0)), glm::vec3(2.0F, 4.0F, -6.0F));
}

TEST(KeyTrack, StepHoldsUntilTheNextKey) {
    const KeyTrack track{Interpolation::step, 1, {0.0F, 1.0F, 2.0F}, {5, 6, 7}};
    EXPECT_EQ(track.at(0.999).x, 5.0F);
    EXPECT_EQ(track.at(1.0).x, 6.0F);
    EXPECT_EQ(track.at(1.999).x, 6.0F);
    EXPECT_EQ(track.at(2.0).x, 7.0F);
}

/// A Hermite spline is exact of cubics: x = t³ - 2 t has the slopes 3 t² - 2.
TEST(KeyTrack, SplineIsExactOfACubic) {
    const auto x = [](double t) { return t * t * t - 2.0 * t; };
    const auto slope = [](double t) { return static_cast<float>(3.0 * t * t - 2.0); };
    KeyTrack track{Interpolation::cubic_spline, 1, {0.5F, 2.0F, 2.5F}, {}};
    for (const float t : track.times) {
        track.values.insert(track.values.end(), {slope(t), static_cast<float>(x(t)), slope(t)});
    }
    for (double t = 0.5; t <= 2.5; t += 0.1) {
        EXPECT_NEAR(track.at(t).x, x(t), 1e-5) << t;
    }
}

/// Spherical: the angle grows evenly, on the shorter way, whatever the signs of the keys.
TEST(KeyTrack, RotationTurnsEvenlyOnTheShorterWay) {
    const float half = glm::radians(30.0F);  // of 60 degrees about y
    const KeyTrack track{Interpolation::linear,
                         4,
                         {0.0F, 1.0F},
                         {0, 0, 0, 2, 0, -std::sin(half), 0, -std::cos(half)}};
    for (double t = 0.0; t <= 1.0; t += 0.125) {
        const glm::quat turned = track.rotation_at(t);
        EXPECT_NEAR(std::remainder(glm::degrees(2.0F * std::atan2(turned.y, turned.w)), 360.0F),
                    60.0 * t, 1e-3);
        EXPECT_NEAR(glm::length(turned), 1.0F, 1e-6F);
    }
}

/// A room's floor, and boxes on it that something moves.
class AnimatedFile : public testing::Test {
  protected:
    AnimatedFile() {
        builder.json["scenes"][0]["nodes"] = Json::array();
        builder.json["nodes"] = Json::array();
        builder.add_node(
            {{"name", "floor"}, {"mesh", builder.add_box_mesh({-9, -1, -9}, {9, 0, 9})}});
        box = builder.add_box_mesh({0, 0, 0}, {1, 1, 1});
    }

    int floats(const std::vector<float>& values, const char* type, std::size_t components) {
        return builder.add_accessor(builder.add_view_of(values), 5126, values.size() / components,
                                    type);
    }
    Json sampler(const std::vector<float>& times, const std::vector<float>& values,
                 const char* type, std::size_t components, const char* how = "LINEAR") {
        return {{"input", floats(times, "SCALAR", 1)},
                {"output", floats(values, type, components)},
                {"interpolation", how}};
    }
    static Json channel(int sampler, int node, const char* path) {
        return {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
    }
    static Json pointer(int sampler, const std::string& to) {
        return {{"sampler", sampler},
                {"target",
                 {{"path", "pointer"},
                  {"extensions", {{"KHR_animation_pointer", {{"pointer", to}}}}}}}};
    }
    void animate(const char* name, const Json& samplers, const Json& channels) {
        builder.json["animations"].push_back(
            {{"name", name}, {"samplers", samplers}, {"channels", channels}});
    }
    /// A box that slides along x from 0 to 2 m in 2 s; `what` is then changed by the test.
    Json& sliding_box() {
        const int node = builder.add_node({{"name", "box"}, {"mesh", box}});
        animate("slide", Json::array({sampler({0, 2}, {0, 0, 0, 2, 0, 0}, "VEC3", 3)}),
                Json::array({channel(0, node, "translation")}));
        return builder.json["animations"][0];
    }
    void expect_left_out(const std::string& reason) {
        const Scene scene = builder.load();
        EXPECT_EQ(scene.animations, nullptr) << reason;
        EXPECT_TRUE(has_notice(scene, reason)) << reason;
        EXPECT_TRUE(has_notice(scene, "the animation is left out")) << reason;
    }
    static const Object& object(const Scene& scene, const std::string& name) {
        for (const Object& one : scene.objects) {
            if (one.name == name) {
                return one;
            }
        }
        throw std::out_of_range(name);
    }
    /// Where a point of an object is while animations stand so.
    static glm::vec3 placed(const Scene& scene, const std::string& name, const glm::vec3& point,
                            const std::vector<AnimationPlace>& places) {
        const Object& moved = object(scene, name);
        for (const auto& [index, transform] : object_places(scene, places)) {
            if (index == moved.id - 1) {
                return moved.world_from_parent * transform.matrix() * glm::vec4(point, 1.0F);
            }
        }
        ADD_FAILURE() << name << " is not moved";
        return {};
    }
    static void expect_near(const glm::vec3& a, const glm::vec3& b) {
        EXPECT_LT(glm::length(a - b), 1e-4F) << a.x << ' ' << a.y << ' ' << a.z;
    }

    GltfBuilder builder;
    int box = 0;
};

TEST_F(AnimatedFile, MovesAnObject) {
    sliding_box();
    const Scene scene = builder.load();
    ASSERT_NE(scene.animations, nullptr);
    const Animation& slide = scene.animations->animations.at(0);
    EXPECT_EQ(slide.name, "slide");
    EXPECT_EQ(slide.seconds, 2.0);
    EXPECT_EQ(slide.objects, std::vector<std::uint32_t>{object(scene, "box").id - 1});
    EXPECT_TRUE(object(scene, "box").movable);
    EXPECT_EQ(placed(scene, "box", {}, {{0, 0.5}}), glm::vec3(0.5F, 0.0F, 0.0F));
}

/// A door that turns about its hinge, 1 m from the middle of a table that goes up; its handle turns
/// by itself. Nested pieces are apart, and move with what carries them.
TEST_F(AnimatedFile, ChildrenMoveWithParents) {
    const int handle =
        builder.add_node({{"name", "handle"}, {"mesh", box}, {"translation", {0, 0, 1}}}, false);
    const int door = builder.add_node(
        {{"name", "door"}, {"mesh", box}, {"translation", {1, 0, 0}}, {"children", {handle}}},
        false);
    const int table = builder.add_node(
        {{"name", "table"}, {"mesh", box}, {"translation", {0, 1, 0}}, {"children", {door}}});
    const float s = std::sqrt(0.5F);
    animate("lift", Json::array({sampler({0, 1}, {0, 1, 0, 0, 3, 0}, "VEC3", 3)}),
            Json::array({channel(0, table, "translation")}));
    animate("door", Json::array({sampler({0, 1}, {0, 0, 0, 1, 0, s, 0, s}, "VEC4", 4)}),
            Json::array({channel(0, door, "rotation")}));
    animate("handle", Json::array({sampler({0, 1}, {0, 0, 1, 0, 0, 2}, "VEC3", 3)}),
            Json::array({channel(0, handle, "translation")}));
    const Scene scene = builder.load();
    ASSERT_NE(scene.animations, nullptr);
    EXPECT_EQ(scene.objects.size(), 4U);
    EXPECT_EQ(scene.animations->animations[0].objects.size(), 3U);
    EXPECT_EQ(scene.animations->animations[1].objects.size(), 2U);
    EXPECT_EQ(scene.animations->animations[2].objects.size(), 1U);
    const glm::vec3 corner(0.0F, 0.0F, 1.0F);
    expect_near(placed(scene, "handle", corner, {{0, 1.0}}), {1.0F, 3.0F, 2.0F});
    // A quarter turn about y takes z to x.
    expect_near(placed(scene, "handle", corner, {{1, 1.0}}), {3.0F, 1.0F, 0.0F});
    // What the others have moved stays moved.
    expect_near(placed(scene, "handle", corner, {{0, 1.0}, {1, 1.0}, {2, 1.0}}),
                {4.0F, 3.0F, 0.0F});
    expect_near(placed(scene, "door", corner, {{2, 1.0}, {0, 0.5}, {1, 1.0}}), {2.0F, 2.0F, 0.0F});
}

/// The animated node is one above the object's own, mirrored and scaled; its parent is turned.
TEST_F(AnimatedFile, GroupsCarryObjectsWithTheirOwnPlaces) {
    const int left = builder.add_node(
        {{"name", "left"}, {"mesh", box}, {"translation", {8, 0, 0}}, {"scale", {2, 1, 1}}}, false);
    const int right =
        builder.add_node({{"name", "right"}, {"mesh", box}, {"translation", {-8, 0, 0}}}, false);
    const int group = builder.add_node({{"children", {left, right}}}, false);
    const float s = std::sqrt(0.5F);
    builder.add_node({{"children", {group}}, {"rotation", {0, s, 0, s}}});
    animate("grow", Json::array({sampler({0, 1}, {1, 1, 1, -0.5, 1, 1}, "VEC3", 3)}),
            Json::array({channel(0, group, "scale")}));
    const Scene scene = builder.load();
    ASSERT_NE(scene.animations, nullptr);
    // (x, y, z) turned by 90 degrees about y is (z, y, -x).
    expect_near(placed(scene, "left", {1, 1, 1}, {{0, 1.0}}), {1.0F, 1.0F, 0.5F * 10.0F});
    expect_near(placed(scene, "right", {1, 1, 1}, {{0, 1.0}}), {1.0F, 1.0F, 0.5F * -7.0F});
}

TEST_F(AnimatedFile, UnitsAndFarCoordinatesCount) {
    const int node =
        builder.add_node({{"name", "far"}, {"mesh", box}, {"translation", {1000000, 0, 0}}});
    builder.json["nodes"][0]["translation"] = {1000000, 0, 0};
    animate("slide", Json::array({sampler({0, 1}, {1000000, 0, 0, 1000100, 0, 0}, "VEC3", 3)}),
            Json::array({channel(0, node, "translation")}));
    SceneSettings settings;
    settings.metres_per_unit = 0.01F;
    const Scene scene = builder.load(settings);
    ASSERT_NE(scene.animations, nullptr);
    const Object& far = object(scene, "far");
    const glm::vec3 begun = far.world_from_object() * glm::vec4(0, 0, 0, 1);
    expect_near(placed(scene, "far", {}, {{0, 0.0}}), begun);
    expect_near(placed(scene, "far", {}, {{0, 1.0}}), begun + glm::vec3(1.0F, 0.0F, 0.0F));
}

TEST_F(AnimatedFile, LightsAreCarriedDimmedAndColoured) {
    builder.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_animation_pointer"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 100}, {"color", {1, 0.5, 0.25}}}};
    const int node = builder.add_node({{"name", "lamp"},
                                       {"translation", {0, 2, 0}},
                                       {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const std::string light = "/extensions/KHR_lights_punctual/lights/0/";
    animate("swing",
            Json::array({sampler({0, 1}, {0, 2, 0, 1, 2, 0}, "VEC3", 3),
                         sampler({0, 1}, {100, 0}, "SCALAR", 1),
                         sampler({0, 1}, {1, 0.5, 0.25, 1, 1, 1}, "VEC3", 3)}),
            Json::array({channel(0, node, "translation"), pointer(1, light + "intensity"),
                         pointer(2, light + "color"), pointer(1, light + "range")}));
    const Scene scene = builder.load();
    ASSERT_NE(scene.animations, nullptr);
    EXPECT_TRUE(has_notice(scene, "animated, but left as it is: " + light + "range"));
    ASSERT_EQ(scene.animations->animations[0].lights, std::vector<std::uint32_t>{1});
    const std::vector<AnimationPlace> half{{0, 0.5}};
    const LightEdit edit = light_edits(scene, half).at(0);
    expect_near(*edit.position, {0.5F, 2.0F, 0.0F});
    const glm::vec3 colour(1.0F, 0.75F, 0.625F);
    EXPECT_NEAR(*edit.intensity, 50.0F * luminance(colour), 1e-3F);
    expect_near(*edit.colour, colour);
}

TEST_F(AnimatedFile, MaterialsChangeColourAndEmission) {
    builder.json["extensionsUsed"] = {"KHR_animation_pointer"};
    const int lamp = builder.add_material({{"name", "lamp"}, {"emissiveFactor", {1, 1, 0.5}}});
    builder.json["meshes"][static_cast<std::size_t>(box)]["primitives"][0]["material"] = lamp;
    builder.add_node({{"name", "box"}, {"mesh", box}});
    animate("glow",
            Json::array({sampler({0, 1}, {1, 1, 1, 1, 0, 0.5, 1, 1}, "VEC4", 4),
                         sampler({0, 1}, {1, 1, 0.5, 0, 0, 0}, "VEC3", 3, "STEP")}),
            Json::array({pointer(0, "/materials/0/pbrMetallicRoughness/baseColorFactor"),
                         pointer(1, "/materials/0/emissiveFactor")}));
    const Scene scene = builder.load();
    ASSERT_NE(scene.animations, nullptr);
    const std::vector<AnimationPlace> half{{0, 0.5}};
    expect_near(*material_edits(scene, half).at(0).base_colour, {0.5F, 0.75F, 1.0F});
    EXPECT_NEAR(*light_edits(scene, half).at(0).intensity, luminance({1.0F, 1.0F, 0.5F}), 1e-5F);
    const std::vector<AnimationPlace> end{{0, 1.0}};
    EXPECT_EQ(*light_edits(scene, end).at(0).intensity, 0.0F);
}

TEST_F(AnimatedFile, MalformedOnesAreLeftOutWithPlaceAndReason) {
    const auto wrong = [this](const std::vector<float>& times, const std::vector<float>& values,
                              const char* type, std::size_t n, const char* path,
                              const std::string& reason, const char* how = "LINEAR") {
        sliding_box();
        builder.json["animations"] = Json::array();
        animate("bad", Json::array({sampler(times, values, type, n, how)}),
                Json::array({channel(0, 1, path)}));
        expect_left_out(reason);
    };
    wrong({0, 2, 2}, {0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3", 3, "translation",
          "animations[0].samplers[0].input: key 1 is at 2 s and key 2 at 2 s: times must grow");
    wrong({-1, 2}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, "translation", "times must be 0..86400 s");
    wrong({0, nan}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, "translation", "element 1 is NaN or infinite");
    wrong({0, 1}, {0, 0, 0, nan, 0, 0}, "VEC3", 3, "translation", "element 1 is NaN or infinite");
    wrong({0, 1}, {0, 0, 0}, "VEC3", 3, "translation", "has 1 elements, 2 keys need 2");
    wrong({0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, "translation", "2 keys need 6", "CUBICSPLINE");
    wrong({0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, "rotation", "has 3 components, 4 are expected");
    wrong({0, 1}, {0, 0, 0, 0, 0, 0, 0, 1}, "VEC4", 4, "rotation", "element 0 is zero");
    wrong({0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, "colour", "target.path: 'colour' is none of");
    wrong({0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, "translation", "is none of LINEAR", "SMOOTH");
}

TEST_F(AnimatedFile, BrokenReferencesAreLeftOut) {
    const Json good = sliding_box();
    const auto wrong = [this, &good](const char* at, const Json& value, const std::string& reason) {
        builder.json["animations"][0] = good;
        builder.json["animations"][0][Json::json_pointer(at)] = value;
        expect_left_out(reason);
    };
    wrong("/channels/0/sampler", 3, "animations[0].channels[0].sampler: 3 is out of range");
    wrong("/channels/0/sampler", -1, "animations[0].channels[0].sampler: must be an index");
    wrong("/channels/0/target/node", 77, "target.node: 77 is out of range, there are 2");
    wrong("/channels/0/target", 5, "animations[0].channels[0].target: must be an object");
    wrong("/samplers/0/input", 99, "animations[0].samplers[0].input: 99 is out of range");
    wrong("/samplers/0", "x", "animations[0].samplers[0]: must be an object");
    wrong("/channels", Json::array(), "animations[0].channels: must be an array that is not empty");
    wrong("/name", 5, "animations[0].name: must be a string");
}

TEST_F(AnimatedFile, OneThatIsWrongLeavesTheOthers) {
    sliding_box();
    builder.json["animations"].push_back(builder.json["animations"][0]);
    builder.json["animations"][0]["channels"][0]["sampler"] = 9;
    const Scene scene = builder.load();
    ASSERT_NE(scene.animations, nullptr);
    EXPECT_EQ(scene.animations->animations.size(), 1U);
    EXPECT_EQ(scene.animations->animations[0].name, "slide (2)");
}

/// What `extras.movable` makes a whole stays one; its parts do not move apart.
TEST_F(AnimatedFile, WhatMovesAsAWholeStaysWhole) {
    const int wheel = builder.add_node({{"name", "wheel"}, {"mesh", box}}, false);
    builder.add_node(
        {{"name", "cart"}, {"mesh", box}, {"children", {wheel}}, {"extras", {{"movable", true}}}});
    animate("roll", Json::array({sampler({0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", 3)}),
            Json::array({channel(0, wheel, "translation")}));
    const Scene scene = builder.load();
    EXPECT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.animations, nullptr);
    EXPECT_TRUE(has_notice(scene, "1 animated nodes move nothing by themselves"));
    EXPECT_TRUE(has_notice(scene, "animation 'roll' moves nothing that can be moved"));
}

/// Animated to nothing: as small as can be moved, and back.
TEST_F(AnimatedFile, NothingIsScaledToNothing) {
    const int node = builder.add_node({{"name", "box"}, {"mesh", box}});
    animate("vanish", Json::array({sampler({0, 1}, {1, 1, 1, 0, 0, 0}, "VEC3", 3)}),
            Json::array({channel(0, node, "scale")}));
    const Scene scene = builder.load();
    ASSERT_NE(scene.animations, nullptr);
    const std::vector<AnimationPlace> end{{0, 1.0}};
    EXPECT_EQ(object_places(scene, end).at(0).second.scale, glm::vec3(1e-6F));
}

/// `render --script` plays them: from 1 s on at double speed, round and round.
TEST_F(AnimatedFile, ScriptsPlayThem) {
    sliding_box();
    const Scene scene = builder.load();
    const AnimationScript script(R"({"framesPerSecond": 2, "frames": 8, "keys": [
        {"time": 1, "animation": "slide", "seconds": 0.5, "speed": 2, "loop": true},
        {"time": 3, "animation": 1, "speed": 0}]})",
                                 "move.json", scene, Camera());
    const auto x = [&](double time) {
        return script.playback()
            .objects_at(scene, time)
            .at(object(scene, "box").id - 1)
            .translation.x;
    };
    EXPECT_EQ(script.playback().objects(scene).size(), 1U);
    EXPECT_TRUE(script.playback().objects_at(scene, 0.5).empty());
    EXPECT_FLOAT_EQ(x(1.0), 0.5F);
    EXPECT_FLOAT_EQ(x(1.5), 1.5F);
    EXPECT_FLOAT_EQ(x(2.0), 0.5F);
    EXPECT_FLOAT_EQ(x(3.0), 0.5F);
    EXPECT_FLOAT_EQ(x(9.0), 0.5F);
    const auto refusal = [&scene](const std::string& keys) -> std::string {
        try {
            AnimationScript(R"({"frames": 1, "keys": [)" + keys + "]}", "move.json", scene,
                            Camera());
        } catch (const ScriptError& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(refusal(R"({"time": 0, "animation": "dance"})"),
              R"(move.json: keys[0].animation: "dance" is not in the scene; there are: slide)");
    EXPECT_EQ(refusal(R"({"time": 0, "animation": "slide"},
                         {"time": 1, "object": "box", "translation": [0, 1, 0]})"),
              "move.json: keys: object 'box' has keys, and an animation moves it");
}

TEST_F(AnimatedFile, InspectListsThem) {
    sliding_box();
    Scene scene = builder.load();
    const PatchMesh mesh = tessellate(scene, {});
    const SceneReport report = make_scene_report(scene, mesh);
    std::ostringstream text;
    print_scene_report(text, scene, report);
    EXPECT_NE(text.str().find("animations  1\n       slide  2 s  box\n"), std::string::npos)
        << text.str();
    EXPECT_EQ(scene_report_json(scene, report).at("animations").at(0).at("seconds"), 2.0);
}

}  // namespace
}  // namespace raybundle::test
