// SPDX-License-Identifier: Apache-2.0
// Reflectance of surfaces: values, symmetry and energy.
#include "scene/material/brdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "hemisphere_quadrature.h"
#include "random_brdf.h"
#include "scene/material/base_colour.h"
#include "scene/material/ggx_albedo.h"

namespace raybundle::test {
namespace {

Material plastic(float roughness, float specular = 1.0F) {
    Material material;
    material.metallic = 0.0F;
    material.roughness = roughness;
    material.specular = specular;
    return material;
}

Material phong(const glm::vec3& specular, float exponent) {
    Material material;
    material.max_phong = MaxPhong{specular, exponent};
    return material;
}

TEST(Brdf, IsReciprocalToTheLastBit) {
    RandomBrdfs random(1);
    for (int i = 0; i < 20'000; ++i) {
        const Brdf brdf = i % 100 == 0 ? random.next() : random.last();
        const glm::vec3 a = random.direction();
        const glm::vec3 b = random.direction();
        ASSERT_EQ(evaluate(brdf, a, b), evaluate(brdf, b, a)) << i;
    }
}

TEST(Brdf, IsNeitherNegativeNorInfinite) {
    RandomBrdfs random(2);
    for (int i = 0; i < 200; ++i) {
        const Brdf brdf = random.next();
        for (const float z : {1.0F, 0.5F, 1e-3F, 1e-6F, 1e-12F, 1e-30F, 1e-44F}) {
            for (int k = 0; k < 40; ++k) {
                glm::vec3 a = random.direction();
                a = glm::vec3(glm::normalize(glm::vec2(a)) * std::sqrt(1.0F - z * z), z);
                // Anywhere, mirrored, back, along the normal.
                const glm::vec3 others[] = {random.direction(), {-a.x, -a.y, a.z}, a, {0, 0, 1}};
                for (const glm::vec3& b : others) {
                    const glm::vec3 f = evaluate(brdf, a, b);
                    for (int c = 0; c < 3; ++c) {
                        ASSERT_TRUE(std::isfinite(f[c]) && f[c] >= 0.0F) << i << " z " << z;
                    }
                    ASSERT_TRUE(std::isfinite(pdf(brdf, a, b))) << i << " z " << z;
                }
                const BrdfSample drawn =
                    sample(brdf, a, {random.uniform(), random.uniform()}, random.uniform());
                ASSERT_TRUE(std::isfinite(drawn.pdf) && drawn.pdf > 0.0F) << i << " z " << z;
                ASSERT_NEAR(glm::length(drawn.w_in), 1.0F, 1e-4F) << i << " z " << z;
            }
        }
    }
}

TEST(Brdf, ReflectsNothingBelowTheHorizon) {
    RandomBrdfs random(3);
    for (int i = 0; i < 100; ++i) {
        const Brdf brdf = random.next();
        const glm::vec3 up = random.direction();
        const glm::vec3 down(up.x, up.y, -up.z);
        EXPECT_EQ(evaluate(brdf, up, down), glm::vec3(0.0F));
        EXPECT_EQ(evaluate(brdf, down, up), glm::vec3(0.0F));
        EXPECT_EQ(evaluate(brdf, up, {1, 0, 0}), glm::vec3(0.0F));
        EXPECT_EQ(pdf(brdf, up, down), 0.0F);
        EXPECT_EQ(sample(brdf, down, {0.3F, 0.4F}, 0.5F).pdf, 0.0F);
    }
}

/// Angles at which the test's quadrature is exact to this for every lobe. BrdfEstimator looks
/// nearer to the horizon.
constexpr float cosines[] = {0.01F, 0.02F, 0.03F, 0.1F, 0.3F, 0.6F, 0.9F, 1.0F};
constexpr double quadrature_error = 1e-3;

/// The white furnace: base colours of 1 and more.
TEST(Brdf, NeverCreatesEnergy) {
    for (const float roughness :
         {0.0F, 0.05F, 0.06F, 0.08F, 0.12F, 0.2F, 0.37F, 0.6F, 0.8F, 1.0F}) {
        for (const float metallic : {0.0F, 0.5F, 1.0F}) {
            for (const float specular : {0.3F, 1.0F}) {
                Material material = plastic(roughness, specular);
                material.metallic = metallic;
                material.specular_colour = {25.0F, 1.0F, 1.0F};
                const Brdf brdf = make_brdf(material, {1.5F, 1.0F, 0.9F});
                for (const float c : cosines) {
                    const glm::dvec3 a = albedo_by_quadrature(brdf, c);
                    ASSERT_LE(std::max({a.r, a.g, a.b}), 1.0 + quadrature_error)
                        << "roughness " << roughness << " metallic " << metallic << " specular "
                        << specular << " cos " << c;
                }
            }
        }
    }
}

/// And a white dielectric keeps it, whatever its roughness: what the lobe does not reflect, the
/// Lambert part does. (Appendix B's form would reach 1.9 here.)
TEST(Brdf, WhiteDielectricReflectsEverything) {
    for (const float roughness : {0.0F, 0.1F, 0.3F, 0.6F, 1.0F}) {
        const Brdf brdf = make_brdf(plastic(roughness), glm::vec3(1.0F));
        for (const float c : cosines) {
            EXPECT_NEAR(albedo_by_quadrature(brdf, c).g, 0.997, 0.0025) << roughness << " " << c;
        }
    }
}

TEST(Brdf, MaxPhongNeverCreatesEnergy) {
    for (const float exponent : {1.0F, 1.5F, 3.0F, 10.0F, 28.0F, 200.0F, 1000.0F}) {
        for (const float base : {0.0F, 0.3F, 1.0F}) {
            const Brdf brdf = make_brdf(phong({1.0F, 0.6F, 0.0F}, exponent), glm::vec3(base));
            for (const float c : cosines) {
                const glm::dvec3 a = albedo_by_quadrature(brdf, c, 128);
                ASSERT_LE(std::max({a.r, a.g, a.b}), 1.0 + quadrature_error)
                    << exponent << " " << base << " " << c;
            }
        }
    }
}

/// Closed forms: `specular` at normal incidence, (n + 2)/(2 n + 2) of it at grazing angles.
TEST(Brdf, MaxPhongAlbedoIsKnownAtBothEnds) {
    for (const float n : {1.0F, 3.0F, 28.0F, 200.0F}) {
        const Brdf brdf = make_brdf(phong({0.45F, 0.2F, 0.0F}, n), {0.3F, 0.3F, 0.4F});
        const glm::dvec3 normal = albedo_by_quadrature(brdf, 1.0F);
        EXPECT_NEAR(normal.r, 0.75, 1e-3);
        EXPECT_NEAR(normal.g, 0.50, 1e-3);
        EXPECT_NEAR(normal.b, 0.40, 1e-3);
        const auto half = static_cast<double>((n + 2.0F) / (2.0F * n + 2.0F));
        EXPECT_NEAR(albedo_by_quadrature(brdf, 1e-5F).r, 0.3 + 0.45 * half, 2e-3) << n;
    }
}

TEST(Brdf, WithoutSpecularIsExactlyLambert) {
    const Brdf brdf = make_brdf(plastic(0.3F, 0.0F), {0.2F, 0.5F, 0.8F});
    EXPECT_EQ(brdf.lobe, SpecularLobe{});
    EXPECT_EQ(brdf.lambert, glm::vec3(0.2F, 0.5F, 0.8F));
    RandomBrdfs random(4);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 f = evaluate(brdf, random.direction(), random.direction());
        ASSERT_EQ(f, glm::vec3(0.2F, 0.5F, 0.8F) * (1.0F / glm::pi<float>()));
    }
    // A black max-Phong lobe is none either, and colours are kept below max_albedo.
    EXPECT_EQ(make_brdf(phong(glm::vec3(0.0F), 5.0F), glm::vec3(2.0F)),
              (Brdf{glm::vec3(max_albedo), glm::vec3(0.0F), {}}));
}

/// glTF 2.0 appendix B, "Implementation": the lobe of every material.
glm::vec3 appendix_b_lobe(const glm::vec3& f0, double alpha, const glm::dvec3& l,
                          const glm::dvec3& v) {
    const glm::dvec3 h = glm::normalize(l + v);
    const double a2 = alpha * alpha;
    const double d = a2 / (glm::pi<double>() * std::pow(h.z * h.z * (a2 - 1.0) + 1.0, 2.0));
    const double visibility = 0.5 / (l.z * std::sqrt(v.z * v.z * (1.0 - a2) + a2) +
                                     v.z * std::sqrt(l.z * l.z * (1.0 - a2) + a2));
    const double p = std::pow(1.0 - glm::dot(v, h), 5.0);
    return glm::vec3((glm::dvec3(f0) * (1.0 - p) + p) * d * visibility);
}

TEST(Brdf, MetalsAreAppendixB) {
    RandomBrdfs random(5);
    for (const float roughness : {0.1F, 0.4F, 1.0F}) {
        Material metal;
        metal.roughness = roughness;
        const glm::vec3 colour(0.9F, 0.6F, 0.3F);
        const Brdf brdf = make_brdf(metal, colour);
        EXPECT_EQ(brdf.lambert, glm::vec3(0.0F));
        for (int i = 0; i < 1000; ++i) {
            const glm::vec3 l = glm::normalize(random.direction() + glm::vec3(0, 0, 1e-4F));
            const glm::vec3 v = i % 2 == 0 ? random.direction() : glm::vec3(-l.x, -l.y, l.z);
            const glm::vec3 expected = appendix_b_lobe(
                colour, static_cast<double>(roughness) * static_cast<double>(roughness), l, v);
            const glm::vec3 f = evaluate(brdf, l, v);
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(f[c], expected[c], 2e-4F * expected[c]);
            }
        }
    }
}

/// KHR_materials_specular: f0 = min(0.04 colour, 1) factor, f90 = factor; and the Lambert part of a
/// dielectric, seen and lit from above, has the albedo of appendix B.
TEST(Brdf, DielectricsFollowAppendixBAtNormalIncidence) {
    Material material = plastic(0.5F, 0.5F);
    material.specular_colour = {1.0F, 2.0F, 100.0F};
    const Brdf brdf = make_brdf(material, glm::vec3(0.5F));
    const glm::vec3 f0 = brdf.f0 / brdf.lobe.f90;
    EXPECT_NEAR(f0.r, 0.04F, 1e-6F);
    EXPECT_NEAR(f0.g, 0.08F, 1e-6F);
    EXPECT_NEAR(f0.b, 1.0F, 1e-6F);
    EXPECT_NEAR(brdf.lobe.f90, 0.5F, 2e-3F);  // less the energy margin
    for (const float roughness : {0.0F, 0.3F, 0.6F, 1.0F}) {
        const Brdf matte = make_brdf(plastic(roughness), glm::vec3(0.8F));
        EXPECT_NEAR(matte.lambert.g * transmission(matte.lobe, 1.0F), 0.8F * 0.96F,
                    0.03F * 0.8F * 0.96F)
            << roughness;
    }
}

TEST(Brdf, RoughnessEndsAtItsLimits) {
    const auto lobe_at = [](float roughness) { return reflectance_model(plastic(roughness)).lobe; };
    EXPECT_EQ(lobe_at(0.0F), lobe_at(min_roughness));
    EXPECT_EQ(lobe_at(-1.0F), lobe_at(min_roughness));
    EXPECT_EQ(lobe_at(1.0F), lobe_at(7.0F));
    EXPECT_NE(lobe_at(0.05F), lobe_at(min_roughness));
    EXPECT_FLOAT_EQ(lobe_at(0.5F).alpha, 0.25F);
    // The smoothest lobe is still a peak of finite height that mirrors all light of a white metal.
    Material mirror;
    mirror.roughness = 0.0F;
    const Brdf brdf = make_brdf(mirror, glm::vec3(1.0F));
    const glm::vec3 w = direction_in_plane(0.7F);
    EXPECT_GT(evaluate(brdf, w, {-w.x, 0.0F, w.z}).g, 1e3F);
    EXPECT_NEAR(albedo_by_quadrature(brdf, 0.7F).g, 0.999, 2e-3);
}

}  // namespace
}  // namespace raybundle::test
