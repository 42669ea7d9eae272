// SPDX-License-Identifier: Apache-2.0
// Containers, buffers, URIs and which scene is shown.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "gltf_builder.h"

namespace raybundle::test {
namespace {

TEST(SceneFile, ReadsEmbeddedDataUri) {
    const Scene scene = one_triangle().load();
    ASSERT_EQ(scene.triangles.size(), 1U);
    EXPECT_EQ(scene.name, "scene");
    EXPECT_EQ(scene.bounds.min, glm::vec3(0, 0, 0));
    EXPECT_EQ(scene.bounds.max, glm::vec3(1, 1, 0));
    ASSERT_EQ(scene.objects.size(), 1U);
    EXPECT_EQ(scene.objects[0].id, 1U);
    EXPECT_EQ(scene.objects[0].name, "thing");
}

TEST(SceneFile, ReadsGlbWhateverItsName) {
    const TemporaryFolder folder;
    const Scene scene = load_gltf(folder.write("scene.gltf", one_triangle().glb()));
    EXPECT_EQ(scene.triangles.size(), 1U);
}

TEST(SceneFile, ReadsExternalBuffersWithEscapedNamesAndParentFolders) {
    const TemporaryFolder folder;
    GltfBuilder builder = one_triangle();
    const std::string bytes(builder.buffer().begin(), builder.buffer().end());
    for (const auto& [file, uri] : std::vector<std::pair<std::string, std::string>>{
             {"models/plain.bin", "plain.bin"},
             {"models/two words.bin", "two%20words.bin"},
             {"models/two words.bin", "two words.bin"},
             {"models/100%.bin", "100%.bin"},
             {"models/dir/deep.bin", "dir/deep.bin"},
             {"shared.bin", "../shared.bin"}}) {
        folder.write(file, bytes);
        builder.json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
        const Scene scene = load_gltf(folder.write("models/scene.gltf", builder.text()));
        EXPECT_EQ(scene.triangles.size(), 1U) << uri;
    }
}

TEST(SceneFile, RefusesUrlsAndAbsolutePaths) {
    GltfBuilder builder = one_triangle();
    for (const char* uri : {"http://example.com/a.bin", "file:///etc/hostname", "/etc/hostname",
                            "%2Fetc%2Fhostname"}) {
        builder.json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        const SceneError error = load_error(builder);
        EXPECT_EQ(error.json_path(), "buffers[0].uri");
        EXPECT_NE(error.reason().find("only data URIs and relative paths"), std::string::npos);
    }
}

TEST(SceneFile, ShowsTheDefaultSceneOrTheFirst) {
    GltfBuilder builder = one_triangle();
    builder.add_node({{"mesh", 0}, {"name", "other"}, {"translation", {5, 0, 0}}}, false);
    builder.json["scenes"].push_back({{"nodes", {1}}});
    EXPECT_EQ(builder.load().objects[0].name, "thing");
    builder.json["scene"] = 1;
    const Scene other = builder.load();
    ASSERT_EQ(other.objects.size(), 1U);
    EXPECT_EQ(other.objects[0].name, "other");
    EXPECT_TRUE(has_notice(other, "scene 1 of 2"));
    builder.json.erase("scene");
    EXPECT_EQ(builder.load().objects[0].name, "thing");
    builder.json.erase("scenes");
    EXPECT_EQ(builder.load().objects.size(), 2U);
}

TEST(SceneFile, UnitScalesEverything) {
    GltfBuilder builder = one_triangle();
    builder.json["nodes"][0]["translation"] = {50, 0, 0};
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}}}}};
    builder.add_node({{"camera", 0}, {"translation", {0, 0, 200}}});
    SceneSettings settings;
    settings.metres_per_unit = 0.01F;
    const Scene scene = builder.load(settings);
    EXPECT_NEAR(scene.bounds.min.x, 0.5F, 1e-6F);
    EXPECT_NEAR(scene.bounds.max.x, 0.51F, 1e-6F);
    EXPECT_NEAR(scene.objects[0].transform.translation.x, 0.5F, 1e-6F);
    EXPECT_NEAR(scene.cameras[0].eye.z, 2.0F, 1e-6F);
}

TEST(SceneFile, MatrixAndTrsGiveTheSamePlace) {
    const glm::vec3 axis = glm::normalize(glm::vec3(1, 2, 3));
    const glm::quat rotation = glm::angleAxis(0.7F, axis);
    GltfBuilder builder;
    const int mesh = builder.add_triangle_mesh(unit_triangle);
    builder.add_node({{"mesh", mesh},
                      {"translation", {1, 2, 3}},
                      {"rotation", {rotation.x, rotation.y, rotation.z, rotation.w}},
                      {"scale", {2, 3, 4}}});
    Transform transform{{1, 2, 3}, rotation, {2, 3, 4}};
    const glm::mat4 matrix = transform.matrix();
    std::vector<float> columns(&matrix[0][0], &matrix[0][0] + 16);
    builder.add_node({{"mesh", mesh}, {"matrix", columns}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 2U);
    const auto a = world_corners(scene, scene.triangles[0]);
    const auto b = world_corners(scene, scene.triangles[1]);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LT(glm::distance(a[k], b[k]), 1e-5F);
        const glm::vec3 exact(matrix * glm::vec4(unit_triangle[k], 1.0F));
        EXPECT_LT(glm::distance(a[k], exact), 1e-5F);
    }
    // The decomposed matrix leaves the file's vertices as they are.
    EXPECT_EQ(scene.vertices[scene.triangles[1].vertex[1]].position, unit_triangle[1]);
}

TEST(SceneFile, ShearIsBakedIntoVertices) {
    GltfBuilder builder;
    const int mesh = builder.add_triangle_mesh(unit_triangle);
    builder.add_node(
        {{"mesh", mesh}, {"matrix", {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1}}});
    const Scene scene = builder.load();
    const auto corners = world_corners(scene, scene.triangles[0]);
    EXPECT_LT(glm::distance(corners[0], glm::vec3(7, 0, 0)), 1e-5F);
    EXPECT_LT(glm::distance(corners[1], glm::vec3(8, 0, 0)), 1e-5F);
    EXPECT_LT(glm::distance(corners[2], glm::vec3(7.5F, 1, 0)), 1e-5F);
}

TEST(SceneFile, ReadsCamerasInWorldSpace) {
    GltfBuilder builder = one_triangle();
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"name", "lens"}, {"perspective", {{"yfov", 0.6}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 1}}}}};
    // A quarter turn about Y: the camera looks along -X.
    const int camera = builder.add_node(
        {{"camera", 0}, {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}}, false);
    builder.add_node({{"translation", {10, 1, 0}}, {"children", {camera}}, {"scale", {2, 2, 2}}});
    builder.add_node({{"camera", 1}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].name, "lens");
    EXPECT_LT(glm::distance(scene.cameras[0].eye, glm::vec3(10, 1, 0)), 1e-5F);
    const glm::vec3 forward = glm::normalize(scene.cameras[0].target - scene.cameras[0].eye);
    EXPECT_LT(glm::distance(forward, glm::vec3(-1, 0, 0)), 1e-5F);
    EXPECT_LT(glm::distance(scene.cameras[0].up, glm::vec3(0, 1, 0)), 1e-5F);
    EXPECT_FLOAT_EQ(scene.cameras[0].vertical_fov, 0.6F);
    EXPECT_TRUE(has_notice(scene, "orthographic"));
}

TEST(SceneFile, DefaultCameraStandsInsideOfARoomAndOutsideOfAThing) {
    GltfBuilder thing;
    thing.add_node({{"mesh", thing.add_box_mesh({0, 0, 0}, {1, 1, 1})}});
    const Scene outside = thing.load();
    ASSERT_EQ(outside.cameras.size(), 1U);
    EXPECT_EQ(outside.cameras[0].name, "from outside");
    EXPECT_GT(glm::distance(outside.cameras[0].eye, glm::vec3(0.5F)), 1.0F);

    GltfBuilder room;
    // Mirrored: the faces look inwards.
    room.add_node({{"mesh", room.add_box_mesh({0, 0, 0}, {4, 3, 5})}});
    for (auto& accessor : room.json["accessors"]) {
        if (accessor["type"] == "SCALAR") {
            room.json["meshes"][0]["primitives"][0]["indices"] =
                room.add_indices({0, 6, 4, 0, 2, 6, 1, 7, 3, 1, 5, 7, 0, 5, 1, 0, 4, 5,
                                  2, 7, 6, 2, 3, 7, 0, 3, 2, 0, 1, 3, 4, 7, 5, 4, 6, 7});
            break;
        }
    }
    const Camera inside = room.load().cameras.at(0);
    EXPECT_TRUE(glm::all(glm::greaterThan(inside.eye, glm::vec3(0))));
    EXPECT_TRUE(glm::all(glm::lessThan(inside.eye, glm::vec3(4, 3, 5))));
}

}  // namespace
}  // namespace raybundle::test
