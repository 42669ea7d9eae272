// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/effects_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "gltf_builder.h"
#include "scene/effects/effect_removal.h"

namespace raybundle::test {
namespace {

GltfBuilder triangle_of(const Json& material) {
    GltfBuilder builder;
    const int positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int mesh = builder.add_mesh(
        {{"attributes", {{"POSITION", positions}}}, {"material", builder.add_material(material)}});
    builder.add_node({{"mesh", mesh}});
    return builder;
}

const Json lambert = {{"name", "chalk"},
                      {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                      {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}};

const Effect& effect_of(const EffectsPlan& plan, std::string_view name) {
    for (const Effect& effect : plan.effects) {
        if (effect.name == name) {
            return effect;
        }
    }
    ADD_FAILURE() << name;
    return plan.effects.front();
}

TEST(EffectsPlan, NamesAllEffectsAndTheirReasons) {
    const EffectsPlan plan = plan_effects(triangle_of(lambert).load(), 7);
    const nlohmann::json json = effects_plan_json(plan);
    EXPECT_EQ(json["patches"], 7);
    std::vector<std::string> names;
    for (const auto& effect : json["effects"]) {
        names.push_back(effect["name"]);
        EXPECT_EQ(effect.size(), 7U);
        EXPECT_FALSE(effect["reason"].get<std::string>().empty());
        EXPECT_FALSE(effect["pathClass"].get<std::string>().empty());
        EXPECT_GE(effect["shareBound"], 0.0);
        EXPECT_LE(effect["shareBound"], 1.0);
        EXPECT_TRUE(effect["msPerIteration"].is_null());
        if (!effect["active"].get<bool>()) {
            EXPECT_EQ(effect["bytesPerPatch"], 0);
            EXPECT_EQ(effect["shareBound"], 0.0);
        }
    }
    EXPECT_EQ(names, (std::vector<std::string>{
                         "diffuse", "glossy", "specular-reflection", "refraction", "caustics",
                         "clear-coat", "diffuse-transmission", "textures", "normal-maps",
                         "punctual-lights", "ies", "sky", "sun", "environment", "medium"}));
}

TEST(EffectsPlan, ActivatesWhatTheSceneCallsFor) {
    // Nothing emits: a sky is set.
    const EffectsPlan plain = plan_effects(triangle_of(lambert).load(), 1);
    EXPECT_FALSE(effect_of(plain, "glossy").active);
    EXPECT_TRUE(effect_of(plain, "sky").active);
    EXPECT_EQ(effect_of(plain, "sky").share_bound, 1.0);
    EXPECT_EQ(plain.bytes_per_patch, effect_of(plain, "diffuse").bytes_per_patch);

    GltfBuilder builder = triangle_of({{"name", "metal"}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "point"}, {"intensity", 100}}});
    builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const EffectsPlan lit = plan_effects(builder.load(), 1);
    EXPECT_TRUE(effect_of(lit, "glossy").active);
    EXPECT_TRUE(effect_of(lit, "punctual-lights").active);
    EXPECT_EQ(effect_of(lit, "punctual-lights").share_bound, 1.0);
    EXPECT_FALSE(effect_of(lit, "ies").active);
    EXPECT_FALSE(effect_of(lit, "sky").active);
    EXPECT_EQ(lit.bytes_per_patch, plain.bytes_per_patch +
                                       effect_of(lit, "glossy").bytes_per_patch +
                                       effect_of(lit, "punctual-lights").bytes_per_patch);
}

TEST(EffectsPlan, ActiveEffectsCanBeTakenOut) {
    GltfBuilder builder = triangle_of({{"name", "metal"}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "point"}, {"intensity", 100}}});
    builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    SceneSettings settings;
    settings.sky_luminance = 10.0F;
    Scene scene = builder.load(settings);
    PatchMesh mesh = tessellate(scene);
    const EffectsPlan before = plan_effects(scene, 1);
    for (const char* name : {"glossy", "punctual-lights", "sky"}) {
        EXPECT_TRUE(effect_of(before, name).active);
        EXPECT_TRUE(remove_effect(name, scene, mesh));
        EXPECT_FALSE(effect_of(plan_effects(scene, 1), name).active) << name;
    }
    EXPECT_FALSE(remove_effect("diffuse", scene, mesh));
}

/// A small mirror far from a lamp gets little of its light: what a sphere of its size there covers
/// of all directions, and no less.
Scene lamp_and_mirror(float distance) {
    GltfBuilder builder =
        triangle_of({{"name", "mirror"},
                     {"pbrMetallicRoughness", {{"metallicFactor", 1}, {"roughnessFactor", 0}}}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "point"}, {"intensity", 100}}});
    builder.add_node({{"translation", {0.5, 0.5, distance}},
                      {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return builder.load();
}

TEST(EffectsPlan, BoundsCausticsByWhatLampsAimAtMirrors) {
    const double radius2 = 0.5;  // of the sphere round the triangle's box, squared
    for (const float distance : {2.0F, 10.0F, 100.0F}) {
        const double sine2 = radius2 / static_cast<double>(distance * distance);
        const double share = 0.5 * (1.0 - std::sqrt(1.0 - sine2));
        const Effect found = effect_of(plan_effects(lamp_and_mirror(distance), 1), "caustics");
        EXPECT_TRUE(found.active);
        EXPECT_NEAR(found.share_bound, share, 2e-3 * share) << distance;  // reflectance 0.999
    }
    EXPECT_NEAR(effect_of(plan_effects(lamp_and_mirror(0.1F), 1), "caustics").share_bound, 1.0,
                2e-3);
}

/// What other surfaces reflect counts by the areas, and all of the sky's light.
TEST(EffectsPlan, BoundsCausticsByReflectedLightAndSkies) {
    Scene scene = lamp_and_mirror(10.0F);
    const double lamp = effect_of(plan_effects(scene, 1), "caustics").share_bound;
    scene.materials.emplace_back();
    Triangle other = scene.triangles.front();
    other.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    scene.triangles.insert(scene.triangles.end(), 4, other);
    EXPECT_NEAR(effect_of(plan_effects(scene, 1), "caustics").share_bound, lamp + 0.25, 1e-3);

    Scene outdoors = lamp_and_mirror(10.0F);
    outdoors.punctual_lights.clear();
    EXPECT_FALSE(effect_of(plan_effects(outdoors, 1), "caustics").active);
    outdoors.sky_radiance = glm::vec3(1.0F);
    EXPECT_TRUE(effect_of(plan_effects(outdoors, 1), "caustics").active);
    EXPECT_NEAR(effect_of(plan_effects(outdoors, 1), "caustics").share_bound, 1.0, 2e-3);
}

TEST(EffectsPlan, SkipsCausticsBelowATenthOfTheAccuracy) {
    const Scene scene = lamp_and_mirror(10.0F);
    const double bound = effect_of(plan_effects(scene, 1), "caustics").share_bound;
    EXPECT_TRUE(is_active(plan_effects(scene, 1, 9.9 * bound), "caustics"));
    const EffectsPlan plan = plan_effects(scene, 1, 10.1 * bound);
    const Effect& skipped = effect_of(plan, "caustics");
    EXPECT_FALSE(skipped.active);
    EXPECT_EQ(skipped.share_bound, bound);
    EXPECT_EQ(skipped.bytes_per_patch, 0U);
    EXPECT_NE(skipped.reason.find("skipped"), std::string::npos) << skipped.reason;
}

}  // namespace
}  // namespace raybundle::test
