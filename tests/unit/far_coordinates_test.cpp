// SPDX-License-Identifier: Apache-2.0
// Scenes far from zero, and triangles far from the scene.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.h"
#include "scene/neighbourhood.h"
#include "scene/object_limits.h"

namespace raybundle::test {
namespace {

Scene far_case(const std::string& file) {
    return load_gltf(std::string(RAYBUNDLE_CASES) + "/far/" + file);
}

double extent(const Scene& scene) {
    return static_cast<double>(glm::length(scene.bounds.extent()));
}

double largest_coordinate(const Scene& scene) {
    const glm::vec3 most = glm::max(glm::abs(scene.bounds.min), glm::abs(scene.bounds.max));
    return static_cast<double>(std::max({most.x, most.y, most.z}));
}

/// What lies between the scene's parts, from a file and from the same one at map coordinates.
void expect_same_arrangement(const Scene& near, const Scene& far) {
    ASSERT_EQ(near.triangles.size(), far.triangles.size());
    const glm::vec3 shift =
        world_corners(far, far.triangles[0])[0] - world_corners(near, near.triangles[0])[0];
    for (std::size_t t = 0; t < near.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 moved = world_corners(near, near.triangles[t])[k] + shift;
            EXPECT_LT(glm::distance(world_corners(far, far.triangles[t])[k], moved), 1e-5F);
        }
    }
    for (std::size_t i = 0; i < near.punctual_lights.size(); ++i) {
        const glm::dvec3 moved =
            place_light(near, near.punctual_lights[i]).position + glm::dvec3(shift);
        EXPECT_LT(glm::distance(place_light(far, far.punctual_lights[i]).position, moved), 1e-5);
    }
    EXPECT_LT(glm::distance(far.cameras[0].eye, near.cameras[0].eye + shift), 1e-5F);
}

TEST(CasesFarCoordinates, AnOffsetOfANodeIsTakenOut) {
    const Scene near = far_case("origin.gltf");
    const Scene far = far_case("utm_node.gltf");
    EXPECT_FALSE(has_notice(near, "coordinates are counted from"));
    EXPECT_TRUE(has_notice(far, "coordinates are counted from (455126, 114, -5412344) m"));
    expect_same_arrangement(near, far);
}

TEST(CasesFarCoordinates, AStrayTriangleIsLeftOutAndNamed) {
    const Scene clean = far_case("clean.gltf");
    for (const char* file : {"stray_2km.gltf", "stray_60km.gltf"}) {
        const Scene scene = far_case(file);
        EXPECT_TRUE(has_notice(scene, "too small to matter: 1 of 27 pieces, in 'stray'")) << file;
        EXPECT_EQ(scene.triangles.size(), clean.triangles.size());
        EXPECT_EQ(scene.bounds.max, clean.bounds.max);
        EXPECT_EQ(scene.cameras[0].target, clean.cameras[0].target);
    }
}

/// A room of 6 x 3 x 4 m at a place, walls as nodes of their own whose translations cancel an
/// offset of their mesh or of their parent.
GltfBuilder room_of_parts(const glm::dvec3& place, bool parents) {
    GltfBuilder builder;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 part = place + glm::dvec3(2.0 * i, 0.1 * i, 0.0);
        const int mesh = builder.add_box_mesh({0, 0, 0}, {2, 3, 4});
        const glm::dvec3 above = parents ? glm::dvec3(-9e5, 7e4 + 0.3, 5e6) : glm::dvec3(0.0);
        const glm::dvec3 own = part - above;
        const int child =
            builder.add_node({{"mesh", mesh}, {"translation", {own.x, own.y, own.z}}}, !parents);
        if (parents) {
            builder.add_node({{"translation", {above.x, above.y, above.z}}, {"children", {child}}});
        }
    }
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    builder.add_node(
        {{"camera", 0}, {"translation", {place.x + 1.0, place.y + 1.0, place.z + 9.0}}});
    return builder;
}

TEST(FarCoordinates, PartsKeepTheirPlacesToEachOther) {
    const Scene near = room_of_parts({0, 0, 0}, false).load();
    for (const bool parents : {false, true}) {
        const Scene far = room_of_parts({455123.27, 112.53, -5412345.71}, parents).load();
        ASSERT_EQ(near.triangles.size(), far.triangles.size());
        EXPECT_LT(largest_coordinate(far), 10.0);
        expect_same_arrangement(near, far);
    }
}

TEST(FarCoordinates, AnOffsetThatPrecisionCarriesStays) {
    const Scene scene = room_of_parts({120, -3, 80}, false).load();
    EXPECT_EQ(scene.origin, glm::dvec3(0.0));
    EXPECT_GT(largest_coordinate(scene), 100.0);
}

TEST(FarCoordinates, VerticesThatAreStoredFarAwayAreTold) {
    GltfBuilder builder;
    builder.add_node(
        {{"name", "house"}, {"mesh", builder.add_box_mesh({5e6F, 0, 0}, {5e6F + 8.0F, 3, 4})}});
    const Scene scene = builder.load();
    EXPECT_TRUE(has_notice(scene, "the vertices of 'house' are stored 5e+06 m away"));
    EXPECT_LT(largest_coordinate(scene), 10.0);
    // Of many the one that is farthest away.
    for (int k = 1; k < 100; ++k) {
        builder.add_node({{"name", "part"},
                          {"mesh", builder.add_box_mesh({5e6F + 9.0F, 0, 0}, {5e6F + 10.0F, 3, 4})},
                          {"translation", {0, 0, 5 * k}}});
    }
    const Scene town = builder.load();
    EXPECT_TRUE(has_notice(town, " and 99 more are stored 5e+06 m away"));
    EXPECT_LT(town.notices.size(), 8U);
}

/// A box of 5 m, on a ground of so many metres, and a box of a size at a place.
Scene site(float ground, const glm::vec3& place, float size, const Json& material = {}) {
    GltfBuilder builder;
    builder.json["materials"] = Json::array({{{"name", "paint"}}});
    if (!material.is_null()) {
        builder.json["materials"].push_back(material);
    }
    builder.add_node({{"mesh", builder.add_box_mesh({0, 0, 0}, {5, 3, 5})}});
    if (ground > 0.0F) {
        builder.add_node(
            {{"mesh", builder.add_box_mesh({-ground, -1, -ground}, {ground, 0, ground})}});
    }
    const int other = builder.add_box_mesh(place, place + size);
    builder.json["meshes"][other]["primitives"][0]["material"] = material.is_null() ? 0 : 1;
    builder.add_node({{"name", "other"}, {"mesh", other}});
    return builder.load();
}

TEST(Neighbourhood, WhatCanBeSeenOrStandsOnTheGroundIsNoStray) {
    EXPECT_GT(extent(site(0, {900, 0, 0}, 5)), 900.0);         // another house, 0.3 degrees
    EXPECT_GT(extent(site(1000, {900, 0, 0}, 0.1F)), 2000.0);  // a brick on the same ground
    EXPECT_GT(extent(site(0, {0, 0, 20e3F}, 9e3F)), 20e3);     // mountains
    EXPECT_LT(extent(site(0, {900, 0, 0}, 0.1F)), 10.0);       // a brick without
    EXPECT_LT(extent(site(10, {60e3F, 0, 60e3F}, 5)), 50.0);
}

TEST(Neighbourhood, ADistantLampThatIsBrightIsNoStray) {
    const Json lamp = {
        {"emissiveFactor", {1, 1, 1}},
        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1e9}}}}}};
    EXPECT_GT(extent(site(0, {3000, 0, 0}, 1, lamp)), 2000.0);
}

TEST(Neighbourhood, InstancesAndPartsOfAMeshAreLeftOutOneByOne) {
    GltfBuilder builder;
    const int views = builder.add_positions({{0, 0, 0}, {6, 0, 0}, {7e4F, 100, 0}});
    const int mesh = builder.add_box_mesh({0, 0, 0}, {1, 1, 1});
    builder.add_node({{"name", "posts"},
                      {"mesh", mesh},
                      {"extensions",
                       {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", views}}}}}}}});
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    std::vector<glm::vec3> corners = {{0, 0, 5}, {5, 0, 5}, {0, 5, 5}};
    corners.insert(corners.end(), {{1e4F, 0, 0}, {1e4F, 1, 0}, {1e4F, 0, 1}});
    builder.add_node({{"name", "wall"}, {"mesh", builder.add_triangle_mesh(corners)}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 25U);
    EXPECT_LT(extent(scene), 20.0);
    EXPECT_TRUE(has_notice(scene, "2 of 5 pieces, in 'posts', 'wall'"));
}

TEST(ObjectLimits, PlacesThatSinglePrecisionDoesNotCarryAreRefused) {
    const Scene scene = far_case("clean.gltf");
    Transform transform = scene.objects[1].transform;
    transform.translation = {500, 0, 0};
    EXPECT_EQ(problem_of(scene, 1, transform), "");
    transform.translation = {5e6F, 0, 0};
    EXPECT_NE(problem_of(scene, 1, transform).find("translation: puts object 2 5e+06 m away"),
              std::string::npos);
    EXPECT_NE(problem_of(scene, 1, transform).find("the limit is 167772 m"), std::string::npos);
    transform.translation = {0, 0, 0};
    transform.scale = glm::vec3(1e6F);
    EXPECT_NE(problem_of(scene, 1, transform), "");
    transform.translation.x = std::nanf("");
    EXPECT_NE(problem_of(scene, 1, transform), "");
}

}  // namespace
}  // namespace raybundle::test
