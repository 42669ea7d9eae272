// SPDX-License-Identifier: Apache-2.0
// Clear coats: what their BRDF is, that it keeps energy, and how files ask for them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "gltf_builder.h"
#include "hemisphere_quadrature.h"
#include "random_brdf.h"
#include "scene/material/ggx_albedo.h"
#include "scene/material/reflectance_table.h"
#include "scene/material/specular_surface.h"

namespace raybundle::test {
namespace {

Material coated(RandomBrdfs& random) {
    Material material = random.material();
    material.max_phong.reset();
    material.clear_coat = random.uniform() < 0.5F ? 1.0F : random.uniform();
    material.clear_coat_roughness = random.uniform();
    return material;
}

/// The coat's lobe as a BRDF of its own, and all the rest.
Brdf lobe_of_coat(const Brdf& brdf) {
    Brdf lobe;
    lobe.f0 = glm::vec3(0.04F * brdf.lobe.coat.strength);
    lobe.lobe.kind = LobeKind::ggx;
    lobe.lobe.alpha = brdf.lobe.coat.alpha;
    lobe.lobe.f90 = brdf.lobe.coat.strength;
    return lobe;
}

Brdf without_lobe_of_coat(Brdf brdf) {
    brdf.lobe.coat.strength = 0.0F;
    return brdf;
}

glm::dvec3 albedo_of(const Brdf& brdf, float cosine, int points) {
    return albedo_by_quadrature(lobe_of_coat(brdf), cosine, points) +
           albedo_by_quadrature(without_lobe_of_coat(brdf), cosine, points);
}

TEST(ClearCoat, IsReciprocalToTheLastBit) {
    RandomBrdfs random(61);
    Brdf brdf;
    for (int i = 0; i < 20'000; ++i) {
        if (i % 100 == 0) {
            const Material material = coated(random);
            brdf = make_brdf(material, material.base_colour);
        }
        const glm::vec3 a = random.direction();
        const glm::vec3 b = random.direction();
        ASSERT_EQ(evaluate(brdf, a, b), evaluate(brdf, b, a)) << i;
    }
}

TEST(ClearCoat, AddsItsLobeToWhatIsLeftBelow) {
    RandomBrdfs random(62);
    for (int i = 0; i < 2'000; ++i) {
        const Material material = coated(random);
        const Brdf brdf = make_brdf(material, material.base_colour);
        const glm::vec3 a = random.direction();
        const glm::vec3 b = i % 2 == 0 ? random.direction() : glm::vec3(-a.x, -a.y, a.z);
        const glm::vec3 sum =
            evaluate(lobe_of_coat(brdf), a, b) + evaluate(without_lobe_of_coat(brdf), a, b);
        const glm::vec3 f = evaluate(brdf, a, b);
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(f[c], sum[c], 1e-4F * sum[c]) << i;
        }
    }
}

/// The white furnace, over white metals and dielectrics.
TEST(ClearCoat, NeverCreatesEnergy) {
    for (const float coat : {0.0F, 0.1F, 0.3F, 1.0F}) {
        for (const float roughness : {0.1F, 0.4F, 1.0F}) {
            for (const float metallic : {0.0F, 0.5F, 1.0F}) {
                Material material;
                material.metallic = metallic;
                material.roughness = roughness;
                material.clear_coat = 1.0F;
                material.clear_coat_roughness = coat;
                const Brdf brdf = make_brdf(material, glm::vec3(1.0F));
                for (const float c : {0.02F, 0.1F, 0.3F, 0.6F, 1.0F}) {
                    ASSERT_LE(albedo_of(brdf, c, 192).g, 1.0 + 1e-3)
                        << "coat " << coat << " roughness " << roughness << " metallic " << metallic
                        << " cos " << c;
                }
            }
        }
    }
}

/// What the coat and the dielectric's own lobe leave, the Lambert part reflects: all but two energy
/// margins of 0.3 %, and what a rough lobe loses by the smaller of two transmissions.
TEST(ClearCoat, AWhiteDielectricStillReflectsNearlyEverything) {
    for (const float roughness : {0.1F, 0.5F, 1.0F}) {
        Material material;
        material.metallic = 0.0F;
        material.roughness = roughness;
        material.clear_coat = 1.0F;
        material.clear_coat_roughness = 0.2F;
        const Brdf brdf = make_brdf(material, glm::vec3(1.0F));
        for (const float c : {0.1F, 0.3F, 0.6F, 1.0F}) {
            EXPECT_NEAR(albedo_of(brdf, c, 192).g, 0.99, 0.008) << roughness << " " << c;
        }
    }
}

/// KHR_materials_clearcoat: base (1 - clearcoat F) + clearcoat F lobe, F by the angle of view. In
/// the mirrored direction of a smooth coat both angles are that one.
TEST(ClearCoat, IsAsTheExtensionSaysInTheMirroredDirection) {
    Material material;
    material.metallic = 1.0F;
    material.roughness = 0.5F;
    const Brdf bare = make_brdf(material, glm::vec3(0.6F, 0.5F, 0.4F));
    material.clear_coat = 0.8F;
    const Brdf brdf = without_lobe_of_coat(make_brdf(material, glm::vec3(0.6F, 0.5F, 0.4F)));
    for (const float c : {0.15F, 0.4F, 0.8F, 1.0F}) {
        const glm::vec3 w = direction_in_plane(c);
        const glm::vec3 mirrored(-w.x, 0.0F, w.z);
        const float left = 1.0F - 0.8F * (0.04F + 0.96F * std::pow(1.0F - c, 5.0F));
        const float expected = left * evaluate(bare, w, mirrored).g;
        EXPECT_NEAR(evaluate(brdf, w, mirrored).g, expected, 0.006F * expected) << c;
    }
}

TEST(ClearCoat, TableHoldsItsAlbedo) {
    RandomBrdfs random(63);
    for (int i = 0; i < 12; ++i) {
        const Material material = coated(random);
        const Brdf brdf = make_brdf(material, material.base_colour);
        const ReflectanceTable table(brdf);
        for (const float c : {0.031F, 0.17F, 0.44F, 0.787F, 0.996F}) {
            const glm::dvec3 exact = albedo_of(brdf, c, 192);
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(static_cast<double>(table.albedo(c)[channel]), exact[channel],
                            0.005 * exact[channel])
                    << i << " cos " << c;
            }
        }
    }
}

TEST(ClearCoat, WithoutOneNothingChanges) {
    RandomBrdfs random(64);
    for (int i = 0; i < 200; ++i) {
        Material material = coated(random);
        material.clear_coat = 0.0F;
        const Brdf brdf = make_brdf(material, material.base_colour);
        EXPECT_EQ(brdf.lobe.coat, ClearCoat{});
        EXPECT_EQ(coat_transmission(brdf.lobe.coat, 0.3F), 1.0F);
        EXPECT_EQ(coat_albedo(brdf.lobe.coat, 0.3F), 0.0F);
    }
}

Json coated_json(double factor, double roughness) {
    return {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.5}}},
            {"extensions",
             {{"KHR_materials_clearcoat",
               {{"clearcoatFactor", factor}, {"clearcoatRoughnessFactor", roughness}}}}}};
}

Scene read(const Json& material) {
    GltfBuilder builder;
    const int positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int mesh = builder.add_mesh(
        {{"attributes", {{"POSITION", positions}}}, {"material", builder.add_material(material)}});
    builder.add_node({{"mesh", mesh}});
    return builder.load();
}

bool has_notice(const Scene& scene, const std::string& text) {
    return std::any_of(scene.notices.begin(), scene.notices.end(), [&](const std::string& notice) {
        return notice.find(text) != std::string::npos;
    });
}

TEST(ClearCoat, FilesAskForSmoothAndRoughOnes) {
    const Material rough = read(coated_json(0.75, 0.3)).materials[0];
    EXPECT_FLOAT_EQ(rough.clear_coat, 0.75F);
    EXPECT_FLOAT_EQ(rough.clear_coat_roughness, 0.3F);
    EXPECT_EQ(specular_kind(rough), SpecularKind::none);
    const Scene scene = read(coated_json(1.0, 0.0));
    EXPECT_EQ(specular_kind(scene.materials[0]), SpecularKind::coat);
    EXPECT_FALSE(has_notice(scene, "coat"));
    EXPECT_TRUE(has_specular_surfaces(scene));
    EXPECT_FALSE(has_mirror_or_glass(scene));
    EXPECT_EQ(read(coated_json(0.0, 0.0)).materials[0].clear_coat, 0.0F);
}

TEST(ClearCoat, IsLeftOutWhereItCannotBeFollowed) {
    Json lamp = coated_json(1.0, 0.0);
    lamp["emissiveFactor"] = {1, 1, 1};
    EXPECT_TRUE(has_notice(read(lamp), "are left out"));
    EXPECT_EQ(read(lamp).materials[0].clear_coat, 0.0F);
    Json leaf = coated_json(1.0, 0.0);
    leaf["alphaMode"] = "MASK";
    const Scene masked = read(leaf);
    EXPECT_TRUE(has_notice(masked, "0.1 at least"));
    EXPECT_EQ(specular_kind(masked.materials[0]), SpecularKind::none);
    Json mapped = coated_json(1.0, 0.0);
    mapped["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = {{"index", 0}};
    EXPECT_TRUE(has_notice(read(mapped), "follows the geometry"));
}

/// Over a mirror: 1 - (1 - F)(1 - R) but for the light between the two.
TEST(ClearCoat, CoversMirrorsToo) {
    Material mirror;
    mirror.roughness = 0.0F;
    mirror.clear_coat = 1.0F;
    ASSERT_EQ(specular_kind(mirror), SpecularKind::mirror);
    const SpecularSurface surface = specular_surface(mirror, glm::vec3(0.5F));
    EXPECT_NEAR(mirror_reflectance(surface, 1.0F).g, 0.04F + 0.96F * 0.5F, 1e-6F);
    EXPECT_NEAR(mirror_reflectance(surface, 0.0F).g, 1.0F, 1e-6F);
}

}  // namespace
}  // namespace raybundle::test
