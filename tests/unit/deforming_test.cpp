// SPDX-License-Identifier: Apache-2.0
// Skins and morph targets that animations move, against formulas of the tests' own.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>

#include "gltf_builder.h"
#include "scene/animation/shape_pose.h"
#include "scene/animation_script.h"
#include "scene/mesh/geometry_defects.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::test {
namespace {

const std::string data_folder = RAYBUNDLE_SHARED_DATA;

/// Corners of all triangles of an object, in the world.
std::vector<glm::vec3> corners_of(const Scene& scene, std::uint32_t object) {
    std::vector<glm::vec3> corners;
    for (const Triangle& triangle : scene.triangles) {
        if (triangle.object == object) {
            const auto three = world_corners(scene, triangle);
            corners.insert(corners.end(), three.begin(), three.end());
        }
    }
    return corners;
}

void expect_same_vertices(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
        EXPECT_EQ(a.vertices[v].position, b.vertices[v].position) << v;
        EXPECT_EQ(a.vertices[v].normal, b.vertices[v].normal) << v;
    }
}

class DeformingFile : public testing::Test {
  protected:
    int floats(const std::vector<float>& values, const char* type, std::size_t components) {
        return builder.add_accessor(builder.add_view_of(values), 5126, values.size() / components,
                                    type);
    }
    void animate(int node, const char* path, const std::vector<float>& times,
                 const std::vector<float>& values, const char* type, std::size_t components,
                 const char* how = "LINEAR") {
        const Json sampler = {{"input", floats(times, "SCALAR", 1)},
                              {"output", floats(values, type, components)},
                              {"interpolation", how}};
        builder.json["animations"].push_back(
            {{"name", path},
             {"samplers", Json::array({sampler})},
             {"channels",
              Json::array({{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}})}});
    }

    DeformingFile() {
        builder.json["scenes"][0]["nodes"] = Json::array();
        builder.json["nodes"] = Json::array();
        builder.add_node(
            {{"name", "floor"}, {"mesh", builder.add_box_mesh({-9, -1, -9}, {9, 0, 9})}});
    }

    GltfBuilder builder;
};

/// An upright strip of three rows: the lowest follows the lower joint, the highest the upper one,
/// which stands 1 above it, and the middle one both by half.
class SkinnedStrip : public DeformingFile {
  protected:
    SkinnedStrip() {
        for (const float y : {0.0F, 1.0F, 2.0F}) {
            rest.emplace_back(-0.5F, y, 0.0F);
            rest.emplace_back(0.5F, y, 0.0F);
        }
        const int positions = builder.add_positions(rest);
        const int normals = builder.add_positions(std::vector<glm::vec3>(6, {0, 0, 1}));
        std::vector<std::uint8_t> joints;
        std::vector<float> weights;
        for (int v = 0; v < 6; ++v) {
            joints.insert(joints.end(), {0, 1, 0, 0});
            const float share = 0.5F * static_cast<float>(v / 2);
            weights.insert(weights.end(), {1.0F - share, share, 0.0F, 0.0F});
        }
        const int joint = builder.add_accessor(builder.add_view_of(joints), 5121, 6, "VEC4");
        const int weight = floats(weights, "VEC4", 4);
        const int indices = builder.add_indices({0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4});
        const int mesh = builder.add_mesh({{"attributes",
                                            {{"POSITION", positions},
                                             {"NORMAL", normals},
                                             {"JOINTS_0", joint},
                                             {"WEIGHTS_0", weight}}},
                                           {"indices", indices}});
        upper = builder.add_node({{"translation", {0, 1, 0}}}, false);
        const int lower =
            builder.add_node({{"translation", {0, 3, 0}}, {"children", {upper}}}, true);
        std::vector<float> binds(32, 0.0F);
        for (const std::size_t m : {0U, 16U}) {
            binds[m] = binds[m + 5] = binds[m + 10] = binds[m + 15] = 1.0F;
        }
        binds[16 + 13] = -1.0F;  // of the upper joint
        builder.json["skins"] = {
            {{"joints", {lower, upper}}, {"inverseBindMatrices", floats(binds, "MAT4", 16)}}};
        // The transform of the skinned node itself does not count.
        builder.add_node({{"name", "strip"}, {"mesh", mesh}, {"skin", 0}, {"scale", {2, 3, 4}}});
        // 90 degrees about x, with the sine and cosine of 45.
        const float half = std::sqrt(0.5F);
        animate(upper, "rotation", {0, 1}, {0, 0, 0, 1, half, 0, 0, half}, "VEC4", 4);
    }

    /// Of a vertex while the upper joint is turned by so much about x.
    [[nodiscard]] glm::vec3 turned(const glm::vec3& p, double angle) const {
        const double above = p.y - 1.0;  // the upper joint
        const double share = 0.5 * double{p.y};
        const glm::dvec3 lower(p.x, p.y + 3.0, p.z);
        const glm::dvec3 above_it(p.x, 4.0 + above * std::cos(angle), above * std::sin(angle));
        return glm::vec3((1.0 - share) * lower + share * above_it);
    }

    std::vector<glm::vec3> rest;
    int upper = 0;
};

TEST_F(SkinnedStrip, FollowsItsJoints) {
    Scene scene = builder.load();
    ASSERT_NE(scene.animations, nullptr);
    const Animation& bend = scene.animations->animations.at(0);
    EXPECT_EQ(bend.shapes, std::vector<std::uint32_t>{1});
    EXPECT_TRUE(only_deforms(bend));
    const std::vector<std::size_t> order = {0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4};
    for (const double seconds : {0.0, 0.25, 0.5, 1.0, 7.0}) {
        const AnimationPlace place[] = {{0, seconds}};
        pose_shapes(scene, place);
        const double angle = glm::half_pi<double>() * std::min(seconds, 1.0);
        const std::vector<glm::vec3> corners = corners_of(scene, 1);
        ASSERT_EQ(corners.size(), order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            EXPECT_LT(glm::distance(corners[i], turned(rest[order[i]], angle)), 1e-5F)
                << seconds << " s, corner " << i;
            EXPECT_TRUE(
                glm::all(glm::greaterThanEqual(corners[i], scene.bounds.min - glm::vec3(1e-5F))));
            EXPECT_TRUE(
                glm::all(glm::lessThanEqual(corners[i], scene.bounds.max + glm::vec3(1e-5F))));
        }
    }
}

/// The uppermost row turns as a whole, and so do its normals; the lowest one stays.
TEST_F(SkinnedStrip, NormalsTurnWithIt) {
    Scene scene = builder.load();
    const AnimationPlace place[] = {{0, 1.0}};
    ASSERT_TRUE(pose_shapes(scene, place));
    for (const Triangle& triangle : scene.triangles) {
        for (const std::uint32_t v : triangle.vertex) {
            const Object& object = scene.objects[triangle.object];
            if (object.name != "strip") {
                continue;
            }
            const glm::mat3 world(object.world_from_object());
            const glm::vec3 normal =
                glm::normalize(glm::transpose(glm::inverse(world)) * scene.vertices[v].normal);
            const glm::vec3 at =
                object.world_from_object() * glm::vec4(scene.vertices[v].position, 1.0F);
            if (at.z > 0.9F) {
                EXPECT_LT(glm::distance(normal, glm::vec3(0, -1, 0)), 1e-5F);
            } else if (at.y < 3.1F) {
                EXPECT_LT(glm::distance(normal, glm::vec3(0, 0, 1)), 1e-5F);
            }
        }
    }
}

TEST_F(SkinnedStrip, ComesBackToTheBit) {
    const Scene loaded = builder.load();
    Scene scene = loaded;
    EXPECT_FALSE(pose_shapes(scene, {}));
    const AnimationPlace place[] = {{0, 0.7}};
    EXPECT_TRUE(pose_shapes(scene, place));
    EXPECT_FALSE(pose_shapes(scene, place));
    EXPECT_TRUE(pose_shapes(scene, {}));
    expect_same_vertices(scene, loaded);
    EXPECT_EQ(scene.objects[1].bounds.min, loaded.objects[1].bounds.min);
    EXPECT_EQ(scene.objects[1].bounds.max, loaded.objects[1].bounds.max);
}

/// A file whose joint stands where the animation would have it is the same scene.
TEST_F(SkinnedStrip, IsAsAFileInThatPose) {
    for (const float metres : {1.0F, 0.01F}) {
        SceneSettings settings;
        settings.metres_per_unit = metres;
        builder.json["nodes"][static_cast<std::size_t>(upper)].erase("rotation");
        Scene scene = builder.load(settings);
        const AnimationPlace place[] = {{0, 0.5}};
        ASSERT_TRUE(pose_shapes(scene, place));
        const double eighth = glm::radians(22.5);
        builder.json["nodes"][static_cast<std::size_t>(upper)]["rotation"] = {
            std::sin(eighth), 0.0, 0.0, std::cos(eighth)};
        const Scene posed = builder.load(settings);
        ASSERT_EQ(scene.triangles.size(), posed.triangles.size());
        const std::vector<glm::vec3> a = corners_of(scene, 1);
        const std::vector<glm::vec3> b = corners_of(posed, 1);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_LT(glm::distance(a[i], b[i]), 2e-6F * metres) << i;
        }
    }
}

/// A script that names the animation has it at its time, and before that time at rest.
TEST_F(SkinnedStrip, AScriptNamesTheAnimation) {
    Scene scene = builder.load();
    const AnimationScript script(
        R"({"frames": 1, "keys": [{"time": 1, "animation": "rotation", "seconds": 0.5,
            "speed": 0}]})",
        "script", scene, scene.cameras.front());
    EXPECT_FALSE(script.playback().deform(scene, 0.5));
    EXPECT_TRUE(script.playback().deform(scene, 1.0));
    EXPECT_FALSE(script.playback().deform(scene, 2.0));
    const std::vector<glm::vec3> corners = corners_of(scene, 1);
    const glm::vec3 expected = turned(rest[5], glm::radians(45.0));
    EXPECT_LT(glm::distance(corners[8], expected), 1e-5F);
}

/// What is cut into patches after that lies on the bent strip.
TEST_F(SkinnedStrip, PatchesLieOnIt) {
    Scene scene = builder.load();
    const AnimationPlace place[] = {{0, 1.0}};
    ASSERT_TRUE(pose_shapes(scene, place));
    double expected = 0.0;
    for (const Triangle& triangle : scene.triangles) {
        if (triangle.object == 1) {
            const auto p = world_corners(scene, triangle);
            expected += 0.5 * double{glm::length(glm::cross(p[1] - p[0], p[2] - p[0]))};
        }
    }
    const PatchMesh mesh = tessellate(scene, {});
    double area = 0.0;
    const glm::mat4 world = scene.objects[1].world_from_object();
    for (const glm::uvec3& triangle : mesh.triangles) {
        if (mesh.vertex_object[triangle.x] == 1) {
            glm::vec3 p[3];
            for (int k = 0; k < 3; ++k) {
                p[k] = world * glm::vec4(mesh.positions[triangle[k]], 1.0F);
            }
            area += 0.5 * double{glm::length(glm::cross(p[1] - p[0], p[2] - p[0]))};
        }
    }
    EXPECT_NEAR(area, expected, 1e-5 * expected);
}

/// A triangle with two targets, without normals: its corner is at base + sum of weight and offset,
/// and its normal is that of the plane.
class MorphedTriangle : public DeformingFile {
  protected:
    MorphedTriangle() {
        const int base = builder.add_positions({{0, 1, 0}, {1, 1, 0}, {0, 2, 0}});
        const int first = builder.add_positions({{0, 0, 0}, {0, 0, 0}, {0, 0, 2}});
        const int second = builder.add_positions({{0, 0, 0}, {3, 0, 0}, {0, 0, 0}});
        const int mesh =
            builder.add_mesh({{"attributes", {{"POSITION", base}}},
                              {"targets", {{{"POSITION", first}}, {{"POSITION", second}}}}});
        builder.json["meshes"][static_cast<std::size_t>(mesh)]["weights"] = {0.0, 0.25};
        node = builder.add_node({{"name", "flag"}, {"mesh", mesh}, {"translation", {0, 5, 0}}});
    }
    int node = 0;
};

TEST_F(MorphedTriangle, FollowsItsWeights) {
    animate(node, "weights", {1, 2}, {0, 1, 1, 0.5F}, "SCALAR", 1);
    const Scene loaded = builder.load();
    Scene scene = loaded;
    ASSERT_NE(scene.animations, nullptr);
    EXPECT_NEAR(corners_of(scene, 1)[1].x, 1.75F, 1e-6F);
    EXPECT_FALSE(pose_shapes(scene, {}));
    for (const double t : {0.0, 0.5, 1.0}) {
        const AnimationPlace place[] = {{0, 1.0 + t}};
        EXPECT_TRUE(pose_shapes(scene, place));
        const auto at = static_cast<float>(t);
        const std::vector<glm::vec3> p = corners_of(scene, 1);
        EXPECT_LT(glm::distance(p[0], glm::vec3(0, 6, 0)), 1e-5F);
        EXPECT_LT(glm::distance(p[1], glm::vec3(1.0F + 3.0F * (1.0F - 0.5F * at), 6, 0)), 1e-5F);
        EXPECT_LT(glm::distance(p[2], glm::vec3(0, 7, 2.0F * at)), 1e-5F);
        const glm::vec3 normal = glm::normalize(glm::vec3(0.0F, -2.0F * at, 1.0F));
        for (const Triangle& triangle : scene.triangles) {
            if (triangle.object == 1) {
                EXPECT_LT(glm::distance(scene.vertices[triangle.vertex[0]].normal, normal), 1e-5F);
            }
        }
    }
    EXPECT_TRUE(pose_shapes(scene, {}));
    expect_same_vertices(scene, loaded);
}

/// Halfway a spline of Hermite is the mean of both values and an eighth of the way that their
/// tangents differ by; here of five weights, 2 s apart.
TEST_F(MorphedTriangle, SplinesMayHaveAnyNumberOfWeights) {
    const std::vector<float> values = {9, 9, 9, 9, 9, 1, 2, 3, 4, 5, 0, 1, 0, -1, 2,
                                       1, 0, 0, 1, 2, 3, 2, 1, 0, 7, 9, 9, 9, 9,  9};
    const KeyTrack track{Interpolation::cubic_spline, 5, {0.5F, 2.5F}, values};
    for (std::size_t c = 0; c < 5; ++c) {
        const float mean = 0.5F * (values[5 + c] + values[20 + c]);
        EXPECT_FLOAT_EQ(track.component_at(1.5, c),
                        mean + 0.25F * (values[10 + c] - values[15 + c]));
        EXPECT_FLOAT_EQ(track.component_at(0.0, c), values[5 + c]);
        EXPECT_FLOAT_EQ(track.component_at(9.0, c), values[20 + c]);
    }
}

TEST_F(MorphedTriangle, TooFewWeightsAreAProblem) {
    animate(node, "weights", {1, 2}, {0, 1, 1}, "SCALAR", 1);
    const Scene scene = builder.load();
    EXPECT_EQ(scene.animations, nullptr);
    EXPECT_TRUE(has_notice(scene, "the animation is left out"));
}

/// What has lost its area is left out of the mesh, and only as long as that is so.
TEST_F(MorphedTriangle, TrianglesMayLoseTheirArea) {
    builder.json["meshes"][1]["weights"] = {0.0, 0.0};
    animate(node, "weights", {0, 1}, {0, 0, 0, -1.0F / 3.0F}, "SCALAR", 1);
    Scene scene = builder.load();
    const std::vector<Triangle> all = scene.triangles;
    const AnimationPlace place[] = {{0, 1.0}};
    EXPECT_TRUE(pose_shapes(scene, place));
    remove_degenerate_triangles(scene);
    EXPECT_EQ(scene.triangles.size() + 1, all.size());
    EXPECT_GT(tessellate(scene, {}).patch_count(), 0U);
    scene.triangles = all;
    EXPECT_TRUE(pose_shapes(scene, {}));
    remove_degenerate_triangles(scene);
    EXPECT_EQ(scene.triangles.size(), all.size());
}

/// Khronos' example: two joints 1 above zero, the upper one turned about z by 90 degrees at 1 s,
/// and by -90 at 4.5 s; the weights go from one to the other from y = 0 to y = 2.
TEST(DeformingFiles, SimpleSkinBends) {
    const std::string file = data_folder + "/animation/bevy_simple_skin/SimpleSkin.gltf";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "no third-party data beside the repository";
    }
    const Scene loaded = load_gltf(file);
    Scene scene = loaded;
    ASSERT_NE(scene.animations, nullptr);
    for (const auto& [seconds, sine] : {std::pair{1.0, 1.0}, std::pair{4.5, -1.0}}) {
        const AnimationPlace place[] = {{0, seconds}};
        ASSERT_TRUE(pose_shapes(scene, place));
        for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
            const auto before = world_corners(loaded, loaded.triangles[t]);
            const auto now = world_corners(scene, scene.triangles[t]);
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 p = before[k];
                const double share = 0.5 * p.y;
                const glm::dvec3 bent(-sine * (p.y - 1.0), 1.0 + sine * p.x, 0.0);
                EXPECT_LT(glm::distance(now[k], glm::vec3(glm::mix(p, bent, share))), 1e-3F)
                    << seconds << " s, " << p.x << ' ' << p.y;
            }
        }
    }
}

/// Of all animated files: at rest nothing changes, in motion something does, and every number is
/// finite.
TEST(DeformingFiles, OthersFilesDeform) {
    std::size_t deforming = 0;
    for (const char* folder : {"/animation", "/conformance"}) {
        if (!std::filesystem::exists(data_folder + folder)) {
            GTEST_SKIP() << "no third-party data beside the repository";
        }
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(data_folder + folder)) {
            const std::string end = entry.path().extension().string();
            if (end != ".gltf" && end != ".glb") {
                continue;
            }
            Scene scene;
            try {
                scene = load_gltf(entry.path().string());
            } catch (const SceneError&) {
                continue;
            }
            EXPECT_FALSE(pose_shapes(scene, {})) << entry.path();
            if (!scene.animations) {
                continue;
            }
            for (std::size_t a = 0; a < scene.animations->animations.size(); ++a) {
                if (scene.animations->animations[a].shapes.empty()) {
                    continue;
                }
                ++deforming;
                const double length = scene.animations->animations[a].seconds;
                bool changed = false;
                for (const double share : {0.0, 0.3, 0.6, 1.0}) {
                    const AnimationPlace place[] = {{a, share * length}};
                    changed = pose_shapes(scene, place) || changed;
                    for (const Vertex& vertex : scene.vertices) {
                        ASSERT_TRUE(std::isfinite(glm::dot(vertex.position, vertex.position)));
                        ASSERT_TRUE(std::isfinite(glm::dot(vertex.normal, vertex.normal)));
                    }
                }
                EXPECT_TRUE(changed || length == 0.0) << entry.path();
                pose_shapes(scene, {});
            }
        }
    }
    EXPECT_GE(deforming, 5U);
}

}  // namespace
}  // namespace raybundle::test
