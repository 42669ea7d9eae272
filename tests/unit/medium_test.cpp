// SPDX-License-Identifier: Apache-2.0
// Air of a scene: what files say of it, and its numbers.
#include "scene/medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf_builder.h"
#include "scene/effects/effects_plan.h"

namespace raybundle::test {
namespace {

Scene scene_with_air(const Json& air) {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}});
    builder.json["scenes"][0]["extras"]["raybundle"]["air"] = air;
    return builder.load();
}

std::string refusal_of_air(const Json& air) {
    try {
        (void)scene_with_air(air);
    } catch (const SceneError& error) {
        return error.what();
    }
    return {};
}

TEST(Medium, SceneFilesAskForIt) {
    const Scene fog = scene_with_air({{"visibility", 50}, {"albedo", 0.9}, {"anisotropy", 0.6}});
    ASSERT_TRUE(fog.medium);
    EXPECT_NEAR(fog.medium->extinction, std::log(50.0) / 50.0, 1e-12);
    EXPECT_NEAR(fog.medium->left_after(50.0), 0.02, 1e-12);
    EXPECT_EQ(fog.medium->albedo, glm::vec3(0.9F));
    EXPECT_EQ(fog.medium->anisotropy, 0.6);
    const Scene smoke = scene_with_air({{"extinction", 0.5}, {"albedo", {0.2, 0.3, 0.4}}});
    ASSERT_TRUE(smoke.medium);
    EXPECT_EQ(smoke.medium->extinction, 0.5);
    EXPECT_EQ(smoke.medium->albedo, glm::vec3(0.2F, 0.3F, 0.4F));
    GltfBuilder clear;
    clear.add_node({{"mesh", clear.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}});
    EXPECT_FALSE(clear.load().medium);
}

TEST(Medium, NonsenseIsRejected) {
    EXPECT_NE(refusal_of_air(5).find("extras.raybundle.air"), std::string::npos);
    EXPECT_NE(refusal_of_air(Json::object()).find("one of visibility"), std::string::npos);
    EXPECT_NE(refusal_of_air({{"visibility", 50}, {"extinction", 1}}).find("one of"),
              std::string::npos);
    EXPECT_NE(refusal_of_air({{"visibility", 0}}).find("visibility: must be"), std::string::npos);
    EXPECT_NE(refusal_of_air({{"extinction", -1}}).find("visibility: must be"), std::string::npos);
    EXPECT_NE(refusal_of_air({{"visibility", "far"}}).find("air.visibility"), std::string::npos);
    EXPECT_NE(refusal_of_air({{"visibility", 50}, {"albedo", 1.5}}).find("albedo"),
              std::string::npos);
    EXPECT_NE(refusal_of_air({{"visibility", 50}, {"albedo", {1, 2}}}).find("air.albedo"),
              std::string::npos);
    EXPECT_NE(refusal_of_air({{"visibility", 50}, {"anisotropy", 1}}).find("anisotropy"),
              std::string::npos);
}

TEST(Medium, WaysAreThoseWithinTheBox) {
    const glm::dvec3 low(0.0);
    const glm::dvec3 high(2.0, 3.0, 4.0);
    const double endless = std::numeric_limits<double>::infinity();
    EXPECT_EQ(way_in_box(low, high, {1, 1, 1}, {1, 0, 0}, endless).length(), 1.0);
    EXPECT_EQ(way_in_box(low, high, {1, 1, 1}, {1, 0, 0}, 0.5).length(), 0.5);
    EXPECT_EQ(way_in_box(low, high, {-1, 1, 1}, {1, 0, 0}, endless).begin, 1.0);
    EXPECT_EQ(way_in_box(low, high, {-1, 1, 1}, {1, 0, 0}, endless).length(), 2.0);
    EXPECT_EQ(way_in_box(low, high, {-1, 1, 1}, {-1, 0, 0}, endless).length(), 0.0);
    EXPECT_EQ(way_in_box(low, high, {-1, 4, 1}, {1, 0, 0}, endless).length(), 0.0);
}

TEST(Medium, IsAnEffectWithABound) {
    const auto medium_of = [](const Scene& scene) { return plan_effects(scene, 1).effects.back(); };
    const Effect fog = medium_of(scene_with_air({{"visibility", 50}}));
    EXPECT_EQ(fog.name, "medium");
    EXPECT_TRUE(fog.active);
    EXPECT_NEAR(fog.share_bound, 1.0 - std::exp(-std::log(50.0) / 50.0 * std::sqrt(2.0)), 1e-6);
    EXPECT_GT(fog.bytes_per_patch, 0U);
    Scene clear = scene_with_air({{"visibility", 50}});
    clear.medium.reset();
    EXPECT_FALSE(medium_of(clear).active);
    EXPECT_EQ(medium_of(clear).share_bound, 0.0);
    EXPECT_EQ(medium_of(clear).bytes_per_patch, 0U);
}

}  // namespace
}  // namespace raybundle::test
