// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/light_chunks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/scene_builder.h"
#include "scene/material/reflectance_table.h"
#include "walkthrough/surface_albedo.h"

namespace raybundle {
namespace {

std::vector<glm::vec4> ramp(std::size_t patches) {
    std::vector<glm::vec4> light;
    for (std::size_t i = 0; i < patches; ++i) {
        light.emplace_back(static_cast<float>(i + 1), 2.0F, 3.0F, 1.0F);
    }
    return light;
}

VertexLight light_of(const SceneBuilder& builder, const std::vector<glm::vec4>& irradiance) {
    return light_at_vertices(builder.mesh, world_positions(builder.scene, builder.mesh),
                             irradiance);
}

std::vector<LightChunk> chunks_of(const SceneBuilder& builder) {
    return make_light_chunks(builder.scene, builder.mesh,
                             light_of(builder, ramp(builder.mesh.patch_count())));
}

TEST(VertexLight, IsTheMeanOfThePatchesRoundAVertexByArea) {
    SceneBuilder builder;
    const auto material = builder.add_material(glm::vec3(0.5F));
    builder.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1, material);
    const VertexLight light = light_of(builder, {glm::vec4(1.0F), glm::vec4(3.0F)});
    ASSERT_EQ(builder.mesh.triangle_count(), 2U);
    for (std::uint32_t v = 0; v < builder.mesh.positions.size(); ++v) {
        const auto has = [&](std::size_t t) {
            const glm::uvec3& c = builder.mesh.triangles[t];
            return c.x == v || c.y == v || c.z == v;
        };
        const float expected = has(0) && has(1) ? 2.0F : has(0) ? 1.0F : 3.0F;
        EXPECT_FLOAT_EQ(light.front[v].r, expected);
    }
}

TEST(VertexLight, KeepsBothSidesApart) {
    SceneBuilder builder;
    Material material;
    material.double_sided = true;
    const auto sheet = builder.add_material(material);
    builder.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1, sheet);
    Scene scene = builder.loaded_scene();
    const PatchMesh mesh = tessellate(scene, {.patch_size = 0.4F});
    ASSERT_EQ(mesh.patch_count(), 2 * mesh.triangle_count());
    std::vector<glm::vec4> irradiance(mesh.patch_count(), glm::vec4(1.0F));
    std::fill(irradiance.begin() + static_cast<std::ptrdiff_t>(mesh.triangle_count()),
              irradiance.end(), glm::vec4(5.0F));
    const VertexLight light = light_at_vertices(mesh, world_positions(scene, mesh), irradiance);
    for (std::size_t v = 0; v < light.front.size(); ++v) {
        EXPECT_FLOAT_EQ(light.front[v].r, 1.0F);
        EXPECT_FLOAT_EQ(light.back[v].r, 5.0F);
    }
}

TEST(LightChunks, HaveEveryTriangleOnce) {
    SceneBuilder builder;
    const auto white = builder.add_material(glm::vec3(0.7F));
    const auto lamp = builder.add_material(glm::vec3(0.0F), glm::vec3(100.0F));
    builder.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 200, 180, white);  // 72 000 triangles
    builder.add_quad({0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 2, 2, lamp);
    builder.add_quad({0, 0, 3}, {1, 0, 0}, {0, 1, 0}, 200, 180, white);
    std::size_t triangles = 0;
    std::size_t lamps = 0;
    for (const LightChunk& chunk : chunks_of(builder)) {
        EXPECT_LE(chunk.positions.size(), LightChunk::most_vertices);
        EXPECT_EQ(chunk.front.size(), chunk.positions.size());
        EXPECT_TRUE(chunk.back.empty());
        EXPECT_LT(*std::max_element(chunk.indices.begin(), chunk.indices.end()),
                  chunk.positions.size());
        triangles += chunk.indices.size() / 3;
        lamps += chunk.emission == glm::vec3(100.0F) ? 1 : 0;
    }
    EXPECT_EQ(triangles, builder.mesh.triangle_count());
    EXPECT_EQ(lamps, 1U);
}

TEST(LightChunks, EmissionThatVariesStaysWithItsTriangle) {
    SceneBuilder builder;
    const auto screen = builder.add_material(glm::vec3(0.0F), glm::vec3(10.0F));
    builder.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2, screen);
    for (std::size_t t = 0; t < builder.mesh.triangle_count(); ++t) {
        builder.mesh.emission[t] = glm::vec3(static_cast<float>(t));
    }
    const std::vector<LightChunk> chunks = chunks_of(builder);
    ASSERT_EQ(chunks.size(), 1U);
    ASSERT_EQ(chunks[0].emissions.size(), chunks[0].positions.size());
    for (std::size_t i = 0; i < chunks[0].indices.size(); ++i) {
        EXPECT_EQ(chunks[0].emissions[chunks[0].indices[i]].r, static_cast<float>(i / 3));
    }
}

/// The file's triangle still has its front where the server sees it.
TEST(LightChunks, MirroredObjectsKeepTheirFronts) {
    SceneBuilder builder;
    const auto white = builder.add_material(glm::vec3(0.7F));
    Transform mirrored;
    mirrored.scale = {-1.0F, 1.0F, 1.0F};
    builder.add_object("mirrored", mirrored);
    builder.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, white);
    const std::vector<LightChunk> chunks = chunks_of(builder);
    ASSERT_EQ(chunks.size(), 1U);
    const LightChunk& chunk = chunks[0];
    const auto corner = [&](std::size_t i) { return chunk.positions[chunk.indices[i]]; };
    const glm::vec3 normal =
        glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    EXPECT_NEAR(normal.z, 1.0F, 1e-6F);
    EXPECT_NEAR(chunk.normals[0].z, 1.0F, 1e-6F);
}

TEST(SurfaceAlbedo, IsThatOfTheReflectanceTable) {
    SceneBuilder builder;
    Material gold;
    gold.base_colour = {0.9F, 0.6F, 0.2F};
    gold.metallic = 1.0F;
    gold.roughness = 0.5F;
    Material varnish;
    varnish.base_colour = {0.4F, 0.2F, 0.1F};
    varnish.metallic = 0.0F;
    varnish.roughness = 0.3F;
    for (const Material& material : {gold, varnish}) {
        builder.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1, builder.add_material(material));
    }
    const auto rows = surface_albedos(builder.scene, builder.mesh);
    for (const Material& material : {gold, varnish}) {
        const auto index = static_cast<std::size_t>(material.metallic > 0.5F ? 0 : 1) +
                           builder.scene.materials.size() - 2;
        ASSERT_TRUE(rows[index].has_value());
        const ReflectanceTable table(make_brdf(material, material.base_colour));
        for (std::size_t i = 0; i < rows[index]->size(); ++i) {
            const glm::vec4& row = (*rows[index])[i];
            const glm::vec3 expected = table.albedo(albedo_cosine(i));
            const glm::vec3 found = glm::vec3(row) + row.a * material.base_colour;
            EXPECT_NEAR(found.r, expected.r, 2e-3F) << material.metallic << " node " << i;
            EXPECT_NEAR(found.b, expected.b, 2e-3F) << material.metallic << " node " << i;
        }
    }
}

TEST(Transparency, IsThatOfGlassAlone) {
    SceneBuilder builder;
    Material pane;
    pane.base_colour = glm::vec3(1.0F);
    pane.metallic = 0.0F;
    pane.roughness = 0.0F;
    pane.transmission = 1.0F;
    const auto glass = builder.add_material(pane);
    const auto wall = builder.add_material(glm::vec3(0.7F));
    // Both faces of index 1.5 reflect 4 %, again and again: 2 n / (n^2 + 1) passes.
    EXPECT_NEAR(transparency(builder.scene, glass).g, 3.0F / 3.25F, 1e-3F);
    EXPECT_EQ(transparency(builder.scene, wall), glm::vec3(0.0F));
}

}  // namespace
}  // namespace raybundle
