// SPDX-License-Identifier: Apache-2.0
// Lights and the sky.
#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/patch_mesh.h"

namespace raybundle::test {
namespace {

const std::vector<glm::vec3> unit_triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

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

TEST(SceneLighting, PunctualLightsAreReportedAsIgnored) {
    GltfBuilder builder = two_lamps(Json::object());
    builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.json["extensionsRequired"] = {"KHR_lights_punctual"};
    const Scene scene = builder.load();
    EXPECT_TRUE(has_notice(scene, "KHR_lights_punctual"));
    EXPECT_EQ(scene.sky_radiance, glm::vec3(1000));
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
    EXPECT_EQ(mesh.back_patch[1], 3U);
    EXPECT_EQ(mesh.patch_triangle[3], 1U);
    EXPECT_EQ(mesh.emission[3], glm::vec3(1));
}

}  // namespace
}  // namespace raybundle::test
