// SPDX-License-Identifier: Apache-2.0
// What tinygltf alone would refuse, drop or cut off, and glTF or the scene does not depend on.
#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace raybundle::test {
namespace {

/// The same JSON with 1.0 in place of 1.
Json with_fractions(Json json) {
    if (json.is_number_integer()) {
        return json.get<double>();
    }
    for (Json& part : json) {
        if (part.is_structured() || part.is_number_integer()) {
            part = with_fractions(part);
        }
    }
    return json;
}

TEST(SceneModel, IntegersMayBeWrittenAsFractions) {
    GltfBuilder builder = one_triangle();
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["indices"] = builder.add_indices({2, 0, 1, 0});
    primitive["mode"] = 5;
    primitive["material"] = builder.add_material({{"doubleSided", true}});
    builder.json["nodes"][0]["translation"] = {1, 2, 3};
    const Scene expected = builder.load();
    builder.json = with_fractions(builder.json);
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), expected.triangles.size());
    ASSERT_EQ(scene.vertices.size(), expected.vertices.size());
    for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
        EXPECT_EQ(scene.vertices[i].position, expected.vertices[i].position);
    }
    EXPECT_EQ(scene.bounds.min, glm::vec3(1, 2, 3));
    EXPECT_TRUE(scene.materials[scene.triangles[0].material].double_sided);
}

TEST(SceneModel, NumbersInExtensionsMayExceed32Bits) {
    GltfBuilder builder = one_triangle();
    builder.json["meshes"][0]["primitives"][0]["material"] = builder.add_material(
        {{"emissiveFactor", {1, 1, 1}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5e9}}}}}});
    Json& strength = builder.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"]
                                 ["emissiveStrength"];
    EXPECT_EQ(builder.load().materials[0].emission, glm::vec3(5e9F));
    strength = 5'000'000'000;
    EXPECT_EQ(builder.load().materials[0].emission, glm::vec3(5e9F));
}

TEST(SceneModel, SparseIndicesNeedNoBufferView) {
    GltfBuilder builder = one_triangle();
    const int indices = builder.add_accessor(0, 5123, 3, "SCALAR");
    Json& accessor = builder.json["accessors"][static_cast<std::size_t>(indices)];
    accessor.erase("bufferView");
    accessor["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", builder.add_view({1, 2})}, {"componentType", 5121}}},
        {"values", {{"bufferView", builder.add_view({1, 0, 2, 0})}}}};
    builder.json["meshes"][0]["primitives"][0]["indices"] = indices;
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 1U);
    EXPECT_EQ(scene.bounds.max, glm::vec3(1, 1, 0));
}

TEST(SceneModel, CamerasNeedOnlyWhatIsRead) {
    GltfBuilder builder = one_triangle();
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}}}},
                               {{"type", "perspective"}},
                               {{"type", "perspective"}, {"perspective", {{"znear", 0.1}}}},
                               {{"type", "perspective"}, {"perspective", {{"yfov", 0}}}},
                               {{"type", "perspective"}, {"perspective", {{"yfov", -1}}}},
                               {{"type", "orthographic"}}};
    for (int camera = 0; camera < 6; ++camera) {
        builder.add_node({{"camera", camera}, {"translation", {0, 0, 5}}});
    }
    const Scene scene = builder.load();
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_FLOAT_EQ(scene.cameras[0].vertical_fov, 0.5F);
    EXPECT_TRUE(has_notice(scene, "orthographic and degenerate cameras"));
}

TEST(SceneModel, WhatIsNotReadMayBeBroken) {
    GltfBuilder builder = one_triangle();
    builder.json["animations"] = {5, {{"samplers", {{{"input", "x"}}}}}};
    builder.json["extensions"] = {{"KHR_materials_variants", {{"variants", {{{"name", 7}}}}}}};
    builder.json["skins"] = {{{"name", "no joints"}}};
    builder.json["nodes"][0]["skin"] = 0;
    EXPECT_EQ(builder.load().triangles.size(), 1U);
}

TEST(SceneModel, ImagesAreLeftToTheirUse) {
    GltfBuilder builder = one_triangle();
    const std::vector<std::uint8_t> red = png(1, 1, {255, 0, 0, 255});
    // Both places given: the view is read. The others are in no texture.
    builder.json["images"] = {
        {{"bufferView", builder.add_view(red)}, {"uri", "data:image/png;base64,AAAA"}},
        {{"uri", "data:image/png;base64,not an image"}},
        {{"bufferView", 0}, {"mimeType", "image/jpeg"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["meshes"][0]["primitives"][0]["material"] =
        builder.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].name, "images[0]");
    EXPECT_EQ(scene.textures[0].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255}));
}

TEST(SceneModel, RefusalsByTinygltfAreSceneErrors) {
    GltfBuilder builder = one_triangle();
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", "near"}}}}};
    const SceneError error = load_error(builder);
    EXPECT_EQ(error.json_path(), "");
    EXPECT_EQ(error.reason(), "tinygltf: 'znear' property is not a number type.");
}

}  // namespace
}  // namespace raybundle::test
