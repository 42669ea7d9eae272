// SPDX-License-Identifier: Apache-2.0
// Lights and the sky.
#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::test {
namespace {

/// Two triangles of one emitting material, in two nodes.
GltfBuilder two_lamps(const Json& material) {
    GltfBuilder builder;
    const int mesh =
        builder.add_mesh({{"attributes", {{"POSITION", builder.add_positions(unit_triangle)}}},
                          {"material", builder.add_material(material)}});
    builder.add_node({{"mesh", mesh}, {"name", "lamp"}});
    builder.add_node({{"mesh", mesh}, {"name", "second lamp"}, {"translation", {0, 0, 5}}});
    return builder;
}

TEST(SceneLighting, OneLightForEachEmittingMaterial) {
    const Scene scene =
        two_lamps(
            {{"name", "ceiling"},
             {"emissiveFactor", {1, 1, 1}},
             {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1500}}}}}})
            .load();
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].id, 1U);
    EXPECT_EQ(scene.lights[0].name, "ceiling");
    EXPECT_EQ(scene.lights[0].material, 0);
    EXPECT_LT(glm::distance(scene.lights[0].radiance, glm::vec3(1500)), 1e-2F);
    EXPECT_EQ(scene.sky_radiance, glm::vec3(0));
}

TEST(SceneLighting, UnnamedMaterialsLendTheNameOfTheirObject) {
    const Scene scene = two_lamps({{"emissiveFactor", {1, 0, 0}}}).load();
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].name, "lamp");
}

TEST(SceneLighting, ScenesWithoutEmitterGetASky) {
    GltfBuilder builder = two_lamps({{"name", "dark"}});
    const Scene scene = builder.load();
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_EQ(scene.sky_radiance, glm::vec3(1000));
    EXPECT_TRUE(has_notice(scene, "uniform sky of 1000 cd/m²"));
    SceneSettings settings;
    settings.sky_luminance = 0.0F;
    EXPECT_EQ(builder.load(settings).sky_radiance, glm::vec3(0));
    settings.sky_luminance = 300.0F;
    EXPECT_EQ(builder.load(settings).sky_radiance, glm::vec3(300));
}

/// A file with these punctual lights, each on a node of its own above the origin.
GltfBuilder with_lights(const Json& lights) {
    GltfBuilder builder = two_lamps({{"name", "dark"}});
    builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        builder.add_node({{"name", "lamp " + std::to_string(i)},
                          {"translation", {0, 2, 0}},
                          {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    return builder;
}

TEST(SceneLighting, PunctualLightsAreReadInTheirUnits) {
    const Scene scene =
        with_lights({{{"type", "point"}, {"intensity", 80}, {"color", {1, 0.5, 0.25}}},
                     {{"type", "spot"},
                      {"intensity", 20},
                      {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}},
                     {{"type", "directional"}, {"intensity", 50'000}},
                     {{"type", "point"}, {"intensity", 0}}})
            .load();
    ASSERT_EQ(scene.punctual_lights.size(), 4U);  // the dark one can be switched on
    EXPECT_EQ(scene.sky_radiance, glm::vec3(0));
    EXPECT_TRUE(scene.notices.empty() || !has_notice(scene, "KHR_lights_punctual"));
    EXPECT_EQ(scene.punctual_lights[0].intensity, glm::vec3(80, 40, 20));
    EXPECT_EQ(scene.punctual_lights[0].name, "lamp 0");
    EXPECT_EQ(scene.punctual_lights[1].kind, PunctualKind::spot);
    EXPECT_NEAR(scene.punctual_lights[1].inner_cosine, std::cos(0.2F), 1e-6F);
    EXPECT_NEAR(scene.punctual_lights[1].outer_cosine, std::cos(0.5F), 1e-6F);
    EXPECT_EQ(scene.punctual_lights[2].kind, PunctualKind::directional);
    const PlacedLight placed = place_light(scene, scene.punctual_lights[1]);
    EXPECT_NEAR(glm::distance(placed.position, glm::dvec3(0, 2, 0)), 0.0, 1e-6);
    EXPECT_NEAR(glm::distance(placed.direction(), glm::dvec3(0, 0, -1)), 0.0, 1e-6);
}

TEST(SceneLighting, LengthsOfTheFileDoNotChangeIntensities) {
    SceneSettings settings;
    settings.metres_per_unit = 0.01F;
    const Scene scene =
        with_lights(Json::array({{{"type", "point"}, {"intensity", 80}}})).load(settings);
    ASSERT_EQ(scene.punctual_lights.size(), 1U);
    EXPECT_EQ(scene.punctual_lights[0].intensity, glm::vec3(80));
    const PlacedLight placed = place_light(scene, scene.punctual_lights[0]);
    EXPECT_NEAR(placed.position.y, 0.02, 1e-6);
}

TEST(SceneLighting, PunctualLightsMoveWithTheObjectThatCarriesThem) {
    GltfBuilder builder = with_lights(Json::array({{{"type", "spot"}, {"intensity", 80}}}));
    // The light's node becomes a child of the first lamp, which is turned and moved.
    Json& nodes = builder.json["nodes"];
    const auto light = static_cast<int>(nodes.size()) - 1;
    nodes[0]["children"] = {light};
    nodes[0]["extras"] = {{"movable", true}};
    nodes[0]["translation"] = {5, 0, 0};
    nodes[0]["rotation"] = {0.70710678, 0, 0, 0.70710678};  // a quarter turn about x
    builder.json["scenes"][0]["nodes"] = {0, 1};
    Scene scene = builder.load();
    ASSERT_EQ(scene.punctual_lights.size(), 1U);
    ASSERT_EQ(scene.punctual_lights[0].object, 0);
    PlacedLight placed = place_light(scene, scene.punctual_lights[0]);
    EXPECT_NEAR(glm::distance(placed.position, glm::dvec3(5, 0, 2)), 0.0, 1e-5);
    EXPECT_NEAR(glm::distance(placed.direction(), glm::dvec3(0, 1, 0)), 0.0, 1e-5);
    scene.objects[0].transform.translation.x = 7.0F;
    placed = place_light(scene, scene.punctual_lights[0]);
    EXPECT_NEAR(glm::distance(placed.position, glm::dvec3(7, 0, 2)), 0.0, 1e-5);
}

TEST(SceneLighting, PunctualLightsThatCannotBeAreRejected) {
    const auto reason = [](const Json& light) {
        const SceneError error = load_error(with_lights(Json::array({light})));
        return error.json_path() + ": " + error.reason();
    };
    const std::string lights = "extensions.KHR_lights_punctual.lights[0]";
    EXPECT_EQ(reason({{"intensity", 1}}), lights + ".type: is missing");
    EXPECT_EQ(reason({{"type", "area"}}),
              lights + ".type: \"area\" is not one of point|spot|directional");
    EXPECT_NE(reason({{"type", "point"}, {"intensity", -1}}).find(".intensity"), std::string::npos);
    EXPECT_NE(reason({{"type", "point"}, {"color", {1, 1}}}).find(".color"), std::string::npos);
    // Cones the wrong way round are read: CasesSpot.AnInnerConeBeyondTheOuterOneIsCutOff.
    EXPECT_NE(
        reason({{"type", "spot"}, {"spot", {{"outerConeAngle", 2.0}}}}).find(".outerConeAngle"),
        std::string::npos);
    GltfBuilder builder = with_lights(Json::array({{{"type", "point"}}}));
    builder.json["nodes"].back()["extensions"]["KHR_lights_punctual"]["light"] = 3;
    EXPECT_EQ(load_error(builder).reason(), "3 is out of range: the file has 1 lights");
}

TEST(SceneLighting, EmissionTexturesAreAveraged) {
    GltfBuilder builder = two_lamps(
        {{"name", "panel"}, {"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}});
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        builder.add_uvs({{0, 0}, {1, 0}, {0, 1}});
    // The upper half of the image is white, the lower black: 3/4 of the triangle glows.
    builder.json["images"] = {
        {{"bufferView", builder.add_view(png(1, 2, {255, 255, 255, 255, 0, 0, 0, 255}))},
         {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    Scene scene = builder.load();
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_NEAR(scene.lights[0].radiance.g, 0.75F, 0.13F);
    TessellationSettings settings;
    settings.patch_size = 0.02F;
    const PatchMesh mesh = tessellate(scene, settings);
    double sum = 0.0;
    for (const glm::vec3& emission : mesh.emission) {
        sum += static_cast<double>(emission.g);
    }
    EXPECT_NEAR(sum / static_cast<double>(mesh.patch_count()), 0.75, 0.01);
}

TEST(SceneLighting, BothSidesOfDoubleSidedEmittersEmit) {
    Scene scene = two_lamps({{"emissiveFactor", {1, 1, 1}}, {"doubleSided", true}}).load();
    TessellationSettings settings;
    settings.patch_size = 10.0F;
    const PatchMesh mesh = tessellate(scene, settings);
    ASSERT_EQ(mesh.patch_count(), 4U);
    ASSERT_EQ(mesh.triangle_count(), 2U);
    EXPECT_EQ(mesh.back_side[1], 3U);
    EXPECT_EQ(mesh.side_triangle[3], 1U);
    EXPECT_EQ(mesh.emission[3], glm::vec3(1));
}

}  // namespace
}  // namespace raybundle::test
