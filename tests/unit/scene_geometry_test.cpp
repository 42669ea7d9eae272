// SPDX-License-Identifier: Apache-2.0
// Primitives: modes, accessors, normals, skins, morphs, instances, defects.
#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace raybundle::test {
namespace {

/// Five vertices of a zigzag strip in the plane z = 0.
const std::vector<glm::vec3> zigzag = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};

Scene load_mode(int mode, const std::vector<glm::vec3>& positions) {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_mesh({{"attributes",
                                                  {{"POSITION", builder.add_positions(positions)}}},
                                                 {"mode", mode}})}});
    return builder.load();
}

TEST(SceneGeometry, StripsKeepTheirFront) {
    const Scene scene = load_mode(5, zigzag);
    ASSERT_EQ(scene.triangles.size(), 3U);
    for (const Triangle& triangle : scene.triangles) {
        EXPECT_GT(world_normal(scene, triangle).z, 0.99F);
    }
}

TEST(SceneGeometry, FansShareTheirFirstVertex) {
    const Scene scene = load_mode(6, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    ASSERT_EQ(scene.triangles.size(), 2U);
    for (const Triangle& triangle : scene.triangles) {
        EXPECT_GT(world_normal(scene, triangle).z, 0.99F);
        bool has_origin = false;
        for (const glm::vec3& corner : world_corners(scene, triangle)) {
            has_origin = has_origin || corner == glm::vec3(0);
        }
        EXPECT_TRUE(has_origin);
    }
}

TEST(SceneGeometry, PointsAndLinesAreSkippedWithANotice) {
    GltfBuilder builder;
    const int positions = builder.add_positions(zigzag);
    builder.add_node({{"mesh", builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}});
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 1}})}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 1U);
    EXPECT_TRUE(has_notice(scene, "points and lines"));
}

TEST(SceneGeometry, MissingNormalsAreFlat) {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_box_mesh({0, 0, 0}, {1, 1, 1})}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 12U);
    for (const Triangle& triangle : scene.triangles) {
        const glm::vec3 normal = world_normal(scene, triangle);
        for (const std::uint32_t vertex : triangle.vertex) {
            EXPECT_LT(glm::distance(scene.vertices[vertex].normal, normal), 1e-6F);
        }
        const auto corners = world_corners(scene, triangle);
        const glm::vec3 outwards = (corners[0] + corners[1] + corners[2]) / 3.0F - glm::vec3(0.5F);
        EXPECT_GT(glm::dot(normal, outwards), 0.0F);
    }
}

TEST(SceneGeometry, MirroredNodesKeepTheirFront) {
    for (const glm::vec3 scale : {glm::vec3(-1, 1, 1), glm::vec3(-2, -1, 1), glm::vec3(-1)}) {
        GltfBuilder builder;
        builder.add_node({{"mesh", builder.add_box_mesh({-1, -1, -1}, {1, 1, 1})},
                          {"scale", {scale.x, scale.y, scale.z}}});
        const Scene scene = builder.load();
        for (const Triangle& triangle : scene.triangles) {
            const auto p = world_corners(scene, triangle);
            EXPECT_GT(glm::dot(world_normal(scene, triangle), p[0] + p[1] + p[2]), 0.0F);
        }
    }
}

TEST(SceneGeometry, QuantisedAttributesAreConverted) {
    GltfBuilder builder;
    // Positions as normalised signed 16-bit integers, four to keep elements aligned.
    const std::vector<std::int16_t> positions = {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0};
    const int view = builder.add_view_of(positions);
    builder.json["bufferViews"][0]["byteStride"] = 8;
    const int accessor = builder.add_accessor(view, 5122, 3, "VEC3");
    builder.json["accessors"][0]["normalized"] = true;
    builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", accessor}}}})}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.bounds.min, glm::vec3(0, -1, 0));
    EXPECT_EQ(scene.bounds.max, glm::vec3(1, 0, 0));
}

TEST(SceneGeometry, SparseAccessorsReplaceElements) {
    GltfBuilder builder;
    const int accessor = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int indices = builder.add_view_of(std::vector<std::uint16_t>{2});
    const int values = builder.add_view_of(std::vector<glm::vec3>{{0, 5, 0}});
    builder.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", accessor}}}})}});
    EXPECT_EQ(builder.load().bounds.max, glm::vec3(1, 5, 0));
    // Without a view, the rest is zero.
    builder.json["accessors"][0].erase("bufferView");
    builder.json["accessors"][0]["sparse"]["count"] = 1;
    EXPECT_NE(load_error(builder).reason().find("no triangles with an area"), std::string::npos);
}

TEST(SceneGeometry, SkinsAreInTheirRestPose) {
    GltfBuilder builder;
    const int positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int joints = builder.add_accessor(builder.add_view_of(std::vector<std::uint8_t>(12, 0)),
                                            5121, 3, "VEC4");
    std::vector<float> weights(12, 0.0F);
    weights[0] = weights[4] = weights[8] = 1.0F;
    const int weight = builder.add_accessor(builder.add_view_of(weights), 5126, 3, "VEC4");
    const int mesh = builder.add_mesh(
        {{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weight}}}});
    const int joint = builder.add_node({{"translation", {0, 0, 3}}});
    builder.json["skins"] = {{{"joints", {joint}}}};
    // The transform of the skinned node itself does not count.
    builder.add_node({{"mesh", mesh}, {"skin", 0}, {"translation", {100, 0, 0}}});
    const Scene scene = builder.load();
    EXPECT_LT(glm::distance(scene.bounds.min, glm::vec3(0, 0, 3)), 1e-4F);
    EXPECT_LT(glm::distance(scene.bounds.max, glm::vec3(1, 1, 3)), 1e-4F);
    EXPECT_TRUE(has_notice(scene, "rest pose"));
}

TEST(SceneGeometry, MorphTargetsUseTheirDefaultWeights) {
    GltfBuilder builder;
    const int base = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int offsets = builder.add_positions({{0, 0, 0}, {2, 0, 0}, {0, 0, 0}});
    const int mesh = builder.add_mesh(
        {{"attributes", {{"POSITION", base}}}, {"targets", {{{"POSITION", offsets}}}}});
    builder.add_node({{"mesh", mesh}});
    EXPECT_FLOAT_EQ(builder.load().bounds.max.x, 1.0F);
    builder.json["meshes"][0]["weights"] = {0.5};
    EXPECT_FLOAT_EQ(builder.load().bounds.max.x, 2.0F);
    builder.json["nodes"][0]["weights"] = {1.0};
    EXPECT_FLOAT_EQ(builder.load().bounds.max.x, 3.0F);
}

TEST(SceneGeometry, InstancesAreRepeated) {
    GltfBuilder builder;
    const int mesh = builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int offsets = builder.add_positions({{0, 0, 0}, {0, 0, 5}, {0, 0, 10}});
    builder.add_node(
        {{"mesh", mesh},
         {"extensions",
          {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", offsets}}}}}}}});
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 3U);
    EXPECT_FLOAT_EQ(scene.bounds.max.z, 10.0F);
}

TEST(SceneGeometry, HiddenNodesAreLeftOut) {
    GltfBuilder builder;
    const int mesh = builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.add_node({{"mesh", mesh}});
    const int child = builder.add_node({{"mesh", mesh}, {"translation", {9, 0, 0}}}, false);
    builder.add_node(
        {{"children", {child}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 1U);
    EXPECT_TRUE(has_notice(scene, "hidden"));
}

TEST(SceneGeometry, TrianglesWithoutAreaAndRepeatedFacesAreLeftOut) {
    GltfBuilder builder;
    const std::vector<glm::vec3> positions = {
        {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0.5F, 1e-8F, 0}};
    // Good; point repeated; collinear; sliver below fp32; repeated face; its back side.
    const std::vector<std::uint16_t> indices = {0, 1, 2, 0, 0, 1, 0, 1, 3,
                                                0, 1, 4, 1, 2, 0, 0, 2, 1};
    builder.add_node({{"mesh", builder.add_mesh({{"attributes",
                                                  {{"POSITION", builder.add_positions(positions)}}},
                                                 {"indices", builder.add_indices(indices)}})}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 2U);
    EXPECT_EQ(scene.removed.degenerate_triangles, 3U);
    EXPECT_EQ(scene.removed.duplicate_faces, 1U);
    EXPECT_TRUE(has_notice(scene, "3 triangles without area"));
    EXPECT_TRUE(has_notice(scene, "1 duplicate faces"));
    EXPECT_FLOAT_EQ(scene.bounds.max.x, 1.0F);
}

}  // namespace
}  // namespace raybundle::test
