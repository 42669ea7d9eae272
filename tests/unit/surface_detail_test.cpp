// SPDX-License-Identifier: Apache-2.0
// Textures of roughness, metalness and normals, vertex colours and unlit materials, by closed
// forms.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "gltf_builder.h"
#include "scene/edit/surface_edit.h"
#include "scene/material/brdf.h"
#include "scene/material/normal_map.h"
#include "scene/material/reflectance_grid.h"
#include "scene/material/texture_mean.h"
#include "scene/mesh/patch_colour.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::test {
namespace {

/// The unit square in the plane z = 0, seen from +z, v pointing down as in glTF.
const TangentEdges upright{{1, 0, 0}, {1, 1, 0}, {1, 0}, {1, -1}};
constexpr glm::dvec3 towards_us{0.0, 0.0, 1.0};

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double bound = 1e-12) {
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(found[k], expected[k], bound) << "component " << k;
    }
}

/// Texel of a unit normal.
glm::dvec3 texel_of(const glm::dvec3& n) {
    return 0.5 * n + 0.5;
}

TEST(NormalMap, RedTiltsToTheRightAndGreenUpwards) {
    const glm::dvec3 right = glm::normalize(glm::dvec3(1, 0, 2));
    const glm::dvec3 up = glm::normalize(glm::dvec3(0, 1, 2));
    expect_near(mapped_normal(upright, towards_us, texel_of(towards_us), 1.0), towards_us);
    expect_near(mapped_normal(upright, towards_us, texel_of(right), 1.0), right);
    expect_near(mapped_normal(upright, towards_us, texel_of(up), 1.0), up);
}

TEST(NormalMap, MirroredImagesTiltTheOtherWay) {
    TangentEdges mirrored = upright;
    mirrored.uv1.x = -1.0;
    mirrored.uv2.x = -1.0;
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.4, 1.0));
    expect_near(mapped_normal(mirrored, towards_us, texel_of(n), 1.0), {-n.x, n.y, n.z});
}

TEST(NormalMap, TurnsWithItsImage) {
    // A quarter turn: u grows upwards, v to the right.
    const TangentEdges turned{{1, 0, 0}, {1, 1, 0}, {0, 1}, {1, 1}};
    const glm::dvec3 n = glm::normalize(glm::dvec3(1, 0, 1));
    expect_near(mapped_normal(turned, towards_us, texel_of(n), 1.0),
                glm::normalize(glm::dvec3(0, 1, 1)));
}

TEST(NormalMap, ScaleStretchesTheTilt) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(1, 0, 4));
    expect_near(mapped_normal(upright, towards_us, texel_of(n), 2.0),
                glm::normalize(glm::dvec3(1, 0, 2)));
    expect_near(mapped_normal(upright, towards_us, texel_of(n), 0.0), towards_us);
}

TEST(NormalMap, KeepsToSmoothNormalsAndSurvivesBadUv) {
    const glm::dvec3 smooth = glm::normalize(glm::dvec3(0.5, 0.2, 1.0));
    expect_near(mapped_normal(upright, smooth, texel_of(towards_us), 1.0), smooth);
    TangentEdges none = upright;
    none.uv2 = 2.0 * none.uv1;
    expect_near(mapped_normal(none, smooth, {1.0, 0.5, 0.5}, 1.0), smooth);
    const glm::dvec3 inward = mapped_normal(upright, towards_us, {0.9, 0.5, 0.0}, 1.0);
    EXPECT_GT(inward.z, 0.0);
    EXPECT_NEAR(glm::length(inward), 1.0, 1e-12);
}

TEST(NormalMap, NormalsThatFaceAwayAreTurnedToTheViewer) {
    const glm::dvec3 eye = glm::normalize(glm::dvec3(1, 0, 0.2));
    const glm::dvec3 away = glm::normalize(glm::dvec3(-1, 0.5, 0.2));
    const glm::dvec3 turned = facing_normal(away, eye);
    EXPECT_NEAR(glm::dot(turned, eye), least_view_cosine, 1e-12);
    EXPECT_NEAR(glm::length(turned), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(turned, glm::cross(away, eye)), 0.0, 1e-12);
    expect_near(facing_normal(towards_us, eye), towards_us);
    expect_near(facing_normal(-eye, eye), eye);
}

// Under uniform light of radiance 1 a white surface reflects what its normal's hemisphere and the
// surface's own have in common: (1 + cos) / 2 of it (Lambert's form factor), never more than came.
TEST(NormalMap, CreatesNoEnergy) {
    for (const double angle : {0.0, 0.4, 0.9, 1.4}) {
        const glm::dvec3 n(std::sin(angle), 0.0, std::cos(angle));
        constexpr int steps = 400;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
            for (int k = 0; k < steps; ++k) {
                const double z = (i + 0.5) / steps;
                const double turn = 2.0 * glm::pi<double>() * (k + 0.5) / steps;
                const double s = std::sqrt(1.0 - z * z);
                const glm::dvec3 w(s * std::cos(turn), s * std::sin(turn), z);
                sum += std::max(glm::dot(n, w), 0.0) * 2.0 / (steps * double{steps});
            }
        }
        EXPECT_NEAR(sum, 0.5 * (1.0 + std::cos(angle)), 1e-3);
        EXPECT_LE(sum, 1.0 + 1e-4);
    }
}

/// A unit square with uv from 0 to 1, two texels side by side in texture 0.
GltfBuilder square_of(const Json& material, const std::vector<std::uint8_t>& rgba) {
    GltfBuilder builder;
    const int positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const int uvs = builder.add_uvs({{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    const int mesh =
        builder.add_mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
                          {"indices", builder.add_indices({0, 1, 2, 0, 2, 3})},
                          {"material", builder.add_material(material)}});
    builder.add_node({{"mesh", mesh}, {"name", "square"}});
    builder.json["images"] = {
        {{"bufferView", builder.add_view(png(2, 1, rgba))}, {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    return builder;
}

const std::vector<std::uint8_t> rough_metal_beside_smooth_plastic = {0, 204, 255, 255,  //
                                                                     0, 102, 0,   255};
const Json reflectance_textured = {{"pbrMetallicRoughness",
                                    {{"baseColorFactor", {0.8, 0.6, 0.4, 1}},
                                     {"roughnessFactor", 0.5},
                                     {"metallicFactor", 0.5},
                                     {"metallicRoughnessTexture", {{"index", 0}}}}}};

PatchMesh patches_of(Scene& scene, float size) {
    TessellationSettings settings;
    settings.patch_size = size;
    return tessellate(scene, settings);
}

TEST(ReflectanceTexture, PatchesTakeTheMeanOfDataThatIsNotEncoded) {
    Scene scene = square_of(reflectance_textured, rough_metal_beside_smooth_plastic).load();
    const PatchMesh whole = patches_of(scene, 2.0F);
    ASSERT_EQ(whole.metallic_roughness.size(), 2U);
    const glm::vec2 mean = 0.5F * (whole.metallic_roughness[0] + whole.metallic_roughness[1]);
    EXPECT_NEAR(mean.x, 0.25F, 0.02F);  // half of 0.5
    EXPECT_NEAR(mean.y, 0.3F, 0.01F);   // between 0.5 * 0.8 and 0.5 * 0.4

    const PatchMesh fine = patches_of(scene, 0.2F);
    for (std::size_t i = 0; i < fine.triangle_count(); ++i) {
        float right = 0.0F;
        for (int k = 0; k < 3; ++k) {
            right += fine.positions[fine.triangles[i][k]].x / 3.0F;
        }
        if (std::abs(right - 0.5F) > 0.2F) {
            EXPECT_NEAR(fine.metallic_roughness[i].x, right < 0.5F ? 0.5F : 0.0F, 1e-3F);
            EXPECT_NEAR(fine.metallic_roughness[i].y, right < 0.5F ? 0.4F : 0.2F, 1e-3F);
        }
    }
}

TEST(ReflectanceTexture, FactorsThatChangeReachThePatches) {
    Scene scene = square_of(reflectance_textured, rough_metal_beside_smooth_plastic).load();
    PatchMesh mesh = patches_of(scene, 2.0F);
    const glm::vec2 before = mesh.metallic_roughness[0];
    const std::uint32_t changed = apply(scene, MaterialEdit{1, {}, 1.0F, {}});
    refresh_surfaces(scene, {&changed, 1}, mesh);
    EXPECT_NEAR(mesh.metallic_roughness[0].y, 2.0F * before.y, 1e-5F);
    EXPECT_FLOAT_EQ(mesh.metallic_roughness[0].x, before.x);
}

TEST(ReflectanceTexture, ScenesWithoutOneHaveNoSuchArray) {
    Scene scene = square_of({{"name", "plain"}}, rough_metal_beside_smooth_plastic).load();
    EXPECT_TRUE(patches_of(scene, 0.5F).metallic_roughness.empty());
}

TEST(ReflectanceGrid, EveryPlaceIsItsOwnNearest) {
    const Scene scene = square_of(reflectance_textured, rough_metal_beside_smooth_plastic).load();
    const ReflectanceGrid grid(scene, scene.materials[0]);
    EXPECT_EQ(grid.roughness_levels, ReflectanceGrid::most_roughness_levels);
    EXPECT_EQ(grid.metallic_levels, ReflectanceGrid::most_metallic_levels);
    ASSERT_LE(grid.size(), 256U);  // pixels have eight bits for it
    for (std::size_t i = 0; i < grid.size(); ++i) {
        EXPECT_EQ(grid.nearest(grid.at(i)), i);
    }
    expect_near({grid.low.x, grid.low.y, 0}, {0.0, 0.2, 0}, 1e-6);
    expect_near({grid.high.x, grid.high.y, 0}, {0.5, 0.4, 0}, 1e-6);
}

// With 64 levels even the whole range of roughness is cut into steps of 5 %.
TEST(ReflectanceGrid, LobesAreWrongInWidthByASmallShareEverywhere) {
    Json whole_range = reflectance_textured;
    whole_range["pbrMetallicRoughness"]["roughnessFactor"] = 1;
    const Scene scene = square_of(whole_range, {0, 255, 0, 255, 0, 0, 0, 255}).load();
    const ReflectanceGrid grid(scene, scene.materials[0]);
    EXPECT_EQ(grid.metallic_levels, 1);
    for (float roughness = 0.05F; roughness <= 1.0F; roughness += 0.003F) {
        const glm::vec2 found = grid.at(grid.nearest({0.0F, roughness}));
        EXPECT_NEAR(found.y / roughness, 1.0F, 0.026F);
    }
}

TEST(ReflectanceGrid, OneTexelNeedsOnePlace) {
    const Scene scene = square_of(reflectance_textured, {9, 100, 50, 255, 7, 100, 50, 255}).load();
    EXPECT_EQ(ReflectanceGrid(scene, scene.materials[0]).size(), 1U);
}

TEST(TexturedReflectance, IsTheModelOfItsValues) {
    Material material;
    material.specular = 0.8F;
    material.specular_colour = {1.0F, 0.5F, 0.25F};
    const TexturedReflectance textured(material);
    for (const float metallic : {0.0F, 0.3F, 1.0F}) {
        for (const float roughness : {0.0F, 0.111F, 0.5F, 0.783F, 1.0F}) {
            const ReflectanceModel exact = reflectance_model(material, {metallic, roughness});
            const ReflectanceModel found = textured.at({metallic, roughness});
            EXPECT_EQ(found.f0, exact.f0);
            EXPECT_EQ(found.lambert_share, exact.lambert_share);
            EXPECT_EQ(found.lobe.alpha, exact.lobe.alpha);
            EXPECT_EQ(found.lobe.coating, exact.lobe.coating);
            EXPECT_NEAR(found.lobe.inverse_mean, exact.lobe.inverse_mean, 1e-4F);
        }
    }
}

TEST(GridTables, AlbedoNeverExceedsOne) {
    Scene scene = square_of(reflectance_textured, {0, 255, 255, 255, 0, 0, 0, 255}).load();
    scene.materials[0].base_colour = glm::vec3(1.0F);
    scene.materials[0].roughness = 1.0F;
    scene.materials[0].metallic = 1.0F;
    const ReflectanceGrid grid(scene, scene.materials[0]);
    const auto tables = grid_tables(grid, scene, scene.materials[0]);
    ASSERT_EQ(tables.size(), 64U);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const Brdf brdf =
            make_brdf(reflectance_model(scene.materials[0], grid.at(i)), glm::vec3(1.0F));
        const ReflectanceTable& table = tables[grid.roughness_level(i)];
        for (const float cosine : {0.02F, 0.3F, 1.0F}) {
            EXPECT_LE(table.albedo(brdf, cosine).r, 1.0F);
        }
        EXPECT_GT(table.mean_importance(), 0.0F);
    }
}

TEST(SurfaceTextures, AreReadWithTheirScaleAndUvSet) {
    const Scene scene =
        square_of({{"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                   {"occlusionTexture", {{"index", 0}}},
                   {"pbrMetallicRoughness",
                    {{"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}}}},
                  rough_metal_beside_smooth_plastic)
            .load();
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.normal_texture.texture, 0);
    EXPECT_FLOAT_EQ(material.normal_scale, 0.5F);
    EXPECT_EQ(material.metallic_roughness_texture.texture, 0);
    EXPECT_TRUE(has_notice(scene, "occlusion textures are ignored"));
    EXPECT_TRUE(has_notice(scene, "normal map is read with the uv of the first texture"));
}

/// A triangle with COLOR_0 at its corners: red, green, and black.
GltfBuilder coloured_triangle(bool bytes) {
    GltfBuilder builder;
    const int positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const std::vector<float> floats = {1, 0, 0, 0, 1, 0, 0, 0, 0};
    const std::vector<std::uint8_t> with_alpha = {255, 0, 0, 9, 0, 255, 0, 9, 0, 0, 0, 9};
    constexpr int unsigned_byte = 5121;
    constexpr int single = 5126;
    const int colours =
        bytes ? builder.add_accessor(builder.add_view_of(with_alpha), unsigned_byte, 3, "VEC4")
              : builder.add_accessor(builder.add_view_of(floats), single, 3, "VEC3");
    if (bytes) {
        builder.json["accessors"][static_cast<std::size_t>(colours)]["normalized"] = true;
    }
    const int mesh = builder.add_mesh(
        {{"attributes", {{"POSITION", positions}, {"COLOR_0", colours}}},
         {"material", builder.add_material(
                          {{"pbrMetallicRoughness",
                            {{"metallicFactor", 0}, {"baseColorFactor", {0.6, 0.9, 1, 1}}}}})}});
    builder.add_node({{"mesh", mesh}});
    return builder;
}

TEST(VertexColours, MultiplyTheBaseColourOfPatches) {
    for (const bool bytes : {false, true}) {
        Scene scene = coloured_triangle(bytes).load();
        const PatchMesh whole = patches_of(scene, 2.0F);
        ASSERT_EQ(whole.patch_count(), 1U);
        expect_near(glm::dvec3(whole.base_colour[0]), {0.2, 0.3, 0.0}, 1e-6);
        const PatchMesh fine = patches_of(scene, 0.2F);
        ASSERT_EQ(fine.colours.size(), fine.positions.size());
        for (std::size_t i = 0; i < fine.positions.size(); ++i) {
            const glm::vec3& p = fine.positions[i];
            expect_near(glm::dvec3(fine.colours[i]), {1.0F - p.x - p.y, p.x, 0.0}, 1e-5);
        }
    }
}

TEST(VertexColours, StayWhenAMaterialIsRepainted) {
    Scene scene = coloured_triangle(false).load();
    PatchMesh mesh = patches_of(scene, 2.0F);
    const std::uint32_t changed = apply(scene, MaterialEdit{1, glm::vec3(0.3F), {}, {}});
    refresh_surfaces(scene, {&changed, 1}, mesh);
    expect_near(glm::dvec3(mesh.base_colour[0]), {0.1, 0.1, 0.0}, 1e-6);
}

TEST(DiffuseTransmission, SharesTheLambertPartOut) {
    const Json material = {
        {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 1, 1}}, {"metallicFactor", 0.7}}},
        {"extensions",
         {{"KHR_materials_diffuse_transmission",
           {{"diffuseTransmissionFactor", 0.25},
            {"diffuseTransmissionColorFactor", {1, 0.5, 0}}}}}}};
    Scene scene = square_of(material, rough_metal_beside_smooth_plastic).load();
    const Material& cloth = scene.materials[0];
    expect_near(glm::dvec3(cloth.base_colour), {0.375, 0.75, 0.75}, 1e-6);
    expect_near(glm::dvec3(cloth.transmittance), 0.999 * glm::dvec3(0.25, 0.125, 0.0), 1e-6);
    EXPECT_TRUE(cloth.double_sided);
    EXPECT_EQ(make_brdf(cloth, cloth.base_colour).lobe.kind, LobeKind::none);
    EXPECT_TRUE(has_notice(scene, "thin, without gloss"));
    // What is repainted cannot send more than it receives, nor become metal.
    apply(scene, MaterialEdit{1, glm::vec3(1.0F), {}, {}});
    EXPECT_NEAR(scene.materials[0].base_colour.r, 0.999F - 0.999F * 0.25F, 1e-6F);
    EXPECT_NE(problem_of(scene, MaterialEdit{1, {}, {}, 1.0F}), "");
}

TEST(Unlit, IsBlackToLightAndDoesNotEmit) {
    Scene scene = square_of({{"emissiveFactor", {1, 1, 1}},
                             {"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.4, 0.6, 1}}}},
                             {"normalTexture", {{"index", 0}}},
                             {"extensions", {{"KHR_materials_unlit", Json::object()}}}},
                            rough_metal_beside_smooth_plastic)
                      .load();
    EXPECT_TRUE(scene.materials[0].unlit);
    EXPECT_EQ(scene.materials[0].normal_texture.texture, -1);
    EXPECT_TRUE(scene.lights.empty());
    const Brdf brdf = make_brdf(scene.materials[0], scene.materials[0].base_colour);
    EXPECT_EQ(evaluate(brdf, {0, 0, 1}, {0, 0, 1}), glm::vec3(0.0F));
    const PatchMesh mesh = patches_of(scene, 2.0F);
    EXPECT_EQ(mesh.base_colour[0], glm::vec3(0.0F));
    EXPECT_EQ(mesh.emission[0], glm::vec3(0.0F));
}

}  // namespace
}  // namespace raybundle::test
