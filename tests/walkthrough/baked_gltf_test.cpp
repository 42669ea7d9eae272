// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/baked_gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "../unit/gltf_builder.h"
#include "oracle/scene_builder.h"
#include "scene/gltf/gltf_loader.h"
#include "walkthrough/walkthrough.h"

namespace raybundle {
namespace {

constexpr float pi = glm::pi<float>();

/// Written with light of so many lx on every patch, and loaded again.
Scene baked(Scene& scene, const PatchMesh& mesh, float irradiance, float exposure) {
    const test::TemporaryFolder parent;
    const NewFolder folder((parent.path() / "walk").string(), false);
    scene.cameras.resize(1);
    scene.cameras[0].name = "door";
    scene.cameras[0].eye = {1.0F, 2.0F, 3.0F};
    scene.cameras[0].target = {1.0F, 2.0F, 0.0F};
    const std::vector<glm::vec4> light(mesh.patch_count(), glm::vec4(irradiance));
    write_walkthrough({scene, mesh, light, {}}, client_files(), shader_files(), exposure, folder);
    return load_gltf(folder.file("scene.glb").string());
}

TEST(BakedGltf, IsLoadedWithItsLightAsColours) {
    SceneBuilder builder;
    const auto wall = builder.add_material(glm::vec3(0.5F, 0.25F, 1.0F));
    const auto lamp = builder.add_material(glm::vec3(0.0F), glm::vec3(40.0F));
    builder.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 3, wall);
    builder.add_quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, 1, lamp);
    const Scene scene = baked(builder.scene, builder.mesh, pi * 10.0F, 0.01F);
    ASSERT_EQ(scene.triangles.size(), builder.mesh.triangle_count());
    for (const Triangle& triangle : scene.triangles) {
        EXPECT_TRUE(scene.materials[triangle.material].unlit);
        for (const std::uint32_t v : triangle.vertex) {
            const bool lit = scene.vertices[v].position.z > 0.5F;
            const glm::vec3 expected = lit ? glm::vec3(0.4F) : glm::vec3(0.05F, 0.025F, 0.0999F);
            EXPECT_NEAR(scene.vertices[v].colour.r, expected.r, 1e-4F);
            EXPECT_NEAR(scene.vertices[v].colour.g, expected.g, 1e-4F);
            EXPECT_NEAR(scene.vertices[v].colour.b, expected.b, 2e-4F);
        }
    }
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].name, "door");
    EXPECT_NEAR(glm::length(scene.cameras[0].eye - glm::vec3(1, 2, 3)), 0.0F, 1e-5F);
}

TEST(BakedGltf, BacksAreTrianglesOfTheirOwn) {
    SceneBuilder builder;
    Material sheet;
    sheet.specular = 0.0F;
    sheet.metallic = 0.0F;
    sheet.base_colour = glm::vec3(0.5F);
    sheet.double_sided = true;
    builder.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1, builder.add_material(sheet));
    Scene solved = builder.loaded_scene();
    const PatchMesh mesh = tessellate(solved, {.patch_size = 0.4F});
    const Scene scene = baked(solved, mesh, pi, 1.0F);
    ASSERT_EQ(scene.triangles.size(), 2 * mesh.triangle_count());
    float sum = 0.0F;
    for (const Triangle& triangle : scene.triangles) {
        EXPECT_FALSE(two_sided(scene, triangle));
        sum += test::world_normal(scene, triangle).z;
    }
    EXPECT_NEAR(sum, 0.0F, 1e-5F);
}

TEST(BakedGltf, WhatIsBrighterThanWhiteIsWhite) {
    SceneBuilder builder;
    const auto lamp = builder.add_material(glm::vec3(0.0F), glm::vec3(1e6F, 1.0F, 0.0F));
    builder.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1, lamp);
    const Scene scene = baked(builder.scene, builder.mesh, 0.0F, 0.5F);
    EXPECT_FLOAT_EQ(scene.vertices[0].colour.r, 1.0F);
    EXPECT_NEAR(scene.vertices[0].colour.g, 0.5F, 1e-4F);
    EXPECT_FLOAT_EQ(scene.vertices[0].colour.b, 0.0F);
}

}  // namespace
}  // namespace raybundle
