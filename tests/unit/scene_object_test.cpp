// SPDX-License-Identifier: Apache-2.0
// Which node subtrees become objects, and which of them can be moved.
#include <gtest/gtest.h>

#include <algorithm>

#include "gltf_builder.h"

namespace raybundle::test {
namespace {

/// A 4 x 3 x 5 m room shell of one mesh, named "room".
GltfBuilder room() {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_box_mesh({0, 0, 0}, {4, 3, 5})}, {"name", "room"}});
    return builder;
}

const Object* find(const Scene& scene, const std::string& name) {
    const auto it = std::find_if(scene.objects.begin(), scene.objects.end(),
                                 [&](const Object& object) { return object.name == name; });
    return it == scene.objects.end() ? nullptr : &*it;
}

TEST(SceneObject, ShellsStayAndFurnitureMoves) {
    GltfBuilder builder = room();
    builder.add_node(
        {{"mesh", builder.add_box_mesh({1, 0, 1}, {1.5, 0.5, 1.5})}, {"name", "stool"}});
    builder.add_node({{"mesh", builder.add_box_mesh({0, -0.1F, 0}, {4, 0, 5})}, {"name", "floor"}});
    builder.add_node(
        {{"mesh", builder.add_box_mesh({3.95F, 0, 0}, {4, 3, 1.5F})}, {"name", "wall piece"}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.objects.size(), 4U);
    EXPECT_FALSE(find(scene, "room")->movable);
    EXPECT_TRUE(find(scene, "stool")->movable);
    EXPECT_FALSE(find(scene, "floor")->movable);
    EXPECT_FALSE(find(scene, "wall piece")->movable);
}

TEST(SceneObject, ExtrasDecide) {
    GltfBuilder builder = room();
    const int box = builder.add_box_mesh({1, 0, 1}, {1.5, 0.5, 1.5});
    builder.json["nodes"][0]["extras"] = {{"movable", true}};
    builder.add_node({{"mesh", box}, {"name", "stool"}, {"extras", {{"movable", false}}}});
    builder.add_node({{"mesh", box},
                      {"name", "odd"},
                      {"translation", {1, 0, 0}},
                      {"extras", {{"movable", "yes"}}}});
    const Scene scene = builder.load();
    EXPECT_TRUE(find(scene, "room")->movable);
    EXPECT_FALSE(find(scene, "stool")->movable);
    EXPECT_TRUE(find(scene, "odd")->movable);
}

TEST(SceneObject, GroupsThatSpanTheSceneAreDividedSmallOnesAreOneObject) {
    GltfBuilder builder;
    const int shell = builder.add_box_mesh({0, 0, 0}, {4, 3, 5});
    const int leg = builder.add_box_mesh({0, 0, 0}, {0.1F, 0.7F, 0.1F});
    const int top = builder.add_box_mesh({0, 0.7F, 0}, {1, 0.8F, 1});
    const int legs = builder.add_node({{"mesh", leg}, {"name", "leg"}}, false);
    const int plate = builder.add_node({{"mesh", top}, {"name", "plate"}}, false);
    const int table = builder.add_node(
        {{"name", "table"}, {"children", {legs, plate}}, {"translation", {1, 0, 1}}}, false);
    const int walls = builder.add_node({{"mesh", shell}, {"name", "walls"}}, false);
    const int group = builder.add_node({{"name", "house"}, {"children", {walls, table}}}, false);
    builder.add_node({{"name", "root"}, {"children", {group}}, {"translation", {10, 0, 0}}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.objects.size(), 2U);
    const Object* moved = find(scene, "table");
    ASSERT_NE(moved, nullptr);
    EXPECT_TRUE(moved->movable);
    // The transform is the node's own; the ancestors' are fixed.
    EXPECT_EQ(moved->transform.translation, glm::vec3(1, 0, 1));
    EXPECT_EQ(moved->world_from_parent[3], glm::vec4(10, 0, 0, 1));
    EXPECT_EQ(moved->bounds.min, glm::vec3(0, 0, 0));
    EXPECT_EQ(moved->bounds.max, glm::vec3(1, 0.8F, 1));
}

TEST(SceneObject, FurnitureBelowTheRoomsMeshIsItsOwnObject) {
    GltfBuilder builder = room();
    const int chair = builder.add_node(
        {{"mesh", builder.add_box_mesh({1, 0, 1}, {1.5, 0.5, 1.5})}, {"name", "chair"}}, false);
    builder.json["nodes"][0]["children"] = {chair};
    const Scene scene = builder.load();
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_FALSE(find(scene, "room")->movable);
    EXPECT_TRUE(find(scene, "chair")->movable);
}

TEST(SceneObject, ADecisionDeepInsideDividesItsGroup) {
    GltfBuilder builder = room();
    const int box = builder.add_box_mesh({0, 0, 0}, {0.2F, 0.2F, 0.2F});
    const int vase =
        builder.add_node({{"mesh", box}, {"name", "vase"}, {"extras", {{"movable", true}}}}, false);
    const int shelf =
        builder.add_node({{"mesh", box}, {"name", "shelf"}, {"translation", {1, 1, 1}}}, false);
    builder.add_node({{"name", "furniture"}, {"children", {vase, shelf}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.objects.size(), 3U);
    EXPECT_NE(find(scene, "vase"), nullptr);
    EXPECT_NE(find(scene, "shelf"), nullptr);
}

TEST(SceneObject, UnnamedObjectsAreNamedAfterTheirMeshOrNumber) {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_box_mesh({0, 0, 0}, {1, 1, 1})}});
    builder.add_node({{"mesh", builder.add_box_mesh({9, 0, 0}, {10, 1, 1})}});
    builder.json["meshes"][0]["name"] = "crate";
    const Scene scene = builder.load();
    EXPECT_EQ(scene.objects[0].name, "crate");
    EXPECT_EQ(scene.objects[1].name, "object 2");
}

TEST(SceneObject, DeepChainsDoNotOverflow) {
    GltfBuilder builder;
    const int mesh = builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    constexpr int depth = 50'000;
    for (int i = 0; i + 1 < depth; ++i) {
        builder.json["nodes"].push_back({{"children", {i + 1}}});
    }
    builder.json["nodes"].push_back({{"mesh", mesh}});
    builder.json["scenes"][0]["nodes"] = {0};
    EXPECT_EQ(builder.load().objects.size(), 1U);
}

}  // namespace
}  // namespace raybundle::test
