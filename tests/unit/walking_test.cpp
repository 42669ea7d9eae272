// SPDX-License-Identifier: Apache-2.0
// What a model needs so that people can walk in it: where they stand first, what is in their way,
// and what its objects are called and are.
#include <gtest/gtest.h>

#include <algorithm>

#include "gltf_builder.h"
#include "scene/object_kind.h"
#include "scene/walk/standing_views.h"
#include "scene/walk/walk_map.h"
#include "scene/walk/world_rays.h"

namespace raybundle::test {
namespace {

void add_box(GltfBuilder& builder, const std::string& name, const glm::vec3& low,
             const glm::vec3& high) {
    builder.add_node({{"mesh", builder.add_box_mesh(low, high)}, {"name", name}});
}

/// Two rooms of 5 x 3 x 4 m beside one another, walls 20 cm thick, a doorway 1 m wide and 2.1 m
/// high between them, a lamp below the ceiling of the left one.
GltfBuilder two_rooms() {
    GltfBuilder builder;
    add_box(builder, "slab", {-0.2F, -0.2F, -0.2F}, {10.4F, 0.0F, 4.2F});
    add_box(builder, "roof", {-0.2F, 3.0F, -0.2F}, {10.4F, 3.2F, 4.2F});
    add_box(builder, "wall left", {-0.2F, 0, -0.2F}, {0, 3, 4.2F});
    add_box(builder, "wall right", {10.2F, 0, -0.2F}, {10.4F, 3, 4.2F});
    add_box(builder, "wall back", {0, 0, -0.2F}, {10.2F, 3, 0});
    add_box(builder, "wall front", {0, 0, 4}, {10.2F, 3, 4.2F});
    add_box(builder, "partition 1", {5, 0, 0}, {5.2F, 3, 1.5F});
    add_box(builder, "partition 2", {5, 0, 2.5F}, {5.2F, 3, 4});
    add_box(builder, "lintel", {5, 2.1F, 1.5F}, {5.2F, 3, 2.5F});
    const int lamp = builder.add_material({{"name", "lamp"}, {"emissiveFactor", {1, 1, 1}}});
    const int mesh = builder.add_box_mesh({2, 2.9F, 1.8F}, {2.4F, 2.95F, 2.2F});
    builder.json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0]["material"] = lamp;
    builder.add_node({{"mesh", mesh}, {"name", "lamp"}});
    return builder;
}

TEST(StandingViews, AreAtEyeHeightInsideWhereItIsLitAndLookFar) {
    const Scene scene = two_rooms().load();
    ASSERT_GE(scene.cameras.size(), 3U);  // one a room, and one from outside
    const Camera& first = scene.cameras[0];
    EXPECT_EQ(first.name, "inside");
    EXPECT_NEAR(first.eye.y, eye_height, 0.01F);
    EXPECT_NEAR(first.target.y, eye_height, 0.01F);
    EXPECT_GT(first.eye.x, 0.3F);
    EXPECT_LT(first.eye.x, 9.9F);
    const WorldRays rays(scene);
    EXPECT_FALSE(rays.blocked(first.eye, {2.2F, 2.85F, 2.0F})) << "in the dark";
    EXPECT_GT(rays.trace(first.eye, glm::normalize(first.target - first.eye)).distance, 3.5F);
    EXPECT_EQ(scene.cameras.back().name, "from outside");
    const auto left = [](const Camera& camera) { return camera.eye.x < 5.1F; };
    EXPECT_NE(left(scene.cameras[0]), left(scene.cameras[1])) << "both in one room";
}

/// Rooms 3 m high that were drawn in millimetres and read as metres.
TEST(StandingViews, AreAtEyeHeightInAnotherUnit) {
    SceneSettings settings;
    settings.metres_per_unit = 1000.0F;
    const Scene scene = two_rooms().load(settings);
    ASSERT_GE(scene.cameras.size(), 3U);
    EXPECT_EQ(scene.cameras[0].name, "inside");
    for (std::size_t i = 0; i + 1 < scene.cameras.size(); ++i) {
        EXPECT_GT(scene.cameras[i].eye.y, 1300.0F);
        EXPECT_LT(scene.cameras[i].eye.y, 2200.0F);
    }
    // A hall of 30 m is one.
    settings.metres_per_unit = 10.0F;
    EXPECT_NEAR(two_rooms().load(settings).cameras[0].eye.y, eye_height, 0.01F);
}

// Seen from where one can stand, half of what is around has light; along the longest line through
// it, nearly all are backs: a shell modelled from outside.
TEST(StandingViews, DoNotLookAtTheBacksOfWalls) {
    GltfBuilder builder;
    add_box(builder, "slab", {-0.2F, -0.2F, -0.2F}, {3.2F, 0.0F, 3.2F});
    add_box(builder, "roof", {-0.2F, 3.0F, -0.2F}, {3.2F, 3.2F, 3.2F});
    add_box(builder, "wall left", {-0.2F, 0, -0.2F}, {0, 3, 3.2F});
    add_box(builder, "wall back", {0, 0, -0.2F}, {3.2F, 3, 0});
    add_box(builder, "wall front", {0, 0, 3}, {3.2F, 3, 3.2F});
    // What the room is open to, 9 m long: quads that face outwards.
    const auto quad = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                          const glm::vec3& d) {
        builder.add_node({{"mesh", builder.add_triangle_mesh({a, b, c, a, c, d})}});
    };
    quad({3.2F, 0, 0}, {12, 0, 0}, {12, 0, 3}, {3.2F, 0, 3});  // floor, seen from below
    quad({3.2F, 3, 0}, {3.2F, 3, 3}, {12, 3, 3}, {12, 3, 0});  // ceiling, from above
    quad({3.2F, 0, 0}, {3.2F, 3, 0}, {12, 3, 0}, {12, 0, 0});  // walls, from outside
    quad({3.2F, 0, 3}, {12, 0, 3}, {12, 3, 3}, {3.2F, 3, 3});
    quad({12, 0, 0}, {12, 3, 0}, {12, 3, 3}, {12, 0, 3});
    const Scene scene = builder.load();
    const WorldRays rays(scene);
    ASSERT_FALSE(rays.trace({2, 1.5F, 1.5F}, {1, 0, 0}).front);
    ASSERT_NEAR(rays.trace({2, 1.5F, 1.5F}, {1, 0, 0}).distance, 10.0F, 0.01F);
    const std::vector<Camera> views = standing_views(scene, rays, 8);
    EXPECT_FALSE(views.empty()) << "the room itself";
    for (const Camera& camera : views) {
        const WorldRays::Hit hit = rays.trace(camera.eye, camera.target - camera.eye);
        EXPECT_TRUE(hit.front) << camera.name;
    }
}

TEST(StandingViews, AreNoneInWhatNobodyCanStandIn) {
    GltfBuilder builder;
    add_box(builder, "box", {0, 0, 0}, {1, 1, 1});
    add_box(builder, "cupboard", {2, 0, 0}, {3, 1, 1});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].name, "from outside");
    EXPECT_TRUE(standing_views(scene, WorldRays(scene), 4).empty());
}

TEST(WalkMapTest, KnowsWhatIsStraightBelowTheEyeHoweverFar) {
    GltfBuilder builder = two_rooms();
    add_box(builder, "table", {3, 0.7F, 1}, {4, 0.74F, 2});
    builder.add_node({{"mesh", builder.add_box_mesh({-20, -4.3F, -20}, {20, -4, 20})},
                      {"name", "ground"},
                      {"rotation", {0.0F, 0.0F, 0.02F, 0.99980F}}});
    const Scene scene = builder.load();
    const auto floor = [&](const glm::vec3& eye) { return make_walk_map(scene, eye).floor; };
    ASSERT_TRUE(floor({2, 1.6F, 2}));
    EXPECT_NEAR(*floor({2, 1.6F, 2}), 0.0F, 1e-5F) << "floor of the room, not of the scene";
    EXPECT_NEAR(*floor({2, 0.1F, 2}), 0.0F, 1e-5F) << "somebody lies on it";
    EXPECT_NEAR(*floor({3.5F, 1.6F, 1.5F}), 0.74F, 1e-5F) << "table";
    EXPECT_NEAR(*floor({2, 40.0F, 2}), 3.2F, 1e-5F) << "roof, far below";
    ASSERT_TRUE(floor({15, 1.6F, 2}));
    EXPECT_NEAR(*floor({15, 1.6F, 2}), -4.0F + 15.0F * 0.04F, 0.02F) << "sloping ground outside";
    EXPECT_FALSE(floor({50, 1.6F, 2})) << "beyond it";
    EXPECT_FALSE(floor({2, -9.0F, 2})) << "below all";
}

bool taken(const WalkMap& map, const glm::vec3& at) {
    const glm::vec3 off = at - map.origin;
    const auto column = static_cast<std::size_t>(off.z / WalkMap::cell) * WalkMap::columns +
                        static_cast<std::size_t>(off.x / WalkMap::cell);
    return (map.occupied[column] >> static_cast<int>(off.y / WalkMap::layer) & 1U) != 0;
}

TEST(WalkMapTest, HasWallsFloorsAndFurnitureWhereTheyAreNow) {
    GltfBuilder builder = two_rooms();
    add_box(builder, "table", {3, 0.7F, 1}, {4, 0.74F, 2});
    add_box(builder, "Zimmertür", {5.05F, 0, 1.5F}, {5.1F, 2.1F, 2.5F});
    Scene scene = builder.load();
    const glm::vec3 eye(4.4F, 1.6F, 2.0F);
    const WalkMap map = make_walk_map(scene, eye);
    EXPECT_TRUE(taken(map, {5.01F, 1.0F, 0.75F})) << "partition";
    EXPECT_FALSE(taken(map, {5.1F, 1.0F, 2.0F})) << "doorway, its door is closed";
    EXPECT_TRUE(taken(map, {3.5F, 0.72F, 1.5F})) << "table top";
    EXPECT_FALSE(taken(map, {3.5F, 0.4F, 1.5F})) << "below the table";
    EXPECT_TRUE(taken(map, {4.4F, 0.01F, 2.0F}) || taken(map, {4.4F, -0.01F, 2.0F})) << "floor";
    EXPECT_FALSE(taken(map, {4.4F, 1.0F, 3.0F})) << "air";
    const auto table = std::find_if(scene.objects.begin(), scene.objects.end(),
                                    [](const Object& object) { return object.name == "table"; });
    table->transform.translation.x -= 2.0F;
    EXPECT_FALSE(taken(make_walk_map(scene, eye), {3.5F, 0.72F, 1.5F}));
    EXPECT_TRUE(taken(make_walk_map(scene, eye), {1.5F, 0.72F, 1.5F}));
}

/// A vertical wall has no area for rays from above, an oblique one passes between the centres of
/// cells: none has a hole.
TEST(WalkMapTest, LeavesNoHolesInWallsOfAnyDirection) {
    for (const float turn : {0.0F, 0.3F, 0.785F, 1.2F}) {
        const glm::vec3 along(std::cos(turn), 0.0F, std::sin(turn));
        GltfBuilder builder;
        const glm::vec3 a = -3.0F * along;
        const glm::vec3 b = 3.0F * along;
        const glm::vec3 up(0, 3, 0);
        builder.add_node({{"mesh", builder.add_triangle_mesh({a, b, b + up, a, b + up, a + up})}});
        const WalkMap map = make_walk_map(builder.load(), {0, 1.6F, 0});
        for (float t = -2.9F; t < 2.9F; t += 0.01F) {
            ASSERT_TRUE(taken(map, t * along + glm::vec3(0, 1, 0))) << turn << " " << t;
        }
    }
}

ObjectKind kind(const std::string& name) {
    return kind_of_names(std::span(&name, 1));
}

TEST(ObjectKinds, AreToldByNames) {
    for (const char* door :
         {"Door_01", "IfcDoor/Single 90", "Haustür", "TÜR 3", "frontDoor", "Porte d'entrée",
          "puerta", "door of the hall", "Single-Flush:0915 x 2134mm Door"}) {
        EXPECT_EQ(kind(door), ObjectKind::door) << door;
    }
    for (const char* part :
         {"Basic Wall:Interior - 138mm:309", "IfcWallStandardCase", "Slab.002",
          "wall left of the door", "Wand neben der Tür", "Geschossdecke Decke", "roof", "Wand",
          "IfcStairFlight", "Partition office left", "Trennwand 3", "IfcWall/Außenwände"}) {
        EXPECT_EQ(kind(part), ObjectKind::structure) << part;
    }
    for (const char* thing : {"floor lamp", "Wall clock", "ceiling light 2", "indoor plant",
                              "outdoor chair", "Doris", "sofa", "lintel above door", "Walter",
                              "portable", "Leinwand", "Schrankwand", "Rückwand 2"}) {
        EXPECT_EQ(kind(thing), ObjectKind::thing) << thing;
    }
}

TEST(ObjectNames, SayTypeAndStoreyBeforeIdentifiers) {
    const std::string id = "2O2Fr$t4X7Zf8NOew3FLOH";
    EXPECT_TRUE(is_identifier(id));
    EXPECT_TRUE(is_identifier("product-3f2504e0-4f89-11d3-9a0c-0305e82c3301-body"));
    EXPECT_TRUE(is_identifier("4711"));
    EXPECT_FALSE(is_identifier("chair"));
    const std::vector<std::string> path{"IfcProject/House", "IfcBuildingStorey/Ground floor"};
    const std::vector<std::string> others{"IfcWall"};
    EXPECT_EQ(storey_of(path), "Ground floor");
    EXPECT_EQ(readable_name(id, others, path), "Wall, Ground floor, 2O2Fr$t4");
    EXPECT_EQ(readable_name("IfcWall/North wall", others, path), "North wall");
    EXPECT_EQ(readable_name(id, {}, path), id);
    EXPECT_EQ(storey_of(std::vector<std::string>{"Haus", "2.OG", "Wohnung"}), "2.OG");
    EXPECT_EQ(storey_of(std::vector<std::string>{"Haus", "Möbel"}), "");
}

TEST(ObjectNames, StoreysAndKindsComeFromTheHierarchy) {
    GltfBuilder builder;
    const int leaf = builder.add_node(
        {{"mesh", builder.add_box_mesh({0, 0, 0}, {1, 2, 0.05F})}, {"name", "Tür links"}}, false);
    const int frame = builder.add_node({{"children", {leaf}}, {"name", "Element 3"}}, false);
    const int wall = builder.add_node(
        {{"mesh", builder.add_box_mesh({-4, 0, -4}, {6, 3, 6})}, {"name", "1"}}, false);
    builder.json["meshes"].back()["name"] = "IfcWall";
    builder.add_node({{"children", {frame, wall}}, {"name", "EG"}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].name, "Element 3");
    EXPECT_EQ(scene.objects[0].kind, ObjectKind::door);
    EXPECT_EQ(scene.objects[0].path, std::vector<std::string>{"EG"});
    EXPECT_EQ(scene.objects[1].name, "Wall, EG, 1");
    EXPECT_EQ(scene.objects[1].kind, ObjectKind::structure);
}

/// A room and three boxes in one mesh, one of them within the bounds of another.
TEST(LoneObject, IsDividedIntoPartsThatCanBeMoved) {
    GltfBuilder builder;
    Json primitives = Json::array();
    const auto add = [&](const glm::vec3& low, const glm::vec3& high) {
        const int mesh = builder.add_box_mesh(low, high);
        primitives.push_back(
            builder.json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0]);
    };
    add({0, 0, 0}, {6, 3, 5});
    add({1, 0, 1}, {2, 0.8F, 2});
    add({1.2F, 0.3F, 1.2F}, {1.8F, 0.7F, 1.8F});
    add({4, 0, 3}, {4.5F, 1, 3.5F});
    builder.json["meshes"] = Json::array({{{"primitives", primitives}}});
    builder.add_node({{"mesh", 0}, {"name", "everything"}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.objects.size(), 3U);
    EXPECT_EQ(scene.objects[0].name, "everything");
    EXPECT_FALSE(scene.objects[0].movable);
    EXPECT_TRUE(scene.objects[1].movable);
    EXPECT_TRUE(scene.objects[2].movable);
    EXPECT_EQ(scene.objects[1].bounds.max, glm::vec3(2, 0.8F, 2));
    EXPECT_EQ(scene.objects[2].bounds.min, glm::vec3(4, 0, 3));
    std::vector<int> counts(3, 0);
    for (const Triangle& triangle : scene.triangles) {
        ++counts.at(triangle.object);
    }
    EXPECT_EQ(counts, (std::vector<int>{12, 24, 12}));
    builder.json["nodes"][0]["extras"] = {{"movable", true}};
    EXPECT_EQ(builder.load().objects.size(), 1U) << "its author has said that it moves as a whole";
}

}  // namespace
}  // namespace raybundle::test
