// SPDX-License-Identifier: Apache-2.0
// Patches: sizes, counts, conformity, determinism.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "gltf_builder.h"
#include "scene/contact/contact_lines.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::test {
namespace {

using PointKey = std::tuple<std::uint32_t, float, float, float>;

PointKey key_of(const PatchMesh& mesh, std::uint32_t vertex) {
    const glm::vec3& p = mesh.positions[vertex];
    return {mesh.vertex_object[vertex], p.x, p.y, p.z};
}

/// How many triangles use each edge, welded by position.
std::map<std::pair<PointKey, PointKey>, int> edge_uses(const PatchMesh& mesh) {
    std::map<std::pair<PointKey, PointKey>, int> uses;
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            PointKey a = key_of(mesh, triangle[k]);
            PointKey b = key_of(mesh, triangle[(k + 1) % 3]);
            if (b < a) {
                std::swap(a, b);
            }
            ++uses[{a, b}];
        }
    }
    return uses;
}

double total_area(const PatchMesh& mesh) {
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]);
        area += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a,
                                             glm::dvec3(mesh.positions[t.z]) - a));
    }
    return area;
}

float longest_edge(const Scene& scene, const PatchMesh& mesh) {
    float longest = 0.0F;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::mat4 world = scene.objects[mesh.vertex_object[t.x]].world_from_object();
        for (int k = 0; k < 3; ++k) {
            const glm::vec4 along(mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]], 0.0F);
            longest = std::max(longest, glm::length(world * along));
        }
    }
    return longest;
}

/// A closed irregular solid: a box whose corners are moved, so that no edges are of equal length.
GltfBuilder crooked_box() {
    GltfBuilder builder;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> shift(-0.3F, 0.3F);
    std::vector<glm::vec3> corners;
    for (unsigned i = 0; i < 8; ++i) {
        corners.emplace_back(((i & 1U) != 0 ? 3.0F : 0.0F) + shift(random),
                             ((i & 2U) != 0 ? 1.0F : 0.0F) + shift(random),
                             ((i & 4U) != 0 ? 2.0F : 0.0F) + shift(random));
    }
    builder.add_node(
        {{"mesh",
          builder.add_mesh({{"attributes", {{"POSITION", builder.add_positions(corners)}}},
                            {"indices", builder.add_indices({0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0,
                                                             1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2,
                                                             3, 0, 3, 1, 4, 5, 7, 4, 7, 6})}})}});
    return builder;
}

PatchMesh with_size(Scene& scene, float size) {
    TessellationSettings settings;
    settings.patch_size = size;
    return tessellate(scene, settings);
}

PatchMesh with_count(Scene& scene, std::size_t count) {
    TessellationSettings settings;
    settings.target_patches = count;
    return tessellate(scene, settings);
}

TEST(SceneTessellation, NoEdgeIsLongerThanAsked) {
    Scene scene = crooked_box().load();
    for (const float size : {10.0F, 1.0F, 0.3F, 0.07F}) {
        const PatchMesh mesh = with_size(scene, size);
        EXPECT_LE(longest_edge(scene, mesh), size * 1.0001F);
    }
    EXPECT_EQ(with_size(scene, 10.0F).triangle_count(), 12U);
}

TEST(SceneTessellation, SizeIsMeasuredInWorldSpace) {
    GltfBuilder builder = crooked_box();
    builder.json["nodes"][0]["scale"] = {0.1, 0.1, 0.1};
    Scene scene = builder.load();
    EXPECT_EQ(with_size(scene, 1.0F).triangle_count(), 12U);
    const PatchMesh mesh = with_size(scene, 0.05F);
    EXPECT_LE(longest_edge(scene, mesh), 0.05F * 1.0001F);
}

TEST(SceneTessellation, ClosedMeshesStayClosed) {
    Scene scene = crooked_box().load();
    const PatchMesh mesh = with_size(scene, 0.11F);
    for (const auto& [edge, uses] : edge_uses(mesh)) {
        ASSERT_EQ(uses, 2);
    }
    EXPECT_NEAR(total_area(mesh), total_area(with_size(scene, 10.0F)), 1e-4);
}

TEST(SceneTessellation, TwoPrimitivesOfOneObjectConform) {
    // A small and a large triangle share an edge but not their vertices, normals or material.
    GltfBuilder builder;
    const int left = builder.add_positions({{0, 0, 0}, {0, 1, 0}, {-0.1F, 0.5F, 0}});
    const int right = builder.add_positions({{0, 1, 0}, {0, 0, 0}, {8, 0.5F, 1}});
    builder.json["meshes"].push_back(
        {{"primitives",
          {{{"attributes", {{"POSITION", left}}}}, {{"attributes", {{"POSITION", right}}}}}}});
    builder.add_node({{"mesh", 0}});
    Scene scene = builder.load();
    const PatchMesh mesh = with_size(scene, 0.2F);
    int shared = 0;
    for (const auto& [edge, uses] : edge_uses(mesh)) {
        const bool on_seam = std::get<1>(edge.first) == 0.0F && std::get<1>(edge.second) == 0.0F;
        if (on_seam) {
            ++shared;
            EXPECT_EQ(uses, 2);
        }
    }
    EXPECT_GE(shared, 5);
}

TEST(SceneTessellation, CountIsNearTheTarget) {
    for (const std::size_t target :
         {std::size_t{1000}, std::size_t{25'000}, std::size_t{100'000}}) {
        Scene scene = crooked_box().load();
        const auto count = static_cast<double>(with_count(scene, target).patch_count());
        EXPECT_NEAR(count, static_cast<double>(target), 0.25 * static_cast<double>(target));
    }
}

TEST(SceneTessellation, BackSidesCountAsPatches) {
    GltfBuilder builder = crooked_box();
    builder.json["meshes"][0]["primitives"][0]["material"] =
        builder.add_material({{"doubleSided", true}});
    Scene scene = builder.load();
    for (Triangle& triangle : scene.triangles) {
        triangle.solid = false;  // as if the box were open somewhere
    }
    const PatchMesh mesh = with_count(scene, 10'000);
    EXPECT_EQ(mesh.patch_count(), 2 * mesh.triangle_count());
    EXPECT_NEAR(static_cast<double>(mesh.patch_count()), 10'000.0, 2500.0);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        EXPECT_EQ(mesh.side_triangle[t], t);
        EXPECT_EQ(mesh.side_triangle[mesh.back_side[t]], t);
    }
}

TEST(SceneTessellation, IsDeterministic) {
    Scene scene = crooked_box().load();
    Scene again = crooked_box().load();
    const PatchMesh a = with_count(scene, 5000);
    const PatchMesh b = with_count(again, 5000);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.base_colour, b.base_colour);
}

TEST(SceneTessellation, DegenerateTrianglesChangeNothing) {
    Scene clean = crooked_box().load();
    GltfBuilder builder = crooked_box();
    std::vector<glm::vec3> needles;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> inside(0.2F, 0.8F);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 a(inside(random), inside(random), inside(random));
        // A point, a segment, or a sliver that fp32 cannot tell from one.
        needles.insert(needles.end(), {a, i % 3 == 0 ? a : a + glm::vec3(0.1F, 0, 0),
                                       i % 3 == 1 ? a : a + glm::vec3(0.05F, 0, 0)});
    }
    const int positions = builder.add_positions(needles);
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", positions}}}});
    Scene littered = builder.load();
    EXPECT_EQ(littered.removed.degenerate_triangles, 1000U);
    const PatchMesh a = with_count(clean, 5000);
    const PatchMesh b = with_count(littered, 5000);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.uvs, b.uvs);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.base_colour, b.base_colour);
    EXPECT_EQ(clean.bounds.min, littered.bounds.min);
    EXPECT_EQ(clean.bounds.max, littered.bounds.max);
}

TEST(SceneTessellation, VerticesAreWelded) {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_box_mesh({0, 0, 0}, {1, 1, 1})}});
    Scene scene = builder.load();
    // Flat normals: each of the six faces has four corners of its own.
    EXPECT_EQ(with_size(scene, 10.0F).positions.size(), 24U);
}

TEST(SceneTessellation, TooManyPatchesAreAnError) {
    Scene scene = crooked_box().load();
    TessellationSettings settings;
    settings.patch_size = 1e-6F;
    settings.max_patches = 100'000;
    EXPECT_THROW((void)tessellate(scene, settings), SceneError);
    settings.patch_size = 0.0F;
    settings.max_patches = 5;
    EXPECT_THROW((void)tessellate(scene, settings), SceneError);
}

TEST(SceneTessellation, FarFromTheOriginItStillEnds) {
    GltfBuilder builder = crooked_box();
    builder.json["nodes"][0]["translation"] = {1e6, 0, 0};
    Scene scene = builder.load();
    EXPECT_GT(with_count(scene, 1000).patch_count(), 500U);
}

/// A slab of 6 x 0.2 x 4 m, its top at height 0, and a box as another object.
Scene slab_with_box(const glm::vec3& low, const glm::vec3& high) {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_box_mesh({0, -0.2F, 0}, {6, 0, 4})}});
    builder.add_node({{"mesh", builder.add_box_mesh(low, high)}});
    return builder.load();
}

/// Triangles of the slab's top whose corners lie on both sides of the plane x = at.
int top_triangles_across(const PatchMesh& mesh, float at) {
    constexpr float rounding = 1e-4F;  // m
    int count = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        float low = 1e30F;
        float high = -1e30F;
        bool on_top = mesh.vertex_object[t.x] == 0;
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& p = mesh.positions[t[k]];
            low = std::min(low, p.x);
            high = std::max(high, p.x);
            on_top = on_top && p.y == 0.0F;
        }
        count += on_top && low < at - rounding && high > at + rounding ? 1 : 0;
    }
    return count;
}

TEST(ContactLines, AWallCutsTheFloorItStandsOn) {
    for (const float foot : {0.0F, 0.001F, -0.3F}) {  // on the floor, just above it, through it
        Scene scene = slab_with_box({2.37F, foot, 0}, {2.71F, 3, 4});
        const PatchMesh mesh = with_size(scene, 0.5F);
        EXPECT_EQ(top_triangles_across(mesh, 2.37F), 0) << foot;
        EXPECT_EQ(top_triangles_across(mesh, 2.71F), 0) << foot;
        EXPECT_GT(top_triangles_across(mesh, 1.03F), 0) << "nothing to cut it there";
        EXPECT_LE(longest_edge(scene, mesh), 0.5F * 1.0001F);
        for (const auto& [edge, uses] : edge_uses(mesh)) {
            ASSERT_EQ(uses, 2);
        }
        const double height = 3.0 - double{foot};
        const double area = 2 * (24 + 1.2 + 0.8) + 2 * (0.34 * 4 + (0.34 + 4) * height);
        EXPECT_NEAR(total_area(mesh), area, 1e-4 * area);
    }
}

TEST(ContactLines, ATallGapOrASmallFootCutsNothing) {
    Scene gap = slab_with_box({2.37F, 0.1F, 0}, {2.71F, 3, 4});
    EXPECT_GT(top_triangles_across(with_size(gap, 0.5F), 2.37F), 0);
    Scene pillar = slab_with_box({2.37F, 0, 1}, {2.71F, 3, 1.4F});
    EXPECT_GT(top_triangles_across(with_size(pillar, 0.5F), 2.37F), 0);
}

TEST(ContactLines, NoSliversBesideACorner) {
    // Its foot ends 1 cm from the floor's edge, its other side stands on it.
    Scene scene = slab_with_box({5.5F, 0, 0}, {5.99F, 3, 4});
    const std::vector<ContactLine> lines = find_contact_lines(scene, 0.5);
    EXPECT_FALSE(lines.empty());
    const PatchMesh mesh = with_size(scene, 0.5F);
    EXPECT_EQ(top_triangles_across(mesh, 5.5F), 0);
    EXPECT_GT(top_triangles_across(mesh, 5.99F), 0);
}

TEST(ContactLines, CutPiecesInterpolateTheirCorners) {
    // What varies over a face is the same function of the place after it was cut.
    GltfBuilder builder;
    const std::vector<glm::vec3> corners = {{0, 0, 0}, {0, 0, 4}, {6, 0, 4}, {6, 0, 0}};
    const std::vector<glm::vec2> uvs = {{0, 0}, {0, 4}, {6, 4}, {6, 0}};  // (x, z)
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes",
                                     {{"POSITION", builder.add_positions(corners)},
                                      {"TEXCOORD_0", builder.add_uvs(uvs)}}},
                                    {"indices", builder.add_indices({0, 1, 2, 0, 2, 3})}})}});
    builder.add_node({{"mesh", builder.add_box_mesh({2.37F, 0, 0}, {2.71F, 3, 4})}});
    Scene scene = builder.load();
    const PatchMesh mesh = with_size(scene, 0.5F);
    EXPECT_EQ(top_triangles_across(mesh, 2.37F), 0);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (mesh.vertex_object[v] == 0) {
            EXPECT_NEAR(mesh.uvs[v].x, mesh.positions[v].x, 1e-5);
            EXPECT_NEAR(mesh.uvs[v].y, mesh.positions[v].z, 1e-5);
        }
    }
}

}  // namespace
}  // namespace raybundle::test
