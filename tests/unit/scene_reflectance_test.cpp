// SPDX-License-Identifier: Apache-2.0
// What a file says about specular reflection: KHR_materials_specular and our max-Phong extras.
#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <utility>

#include "gltf_builder.h"
#include "scene/material/brdf.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle::test {
namespace {

Scene load_with(const Json& material) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh(
        {{"attributes", {{"POSITION", builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}},
         {"indices", builder.add_indices({0, 1, 2})},
         {"material", builder.add_material(material)}});
    builder.add_node({{"mesh", mesh}});
    return builder.load();
}

Json with_max_phong(const Json& specular, const Json& exponent) {
    return {{"extras",
             {{"raybundle", {{"maxPhong", {{"specular", specular}, {"exponent", exponent}}}}}}}};
}

TEST(SceneReflectance, SpecularColourIsRead) {
    const Scene scene =
        load_with({{"extensions",
                    {{"KHR_materials_specular",
                      {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0.5, 2}}}}}}});
    EXPECT_FLOAT_EQ(scene.materials[0].specular, 0.5F);
    EXPECT_EQ(scene.materials[0].specular_colour, glm::vec3(1.0F, 0.5F, 2.0F));
    EXPECT_FALSE(scene.materials[0].max_phong.has_value());
}

TEST(SceneReflectance, MaxPhongIsRead) {
    Json material = with_max_phong({0.45, 0.4, 0.3}, 28);
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {0.3, 0.3, 0.4, 1}}};
    const Scene scene = load_with(material);
    ASSERT_TRUE(scene.materials[0].max_phong.has_value());
    EXPECT_EQ(scene.materials[0].max_phong->specular, glm::vec3(0.45F, 0.4F, 0.3F));
    EXPECT_FLOAT_EQ(scene.materials[0].max_phong->exponent, 28.0F);
    const Brdf brdf = make_brdf(scene.materials[0], scene.materials[0].base_colour);
    EXPECT_EQ(brdf.lobe.kind, LobeKind::max_phong);
    EXPECT_EQ(brdf.lambert, glm::vec3(0.3F, 0.3F, 0.4F));  // whatever the metallic factor says
}

TEST(SceneReflectance, ExtrasOfOthersAreLeftAlone) {
    for (const Json& extras :
         {Json("a note"), Json(3), Json{{"maxPhong", 1}}, Json{{"raybundle", "of another kind"}},
          Json{{"raybundle", {{"other", 1}}}}, Json::array({1, 2})}) {
        const Scene scene = load_with({{"extras", extras}});
        EXPECT_FALSE(scene.materials[0].max_phong.has_value()) << extras.dump();
    }
}

struct MaxPhongFault {
    const char* name;
    std::function<void(Json& max_phong)> inject;
    const char* json_path;  // below maxPhong
    const char* reason;
};

void PrintTo(const MaxPhongFault& fault, std::ostream* out) {
    *out << fault.name;
}

class MaxPhongRejection : public testing::TestWithParam<MaxPhongFault> {};

TEST_P(MaxPhongRejection, NamesThePlaceAndTheReason) {
    Json material = with_max_phong({0.1, 0.2, 0.3}, 10);
    GetParam().inject(material["extras"]["raybundle"]["maxPhong"]);
    try {
        load_with(material);
        FAIL() << "was accepted";
    } catch (const SceneError& error) {
        EXPECT_EQ(error.json_path(),
                  std::string("materials[0].extras.raybundle.maxPhong") + GetParam().json_path);
        EXPECT_NE(error.reason().find(GetParam().reason), std::string::npos) << error.what();
    }
}

const MaxPhongFault max_phong_faults[] = {
    {"type", [](Json& j) { j = 3; }, "", "must be an object"},
    {"null", [](Json& j) { j = nullptr; }, "", "must be an object"},
    {"empty", [](Json& j) { j = Json::object(); }, ".specular", "is missing"},
    {"specular_missing", [](Json& j) { j.erase("specular"); }, ".specular", "is missing"},
    {"exponent_missing", [](Json& j) { j.erase("exponent"); }, ".exponent", "is missing"},
    {"specular_type", [](Json& j) { j["specular"] = 0.5; }, ".specular", "array of 3"},
    {"specular_length",
     [](Json& j) {
         j["specular"] = {0.1, 0.2};
     },
     ".specular", "array of 3"},
    {"specular_text", [](Json& j) { j["specular"][1] = "x"; }, ".specular[1]", "must be a number"},
    {"specular_range", [](Json& j) { j["specular"][2] = 1.5; }, ".specular[2]", "not in [0, 1]"},
    {"specular_negative", [](Json& j) { j["specular"][0] = -1; }, ".specular[0]", "not in"},
    {"exponent_type", [](Json& j) { j["exponent"] = "sharp"; }, ".exponent", "must be a number"},
    {"exponent_low", [](Json& j) { j["exponent"] = 0; }, ".exponent", "not in [1, 1000]"},
    {"exponent_high", [](Json& j) { j["exponent"] = 1e5; }, ".exponent", "not in [1, 1000]"},
};

INSTANTIATE_TEST_SUITE_P(Faults, MaxPhongRejection, testing::ValuesIn(max_phong_faults),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SceneReflectance, SpecularColourIsChecked) {
    for (const Json& bad : {Json(1), Json{1, 2}, Json{1, -1, 0}}) {
        const auto load = [&] {
            load_with(
                {{"extensions", {{"KHR_materials_specular", {{"specularColorFactor", bad}}}}}});
        };
        EXPECT_THROW(load(), SceneError) << bad.dump();
    }
}

TEST(SceneReflectance, MeanBaseColourIsThatOfTheWholeTexture) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh(
        {{"attributes",
          {{"POSITION", builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})},
           {"TEXCOORD_0", builder.add_uvs({{0, 0}, {1, 0}, {0, 1}})}}},
         {"indices", builder.add_indices({0, 1, 2})},
         {"material", builder.add_material({{"pbrMetallicRoughness",
                                             {{"baseColorFactor", {1, 0.5, 0.25, 1}},
                                              {"baseColorTexture", {{"index", 0}}}}}})}});
    builder.add_node({{"mesh", mesh}});
    builder.json["images"] = {
        {{"bufferView", builder.add_view(png(2, 1, {255, 255, 255, 255, 0, 0, 0, 255}))},
         {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    const Scene scene = builder.load();
    const glm::vec3 mean = mean_base_colour(scene, scene.materials[0]);
    EXPECT_NEAR(mean.r, 0.5F, 0.02F);
    EXPECT_NEAR(mean.b, 0.125F, 0.005F);
    Material plain;
    plain.base_colour = {0.1F, 0.2F, 0.3F};
    EXPECT_EQ(mean_base_colour(scene, plain), plain.base_colour);
}

/// ((n - 1)/(n + 1))^2: water 0.02, glass 0.04, diamond 0.172; an index of 0 stands for an infinite
/// one.
TEST(SceneReflectance, IndexOfRefractionGivesTheReflectance) {
    for (const auto& [ior, f0] : {std::pair(1.333F, 0.0204F), std::pair(1.5F, 0.04F),
                                  std::pair(2.417F, 0.172F), std::pair(0.0F, 1.0F)}) {
        const Scene scene = load_with({{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                                       {"extensions", {{"KHR_materials_ior", {{"ior", ior}}}}}});
        const Brdf brdf = make_brdf(scene.materials[0], glm::vec3(0.5F));
        EXPECT_NEAR(brdf.f0.g, f0, 4e-3F * f0 + 1e-4F) << ior;
    }
}

TEST(SceneReflectance, SpecularGlossinessStatesItsReflectance) {
    const Scene scene = load_with({{"extensions",
                                    {{"KHR_materials_pbrSpecularGlossiness",
                                      {{"diffuseFactor", {0, 0, 0, 1}},
                                       {"specularFactor", {0.9, 0.6, 0.2}},
                                       {"glossinessFactor", 0.7}}}}}});
    const Brdf brdf = make_brdf(scene.materials[0], scene.materials[0].base_colour);
    EXPECT_LT(glm::distance(brdf.f0, glm::vec3(0.9F, 0.6F, 0.2F)), 5e-3F);
    EXPECT_NEAR(scene.materials[0].roughness, 0.3F, 1e-6F);
}

}  // namespace
}  // namespace raybundle::test
