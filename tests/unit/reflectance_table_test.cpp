// SPDX-License-Identifier: Apache-2.0
// Tabulated directional albedo and importance against numerical integration.
#include "scene/material/reflectance_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "hemisphere_quadrature.h"
#include "random_brdf.h"
#include "scene/material/ggx_albedo.h"

namespace raybundle::test {
namespace {

constexpr double tolerance = 0.005;

/// Materials of every kind, smooth ones among them.
Brdf brdf_number(int i, RandomBrdfs& random) {
    Material material = random.material();
    constexpr float roughnesses[] = {0.0F, 0.1F, 0.25F, 0.5F, 0.8F, 0.84F, 1.0F};
    material.roughness = roughnesses[i % 7];
    return make_brdf(material, material.base_colour);
}

/// The angle of test point k; between nodes nearly always, grazing and steep ones too.
float cosine_number(int k) {
    constexpr float cosines[] = {0.013F, 0.031F, 0.08F,  0.17F, 0.29F,
                                 0.44F,  0.61F,  0.787F, 0.93F, 0.996F};
    return cosines[k];
}

TEST(ReflectanceNodes, PositionsAndCosinesAreInverse) {
    for (const float alpha : {0.002F, 0.03F, 0.3F, 1.0F}) {
        const float q = grazing_scale(alpha);
        EXPECT_EQ(node_of_cosine(0.0F, q), 0.0F);
        EXPECT_FLOAT_EQ(node_of_cosine(1.0F, q), reflectance_nodes - 1.0F);
        EXPECT_EQ(node_of_cosine(-1.0F, q), 0.0F);
        float previous = -1.0F;
        for (int i = 0; i < reflectance_nodes; ++i) {
            const float cosine = cosine_of_node(static_cast<float>(i), q);
            EXPECT_GT(cosine, previous);
            EXPECT_NEAR(node_of_cosine(cosine, q), static_cast<float>(i), 1e-3F);
            previous = cosine;
        }
    }
}

TEST(ReflectanceTable, AlbedoIsTheIntegralOfTheBrdf) {
    RandomBrdfs random(11);
    for (int i = 0; i < 42; ++i) {
        const Brdf brdf = brdf_number(i, random);
        const ReflectanceTable table(brdf);
        for (int k = 0; k < 10; ++k) {
            const float c = cosine_number(k);
            const glm::dvec3 exact = albedo_by_quadrature(brdf, c, 192);
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(static_cast<double>(table.albedo(c)[channel]), exact[channel],
                            tolerance * exact[channel])
                    << "material " << i << " alpha " << brdf.lobe.alpha << " cos " << c;
            }
        }
    }
}

/// Measured by the larger of S here and its mean: where a rough lobe's S nearly vanishes, only a
/// fraction of that is of interest.
TEST(ReflectanceTable, ImportanceIsTheIntegralOfTheDifferenceBrdf) {
    RandomBrdfs random(12);
    for (int i = 0; i < 28; ++i) {
        const Brdf brdf = brdf_number(i, random);
        const ReflectanceTable table(brdf);
        double mean = 0.0;
        for (int k = 0; k < 100; ++k) {
            mean += static_cast<double>(
                table.importance(std::sqrt((static_cast<float>(k) + 0.5F) / 100.0F)) / 100.0F);
        }
        for (int k = 0; k < 10; ++k) {
            const float c = cosine_number(k);
            const double exact = importance_by_quadrature(brdf, c, 192);
            ASSERT_NEAR(static_cast<double>(table.importance(c)), exact,
                        tolerance * std::max(exact, mean))
                << "material " << i << " alpha " << brdf.lobe.alpha << " cos " << c;
        }
    }
}

TEST(ReflectanceTable, AlbedoOfAnotherColourNeedsNoOtherTable) {
    RandomBrdfs random(13);
    for (int i = 0; i < 20; ++i) {
        Material material = random.material();
        material.max_phong.reset();  // its colours can be scaled down together
        const ReflectanceModel model = reflectance_model(material);
        const Brdf other = make_brdf(model, random.colour());
        const ReflectanceTable table(make_brdf(model, random.colour()));
        for (const float c : {0.0F, 0.3F, 1.0F}) {
            const glm::vec3 expected = ReflectanceTable(other).albedo(c);
            EXPECT_NEAR(glm::length(table.albedo(other, c) - expected), 0.0F, 1e-6F);
        }
    }
}

TEST(ReflectanceTable, LambertHasNoDifference) {
    const Brdf lambert{{0.2F, 0.5F, 0.8F}, glm::vec3(0.0F), {}};
    const ReflectanceTable table(lambert);
    for (const float c : {0.0F, 1e-3F, 0.5F, 1.0F}) {
        EXPECT_EQ(table.importance(c), 0.0F);
        EXPECT_EQ(table.albedo(c), lambert.lambert);
    }
}

TEST(ReflectanceTable, EveryLobeHasImportanceAtEveryAngle) {
    RandomBrdfs random(14);
    for (int i = 0; i < 50; ++i) {
        const Brdf& brdf = random.next();
        if (brdf.lobe.kind == LobeKind::none) {
            continue;
        }
        for (const ReflectanceNode& node : ReflectanceTable(brdf).nodes()) {
            ASSERT_GT(node.importance, 0.0F);
            ASSERT_LT(node.importance, 2.0F);  // |f_r| and a/pi each integrate to at most 1
            ASSERT_GE(node.transmission, -1e-6F);
            ASSERT_LE(node.scale + node.bias, 1.0F + 1e-6F);
        }
    }
}

TEST(GgxAlbedo, MeanIsTheMeanOverTheHemisphere) {
    for (const float alpha : {0.0021F, 0.05F, 0.4F, 1.0F}) {
        double scale = 0.0;
        double bias = 0.0;
        constexpr int n = 100'000;
        for (int i = 0; i < n; ++i) {  // even in cos^2: weighted by the cosine
            const LobeAlbedo a = ggx_albedo(alpha, std::sqrt((static_cast<float>(i) + 0.5F) / n));
            scale += static_cast<double>(a.scale) / n;
            bias += static_cast<double>(a.bias) / n;
        }
        EXPECT_NEAR(static_cast<double>(ggx_mean_albedo(alpha).scale), scale, 2e-5);
        EXPECT_NEAR(static_cast<double>(ggx_mean_albedo(alpha).bias), bias, 2e-5);
    }
}

/// Neighbouring alphas must not jump; and a white mirror loses nothing.
TEST(GgxAlbedo, IsContinuousInAlpha) {
    for (int i = 1; i < 2000; ++i) {
        const float a = 0.0021F + static_cast<float>(i) * 4.9e-4F;
        for (const float c : {0.05F, 0.5F, 1.0F}) {
            EXPECT_NEAR(ggx_albedo(a, c).scale, ggx_albedo(a + 4.9e-4F, c).scale, 3e-3F);
        }
    }
    EXPECT_NEAR(ggx_albedo(0.0F, 0.8F).scale + ggx_albedo(0.0F, 0.8F).bias, 1.0F, 1e-3F);
}

}  // namespace
}  // namespace raybundle::test
