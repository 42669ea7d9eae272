// SPDX-License-Identifier: Apache-2.0
// Materials, textures and what they make of a patch.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.h"
#include "scene/material/base_colour.h"
#include "scene/material/specular_surface.h"
#include "scene/material/texture_mean.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::test {
namespace {

/// A unit square with uv from 0 to 1, v pointing down as in glTF, and one material.
GltfBuilder square_with(const Json& material) {
    GltfBuilder builder;
    const int positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const int uvs = builder.add_uvs({{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    const int mesh =
        builder.add_mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
                          {"indices", builder.add_indices({0, 1, 2, 0, 2, 3})},
                          {"material", builder.add_material(material)}});
    builder.add_node({{"mesh", mesh}, {"name", "square"}});
    return builder;
}

void add_texture(GltfBuilder& builder, int width, int height,
                 const std::vector<std::uint8_t>& rgba) {
    builder.json["images"] = {
        {{"bufferView", builder.add_view(png(width, height, rgba))}, {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
}

Json textured(const Json& info) {
    return {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorTexture", info}}}};
}

PatchMesh patches_of(Scene& scene, float size) {
    TessellationSettings settings;
    settings.patch_size = size;
    return tessellate(scene, settings);
}

const std::vector<std::uint8_t> left_white_right_black = {255, 255, 255, 255, 0, 0, 0, 255};

TEST(SceneMaterial, FactorsAreRead) {
    const Scene scene =
        square_with({{"name", "paint"},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", {0.1, 0.2, 0.3, 0.5}},
                       {"metallicFactor", 0.25},
                       {"roughnessFactor", 0.75}}},
                     {"emissiveFactor", {1, 0.5, 0}},
                     {"doubleSided", true},
                     {"extensions",
                      {{"KHR_materials_emissive_strength", {{"emissiveStrength", 200}}},
                       {"KHR_materials_specular", {{"specularFactor", 0}}}}}})
            .load();
    ASSERT_EQ(scene.materials.size(), 1U);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.base_colour, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_FLOAT_EQ(material.alpha, 0.5F);
    EXPECT_FLOAT_EQ(material.metallic, 0.25F);
    EXPECT_FLOAT_EQ(material.roughness, 0.75F);
    EXPECT_FLOAT_EQ(material.specular, 0.0F);
    EXPECT_EQ(material.emission, glm::vec3(200, 100, 0));
    EXPECT_TRUE(material.double_sided);
}

Json blended(float alpha) {
    return {{"pbrMetallicRoughness",
             {{"baseColorFactor", {0.2, 0.4, 0.8, alpha}}, {"metallicFactor", 0}}},
            {"alphaMode", "BLEND"}};
}

TEST(SceneMaterial, BlendThatCoversLittleIsAClearPane) {
    const Scene scene = square_with(blended(0.25F)).load();
    const Material& material = scene.materials[0];
    EXPECT_TRUE(has_notice(scene, "panes that let 1 - alpha through"));
    ASSERT_EQ(specular_kind(material), SpecularKind::pane);
    for (const float cosine : {1.0F, 0.5F, 0.1F}) {
        const PaneShares shares =
            pane_shares(specular_surface(material, material.base_colour), cosine);
        EXPECT_NEAR(shares.transmitted.r, 0.75F, 1e-6F);
        EXPECT_LT(shares.reflected.r, 1e-6F);
    }
}

TEST(SceneMaterial, BlendThatCoversMostIsAVeil) {
    const Scene scene = square_with(blended(0.75F)).load();
    const Material& material = scene.materials[0];
    EXPECT_TRUE(has_notice(scene, "like a veil"));
    EXPECT_FLOAT_EQ(material.base_colour.b, 0.75F * 0.8F);
    EXPECT_NEAR(material.transmittance.r, 0.25F, 1e-3F);
    EXPECT_TRUE(material.double_sided);
    EXPECT_EQ(material.specular, 0.0F);
    for (int c = 0; c < 3; ++c) {
        EXPECT_LE(material.base_colour[c] + material.transmittance[c], 1.0F);
    }
}

TEST(SceneMaterial, BlendThatCoversAllIsOpaque) {
    const Scene scene = square_with(blended(1.0F)).load();
    EXPECT_EQ(specular_kind(scene.materials[0]), SpecularKind::none);
    EXPECT_FALSE(transmits(scene.materials[0]));
    EXPECT_FALSE(has_notice(scene, "BLEND"));
}

TEST(SceneMaterial, BlendWithATextureOfAlphaIsCutOut) {
    Json material = textured({{"index", 0}});
    material["alphaMode"] = "BLEND";
    GltfBuilder builder = square_with(material);
    add_texture(builder, 2, 1, {255, 255, 255, 255, 0, 0, 0, 100});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::mask);
    EXPECT_TRUE(has_notice(scene, "cut out where"));
}

/// What transmits by an extension is not blended as well.
TEST(SceneMaterial, BlendLeavesGlassAsItIs) {
    Json glass = blended(0.25F);
    glass["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}}};
    const Scene scene = square_with(glass).load();
    EXPECT_EQ(specular_kind(scene.materials[0]), SpecularKind::pane);
    EXPECT_FLOAT_EQ(scene.materials[0].ior, 1.5F);
    EXPECT_FLOAT_EQ(scene.materials[0].base_colour.b, 0.8F);
}

TEST(SceneMaterial, DefaultMaterialServesMeshesWithoutOne) {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}});
    builder.add_material({{"name", "unused"}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.materials.size(), 2U);
    EXPECT_EQ(scene.materials[scene.triangles[0].material].name, "default");
}

TEST(SceneMaterial, SpecularGlossinessGivesItsDiffuseColour) {
    const Scene scene =
        square_with({{"extensions",
                      {{"KHR_materials_pbrSpecularGlossiness",
                        {{"diffuseFactor", {0.4, 0.3, 0.2, 1}}, {"glossinessFactor", 0.25}}}}}})
            .load();
    EXPECT_EQ(scene.materials[0].base_colour, glm::vec3(0.4F, 0.3F, 0.2F));
    EXPECT_FLOAT_EQ(scene.materials[0].metallic, 0.0F);
    EXPECT_FLOAT_EQ(scene.materials[0].roughness, 0.75F);
}

TEST(SceneMaterial, BaseColourStaysBelowOne) {
    EXPECT_EQ(clamped_base_colour({0.9F, 0.8F, 0.7F}), glm::vec3(0.9F, 0.8F, 0.7F));
    EXPECT_EQ(clamped_base_colour({2.0F, 1.0F, 0.5F}), glm::vec3(0.999F, 0.999F, 0.5F));
    Scene scene = square_with({{"name", "snow"},
                               {"pbrMetallicRoughness",
                                {{"metallicFactor", 0}, {"baseColorFactor", {1.2, 1, 0.5, 1}}}}})
                      .load();
    const PatchMesh mesh = patches_of(scene, 0.5F);
    EXPECT_EQ(mesh.base_colour[0], glm::vec3(0.999F, 0.999F, 0.5F));
    EXPECT_TRUE(has_notice(scene, "\"snow\""));
}

TEST(SceneMaterial, AlbedoIsTheAreaMeanInLinearLight) {
    GltfBuilder builder = square_with(textured({{"index", 0}}));
    // sRGB 188 is 0.5 in linear light.
    add_texture(builder, 1, 1, {188, 188, 188, 255});
    Scene grey = builder.load();
    const PatchMesh grey_mesh = patches_of(grey, 2.0F);
    EXPECT_NEAR(grey_mesh.base_colour[0].g, 0.5029F, 1e-3F);

    add_texture(builder, 2, 1, left_white_right_black);
    Scene halves = builder.load();
    const PatchMesh whole = patches_of(halves, 2.0F);
    // Of the triangles of the square, one has 3/4 of its area on the right, one on the left.
    ASSERT_EQ(whole.patch_count(), 2U);
    EXPECT_NEAR(whole.base_colour[0].r + whole.base_colour[1].r, 1.0F, 0.05F);
    EXPECT_NEAR(std::min(whole.base_colour[0].r, whole.base_colour[1].r), 0.25F, 0.15F);
    const PatchMesh fine = patches_of(halves, 0.2F);
    for (std::size_t p = 0; p < fine.patch_count(); ++p) {
        glm::vec3 centre(0.0F);
        for (int k = 0; k < 3; ++k) {
            centre += fine.positions[fine.triangles[fine.side_triangle[p]][k]] / 3.0F;
        }
        if (std::abs(centre.x - 0.5F) > 0.15F) {
            EXPECT_NEAR(fine.base_colour[p].r, centre.x < 0.5F ? 0.999F : 0.0F, 1e-6F);
        }
    }
}

TEST(SceneMaterial, MeanDoesNotFallInWithRepetition) {
    Texture stripes;
    stripes.width = 2;
    stripes.height = 1;
    stripes.rgba = left_white_right_black;
    for (const float repeats : {1.0F, 4.0F, 16.0F, 64.0F, 1000.0F}) {
        const TextureMean mean =
            texture_mean(stripes, glm::mat3(1.0F),
                         {glm::vec2(0, 0), glm::vec2(repeats, 0), glm::vec2(0, repeats)});
        EXPECT_NEAR(mean.colour.g, repeats == 1.0F ? 0.75F : 0.5F, repeats < 16.0F ? 0.14F : 0.04F)
            << repeats;
    }
}

TEST(SceneMaterial, TextureTransformAndWrapping) {
    // Offset by half a texture: the halves change places.
    Json info = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
    GltfBuilder builder = square_with(textured(info));
    add_texture(builder, 2, 1, left_white_right_black);
    const auto albedo_at_left = [&] {
        Scene scene = builder.load();
        const PatchMesh mesh = patches_of(scene, 0.2F);
        for (std::size_t p = 0; p < mesh.patch_count(); ++p) {
            if (mesh.positions[mesh.triangles[p].x].x < 0.1F &&
                mesh.positions[mesh.triangles[p].y].x < 0.2F &&
                mesh.positions[mesh.triangles[p].z].x < 0.2F) {
                return mesh.base_colour[p].r;
            }
        }
        return -1.0F;
    };
    EXPECT_FLOAT_EQ(albedo_at_left(), 0.0F);
    // Repeated, u from 0.7 on starts black and comes round to white; clamped, it stays black.
    builder.json["materials"][0] = textured(
        {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {1.2, 0}}}}}}});
    EXPECT_FLOAT_EQ(albedo_at_left(), 0.999F);
    builder.json["samplers"] = {{{"wrapS", 33071}}};
    builder.json["textures"][0]["sampler"] = 0;
    EXPECT_FLOAT_EQ(albedo_at_left(), 0.0F);
}

TEST(SceneMaterial, TextureTransformRotatesCounterClockwise) {
    const Scene scene = [] {
        GltfBuilder builder = square_with(textured(
            {{"index", 0},
             {"extensions",
              {{"KHR_texture_transform",
                {{"rotation", 1.5707963267948966}, {"scale", {2, 3}}, {"offset", {0.1, 0.2}}}}}}}));
        add_texture(builder, 1, 1, {1, 2, 3, 255});
        return builder.load();
    }();
    // v points down: a quarter turn counter-clockwise takes +u to -v.
    const glm::vec3 uv =
        scene.materials[0].base_colour_texture.uv_from_mesh_uv * glm::vec3(1, 0, 1);
    EXPECT_NEAR(uv.x, 0.1F, 1e-6F);
    EXPECT_NEAR(uv.y, 0.2F - 2.0F, 1e-6F);
}

TEST(SceneMaterial, TheUvSetOfTheBaseColourIsRead) {
    GltfBuilder builder = square_with(textured({{"index", 0}, {"texCoord", 1}}));
    add_texture(builder, 2, 1, left_white_right_black);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        builder.add_uvs({{0.9F, 0}, {0.9F, 0}, {0.9F, 0}, {0.9F, 0}});
    Scene scene = builder.load();
    EXPECT_FLOAT_EQ(patches_of(scene, 2.0F).base_colour[0].r, 0.0F);
}

TEST(SceneMaterial, MaskCutsPatchesAway) {
    Json material = textured({{"index", 0}});
    material["alphaMode"] = "MASK";
    GltfBuilder builder = square_with(material);
    add_texture(builder, 2, 1, {200, 200, 200, 255, 10, 10, 10, 0});
    Scene scene = builder.load();
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::mask);
    const PatchMesh mesh = patches_of(scene, 0.1F);
    EXPECT_TRUE(has_notice(scene, "alpha MASK"));
    for (std::size_t p = 0; p < mesh.patch_count(); ++p) {
        // What is left shows only the opaque half's colour.
        EXPECT_NEAR(mesh.base_colour[p].r, linear_from_srgb(200), 1e-5F);
        float left = 1.0F;
        for (int k = 0; k < 3; ++k) {
            left = std::min(left, mesh.positions[mesh.triangles[p][k]].x);
        }
        EXPECT_LT(left, 0.5F);
    }
}

TEST(SceneMaterial, ReadsImagesFromFilesAndGreyPixels) {
    const TemporaryFolder folder;
    GltfBuilder builder = square_with(textured({{"index", 0}}));
    const std::vector<std::uint8_t> bytes = png(1, 1, {255, 0, 0, 255});
    folder.write("my image.png", std::string(bytes.begin(), bytes.end()));
    builder.json["images"] = {{{"uri", "my%20image.png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    const Scene scene = load_gltf(folder.write("scene.gltf", builder.text()));
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255}));
}

}  // namespace
}  // namespace raybundle::test
