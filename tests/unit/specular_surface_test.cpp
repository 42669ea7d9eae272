// SPDX-License-Identifier: Apache-2.0
#include "scene/material/specular_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_builder.h"
#include "scene/material/brdf.h"

namespace raybundle::test {
namespace {

constexpr float glass_index = 1.5F;

TEST(SpecularSurface, FresnelHasItsClosedForms) {
    // Normal incidence: ((n - 1)/(n + 1))^2, from either side.
    EXPECT_NEAR(fresnel_reflectance(1.0F, glass_index), 0.04F, 1e-6F);
    EXPECT_NEAR(fresnel_reflectance(1.0F, 1.0F / glass_index), 0.04F, 1e-6F);
    EXPECT_EQ(fresnel_reflectance(0.0F, glass_index), 1.0F);
    // Brewster's angle, tan = n: only the wave across the plane of incidence is reflected, by
    // ((n^2 - 1)/(n^2 + 1))^2.
    const float brewster = 1.0F / std::sqrt(1.0F + glass_index * glass_index);
    const float across = 1.25F / 3.25F;
    EXPECT_NEAR(fresnel_reflectance(brewster, glass_index), 0.5F * across * across, 1e-6F);
    // No boundary, no reflection.
    EXPECT_NEAR(fresnel_reflectance(0.3F, 1.0F), 0.0F, 1e-6F);
}

TEST(SpecularSurface, FresnelIsTheSameBothWays) {
    for (float sine = 0.05F; sine < 1.0F; sine += 0.05F) {
        const float inside = sine / glass_index;
        EXPECT_NEAR(fresnel_reflectance(std::sqrt(1.0F - sine * sine), glass_index),
                    fresnel_reflectance(std::sqrt(1.0F - inside * inside), 1.0F / glass_index),
                    2e-5F);
    }
}

TEST(SpecularSurface, RefractionObeysSnell) {
    const glm::vec3 normal(0.0F, 0.0F, 1.0F);
    for (float sine = 0.0F; sine < 1.0F; sine += 0.09F) {
        const glm::vec3 direction(sine, 0.0F, -std::sqrt(1.0F - sine * sine));
        const auto behind = refracted(direction, normal, glass_index);
        ASSERT_TRUE(behind.has_value());
        EXPECT_NEAR(behind->x, sine / glass_index, 1e-6F);
        EXPECT_LT(behind->z, 0.0F);
        EXPECT_NEAR(glm::length(*behind), 1.0F, 1e-6F);
    }
}

TEST(SpecularSurface, BeyondTheCriticalAngleAllIsReflected) {
    const float critical = 1.0F / glass_index;  // its sine
    for (const float sine : {critical - 0.01F, critical + 0.01F, 0.9F}) {
        const float cosine = std::sqrt(1.0F - sine * sine);
        const auto behind =
            refracted({sine, 0.0F, -cosine}, {0.0F, 0.0F, 1.0F}, 1.0F / glass_index);
        EXPECT_EQ(behind.has_value(), sine < critical);
        EXPECT_EQ(fresnel_reflectance(cosine, 1.0F / glass_index) == 1.0F, sine > critical);
    }
}

TEST(SpecularSurface, AClearPaneLosesNothing) {
    SpecularSurface pane;
    pane.kind = SpecularKind::pane;
    pane.ior = glass_index;
    for (const float cosine : {0.02F, 0.3F, 0.7F, 1.0F}) {
        const PaneShares shares = pane_shares(pane, cosine);
        EXPECT_NEAR(shares.reflected.g + shares.transmitted.g, 1.0F, 1e-5F) << cosine;
        // 2 R/(1 + R).
        const float f = fresnel_reflectance(cosine, glass_index);
        EXPECT_NEAR(shares.reflected.g, 2.0F * f / (1.0F + f), 1e-5F) << cosine;
    }
    pane.tint = glm::vec3(0.5F);
    EXPECT_NEAR(pane_shares(pane, 1.0F).transmitted.g, 0.96F * 0.96F * 0.5F / (1.0F - 0.0004F),
                1e-5F);
}

Scene box_of(const Json& material, float metres_per_unit = 1.0F) {
    GltfBuilder builder;
    const int mesh = builder.add_box_mesh({0, 0, 0}, {1, 2, 3});
    builder.json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0]["material"] =
        builder.add_material(material);
    builder.add_node({{"mesh", mesh}});
    SceneSettings settings;
    settings.metres_per_unit = metres_per_unit;
    return builder.load(settings);
}

Material read_material(const Json& json) {
    return box_of(json).materials.front();
}

TEST(SpecularSurface, FilesAskForMirrorsPanesAndBodies) {
    const auto metal = [](double roughness) {
        return Json{{"pbrMetallicRoughness",
                     {{"baseColorFactor", {0.9, 0.8, 0.7, 1.0}}, {"roughnessFactor", roughness}}}};
    };
    EXPECT_EQ(specular_kind(read_material(metal(0.0))), SpecularKind::mirror);
    EXPECT_EQ(specular_kind(read_material(metal(0.3))), SpecularKind::none);

    Json glass = {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}},
                  {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}};
    EXPECT_EQ(specular_kind(read_material(glass)), SpecularKind::pane);
    EXPECT_EQ(specular_surface(read_material(glass), glm::vec3(1.0F)).ior, glass_index);

    glass["extensions"]["KHR_materials_ior"] = {{"ior", 1.7}};
    glass["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 0.1},
                                                   {"attenuationDistance", 2.0},
                                                   {"attenuationColor", {1, 0.25, 0.5}}};
    const SpecularSurface body = specular_surface(read_material(glass), glm::vec3(1.0F));
    EXPECT_EQ(body.kind, SpecularKind::glass);
    EXPECT_NEAR(body.ior, 1.7F, 1e-6F);
    // Beer and Lambert: after 2 m the colour is left, after 1 m its root.
    EXPECT_NEAR(std::exp(-body.absorption.r), 1.0F, 1e-6F);
    EXPECT_NEAR(std::exp(-body.absorption.g), 0.5F, 1e-6F);
    EXPECT_NEAR(body.absorption.b, 0.5F * std::numbers::ln2_v<float>, 1e-6F);
    // In a file in millimetres as much is left behind as many of them.
    const SpecularSurface small =
        specular_surface(box_of(glass, 0.001F).materials.front(), glm::vec3(1.0F));
    EXPECT_NEAR(std::exp(-0.001F * small.absorption.g), 0.5F, 1e-5F);

    glass["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0.2;
    EXPECT_EQ(specular_kind(read_material(glass)), SpecularKind::none);
    EXPECT_TRUE(transmits(read_material(glass)));
}

TEST(SpecularSurface, PolishedDielectricsMirrorOverWhatIsBelow) {
    Material porcelain;
    porcelain.metallic = 0.0F;
    porcelain.roughness = 0.05F;
    ASSERT_EQ(specular_kind(porcelain), SpecularKind::coat);
    const SpecularSurface surface = specular_surface(porcelain, glm::vec3(0.8F));
    EXPECT_NEAR(mirror_reflectance(surface, 1.0F).g, 0.04F, 0.0005F);
    EXPECT_NEAR(mirror_reflectance(surface, 0.0F).g, 1.0F, 0.01F);
    // Partly metal, it has the colour of that part.
    porcelain.metallic = 0.5F;
    const SpecularSurface half = specular_surface(porcelain, glm::vec3(0.8F, 0.4F, 0.0F));
    EXPECT_NEAR(mirror_reflectance(half, 1.0F).r, 0.5F * (0.04F + 0.8F), 0.001F);
    EXPECT_NEAR(mirror_reflectance(half, 1.0F).b, 0.5F * 0.04F, 0.001F);
}

TEST(SpecularSurface, OnlyEvenSmoothnessThatIsNotHiddenMirrors) {
    Material polished;
    polished.metallic = 0.0F;
    polished.roughness = 0.05F;
    const auto kind_if = [&](auto change) {
        Material changed = polished;
        change(changed);
        return specular_kind(changed);
    };
    EXPECT_EQ(kind_if([](Material& m) { m.roughness = 0.11F; }), SpecularKind::none);
    EXPECT_EQ(kind_if([](Material& m) { m.specular = 0.0F; }), SpecularKind::none);
    EXPECT_EQ(kind_if([](Material& m) { m.emission.r = 1.0F; }), SpecularKind::none);
    EXPECT_EQ(kind_if([](Material& m) { m.normal_texture.texture = 0; }), SpecularKind::none);
    EXPECT_EQ(kind_if([](Material& m) { m.metallic_roughness_texture.texture = 0; }),
              SpecularKind::none);
    EXPECT_EQ(kind_if([](Material& m) { m.alpha_mode = AlphaMode::mask; }), SpecularKind::none);
    const auto coat = [](float roughness) {
        return [roughness](Material& m) {
            m.clear_coat = 1.0F;
            m.clear_coat_roughness = roughness;
        };
    };
    EXPECT_EQ(kind_if(coat(0.4F)), SpecularKind::none);
    EXPECT_EQ(kind_if(coat(0.0F)), SpecularKind::coat);
}

TEST(SpecularSurface, GlassReflectsNothingByItsBrdf) {
    Material glass;
    glass.metallic = 0.0F;
    glass.roughness = 0.0F;
    glass.transmission = 1.0F;
    EXPECT_EQ(make_brdf(glass, glm::vec3(1.0F)), Brdf{});
}

TEST(BundleGlass, IsWhatAPaneReflectsAndTransmits) {
    SpecularSurface pane;
    pane.kind = SpecularKind::pane;
    pane.tint = glm::vec3(0.6F);
    const BundleGlass glass = bundle_glass(pane, 0.0F);
    for (const float cosine : {1.0F, 0.7F, 0.3F, 0.05F}) {
        const PaneShares shares = pane_shares(pane, cosine);
        EXPECT_NEAR(glass.passing_share(cosine), shares.reflected.g + shares.transmitted.g, 1e-6F);
    }
    pane.tint = glm::vec3(1.0F);
    EXPECT_EQ(bundle_glass(pane, 0.0F).tint, 1.0F);
    EXPECT_NEAR(bundle_glass(pane, 0.0F).passing_share(0.4F), 1.0F, 1e-6F);
}

/// Both boundaries of a body together absorb what a pane of the same transmission does.
TEST(BundleGlass, OfABodyAbsorbsAlongItsMeanChord) {
    SpecularSurface body;
    body.kind = SpecularKind::glass;
    body.absorption = glm::vec3(2.0F);
    SpecularSurface pane;
    pane.kind = SpecularKind::pane;
    pane.tint = glm::vec3(std::exp(-2.0F * 0.3F));
    const float boundary = bundle_glass(body, 0.3F).passing_share(0.8F);
    EXPECT_NEAR(boundary * boundary, bundle_glass(pane, 0.0F).passing_share(0.8F), 1e-6F);
}

/// 4 V/S of a box of 1 x 2 x 3 m: 24/22; what the material says where a face is missing.
TEST(BundleGlass, TheMeanChordIsCauchys) {
    Scene scene;
    scene.objects.emplace_back();
    scene.materials.emplace_back().thickness = 0.25F;
    for (int k = 0; k < 8; ++k) {
        Vertex vertex;
        vertex.position = {(k & 1) != 0 ? 1.0F : 0.0F, (k & 2) != 0 ? 2.0F : 0.0F,
                           (k & 4) != 0 ? 3.0F : 0.0F};
        scene.vertices.push_back(vertex);
    }
    const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
        scene.triangles.push_back({{f[0], f[1], f[2]}, 0, 0});
        scene.triangles.push_back({{f[0], f[2], f[3]}, 0, 0});
    }
    EXPECT_NEAR(mean_chord(scene, 0), 24.0F / 22.0F, 1e-5F);
    scene.triangles.pop_back();
    EXPECT_EQ(mean_chord(scene, 0), 0.25F);
}

}  // namespace
}  // namespace raybundle::test
