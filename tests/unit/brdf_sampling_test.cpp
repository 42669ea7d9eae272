// SPDX-License-Identifier: Apache-2.0
// Sampling of BRDFs against their densities.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "random_brdf.h"
#include "scene/material/reflectance_table.h"

namespace raybundle::test {
namespace {

using std::numbers::pi;
constexpr int bin_rows = 24;  // of bins over the sphere, even in the cosine
constexpr int bin_columns = 48;

struct Case {
    const char* name;
    float roughness;
    float metallic;
    float exponent;  // > 0: max-Phong
    float cosine;
    float coat = -1.0F;  // roughness of a clear coat
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

constexpr Case cases[] = {
    {"lambert_part_only", -1.0F, 0.0F, 0.0F, 0.5F},
    {"rough_metal", 1.0F, 1.0F, 0.0F, 0.7F},
    {"rough_metal_grazing", 1.0F, 1.0F, 0.0F, 0.02F},
    {"metal", 0.4F, 1.0F, 0.0F, 1.0F},
    {"metal_grazing", 0.4F, 1.0F, 0.0F, 0.05F},
    {"plastic", 0.35F, 0.0F, 0.0F, 0.6F},
    {"plastic_grazing", 0.35F, 0.0F, 0.0F, 0.1F},
    {"half_metal", 0.5F, 0.5F, 0.0F, 0.3F},
    {"phong", -1.0F, 0.0F, 3.0F, 0.4F},
    {"sharp_phong", -1.0F, 0.0F, 40.0F, 0.9F},
    {"phong_grazing", -1.0F, 0.0F, 28.0F, 0.03F},
    {"coated_metal", 0.5F, 1.0F, 0.0F, 0.8F, 0.3F},
    {"coated_plastic_grazing", 0.6F, 0.0F, 0.0F, 0.1F, 0.35F},
    {"coated_lambert", -1.0F, 0.0F, 0.0F, 0.5F, 0.4F},
};

Brdf brdf_of(const Case& c) {
    Material material;
    material.metallic = c.metallic;
    material.roughness = std::max(c.roughness, 0.0F);
    material.specular = c.roughness < 0.0F ? 0.0F : 1.0F;
    if (c.exponent > 0.0F) {
        material.max_phong = MaxPhong{{0.5F, 0.4F, 0.3F}, c.exponent};
    }
    material.clear_coat = c.coat < 0.0F ? 0.0F : 0.9F;
    material.clear_coat_roughness = c.coat;
    return make_brdf(material, {0.4F, 0.3F, 0.6F});
}

/// A direction that is not in a plane of symmetry of the bins.
glm::vec3 tilted(float cosine) {
    const float sine = std::sqrt(1.0F - cosine * cosine);
    return {sine * std::cos(1.1F), sine * std::sin(1.1F), cosine};
}

std::size_t bin(int row, int column) {
    return static_cast<std::size_t>(row) * bin_columns + static_cast<std::size_t>(column);
}

/// Probability of each bin: the density's integral, midpoints.
std::vector<double> bin_probabilities(const Brdf& brdf, const glm::vec3& w_out) {
    constexpr int fine = 24;
    std::vector<double> result(std::size_t{bin_rows} * bin_columns);
    for (int i = 0; i < bin_rows * fine; ++i) {
        const double z = -1.0 + 2.0 * (i + 0.5) / (bin_rows * fine);
        const double sine = std::sqrt(1.0 - z * z);
        for (int j = 0; j < bin_columns * fine; ++j) {
            const double phi = 2.0 * pi * (j + 0.5) / (bin_columns * fine);
            const glm::vec3 w(sine * std::cos(phi), sine * std::sin(phi), z);
            result[bin(i / fine, j / fine)] += static_cast<double>(pdf(brdf, w, w_out)) * 4.0 * pi /
                                               (double{bin_rows} * bin_columns * fine * fine);
        }
    }
    return result;
}

std::vector<int> bin_counts(const Brdf& brdf, const glm::vec3& w_out, int samples) {
    RandomBrdfs random(21);
    std::vector<int> result(std::size_t{bin_rows} * bin_columns);
    for (int i = 0; i < samples; ++i) {
        const float u = random.uniform();
        const float v = random.uniform();
        const glm::vec3 w = sample(brdf, w_out, {u, v}, random.uniform()).w_in;
        const float turn = std::atan2(w.y, w.x) / (2.0F * glm::pi<float>());
        const int row =
            std::clamp(static_cast<int>((w.z + 1.0F) * 0.5F * bin_rows), 0, bin_rows - 1);
        const int column = std::clamp(static_cast<int>((turn - std::floor(turn)) * bin_columns), 0,
                                      bin_columns - 1);
        ++result[bin(row, column)];
    }
    return result;
}

/// Pearson's statistic as a standard normal variable (Wilson and Hilferty 1931). Bins that expect
/// fewer than 5 are pooled.
double chi_square_score(const std::vector<double>& probability, const std::vector<int>& count,
                        int samples) {
    double statistic = 0.0;
    double pooled_expected = 0.0;
    double pooled_count = 0.0;
    int bins = 0;
    for (std::size_t i = 0; i < count.size(); ++i) {
        const double expected = probability[i] * samples;
        if (expected < 5.0) {
            pooled_expected += expected;
            pooled_count += count[i];
        } else {
            statistic += std::pow(count[i] - expected, 2.0) / expected;
            ++bins;
        }
    }
    if (pooled_expected >= 5.0) {
        statistic += std::pow(pooled_count - pooled_expected, 2.0) / pooled_expected;
        ++bins;
    } else {
        EXPECT_LT(pooled_count, pooled_expected + 5.0 * std::sqrt(pooled_expected) + 5.0);
    }
    const double freedom = bins - 1.0;
    const double spread = 2.0 / (9.0 * freedom);
    return (std::cbrt(statistic / freedom) - (1.0 - spread)) / std::sqrt(spread);
}

class BrdfSampling : public testing::TestWithParam<Case> {};

/// Chi-square over 1152 bins, 400 000 samples. The score is a standard normal variable, so a right
/// sampler fails with a probability of 1e-4 for a seed; a density 10 % too wide has to fail.
TEST_P(BrdfSampling, SamplesFollowTheDensity) {
    constexpr int samples = 400'000;
    constexpr double limit = 3.72;
    const Brdf brdf = brdf_of(GetParam());
    const glm::vec3 w_out = tilted(GetParam().cosine);
    const std::vector<int> counts = bin_counts(brdf, w_out, samples);
    EXPECT_LT(chi_square_score(bin_probabilities(brdf, w_out), counts, samples), limit);
    if (brdf.lobe.kind != LobeKind::none) {
        Brdf wider = brdf;
        wider.lobe.alpha *= 1.1F;
        wider.lobe.exponent *= 0.9F;
        wider.lobe.coat.alpha *= 1.1F;
        EXPECT_GT(chi_square_score(bin_probabilities(wider, w_out), counts, samples), limit);
    }
}

TEST_P(BrdfSampling, DensityIntegratesToOne) {
    const Brdf brdf = brdf_of(GetParam());
    double total = 0.0;
    for (const double probability : bin_probabilities(brdf, tilted(GetParam().cosine))) {
        total += probability;
    }
    EXPECT_NEAR(total, 1.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Materials, BrdfSampling, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

struct Estimate {
    double mean = 0.0;
    double error = 0.0;  // standard error of the mean
};

/// The largest channel of the albedo, estimated as a path tracer would.
Estimate estimate_albedo(const Brdf& brdf, float cosine, int samples, RandomBrdfs& random) {
    const glm::vec3 w_out = tilted(cosine);
    glm::dvec3 sum(0.0);
    glm::dvec3 squares(0.0);
    for (int i = 0; i < samples; ++i) {
        const float u = random.uniform();
        const float v = random.uniform();
        const BrdfSample drawn = sample(brdf, w_out, {u, v}, random.uniform());
        const glm::dvec3 x = glm::dvec3(evaluate(brdf, drawn.w_in, w_out) *
                                        std::max(drawn.w_in.z, 0.0F) / drawn.pdf);
        sum += x;
        squares += x * x;
    }
    const glm::dvec3 mean = sum / static_cast<double>(samples);
    const int c = mean.r > mean.g ? (mean.r > mean.b ? 0 : 2) : (mean.g > mean.b ? 1 : 2);
    const double variance = std::max(0.0, squares[c] / samples - mean[c] * mean[c]);
    return {mean[c], std::sqrt(variance / samples)};
}

/// Within five standard errors (a right one leaves them once in 1.7 million draws) and the table's
/// 0.5 %, down to grazing angles and mirrors.
TEST(BrdfEstimator, FindsTheAlbedo) {
    RandomBrdfs random(22);
    for (int i = 0; i < 24; ++i) {
        Material material = random.material();
        if (i % 3 == 0) {
            material.roughness = 0.02F * static_cast<float>(i % 9);
        }
        if (i % 4 == 1) {
            material.max_phong.reset();
            material.clear_coat = 1.0F;
            material.clear_coat_roughness = 0.04F * static_cast<float>(i);
        }
        const Brdf brdf = make_brdf(material, material.base_colour);
        const ReflectanceTable table(brdf);
        for (const float c : {1e-4F, 2e-3F, 0.02F, 0.3F, 0.9F}) {
            if (material.clear_coat > 0.0F && c < 0.02F) {
                continue;  // the table's nodes are those of the lobe below
            }
            const Estimate estimate = estimate_albedo(brdf, c, 20'000, random);
            const glm::vec3 albedo = table.albedo(c);
            const auto expected = static_cast<double>(std::max({albedo.r, albedo.g, albedo.b}));
            ASSERT_NEAR(estimate.mean, expected, 5.0 * estimate.error + 5e-3 * expected)
                << "material " << i << " alpha " << brdf.lobe.alpha << " cos " << c;
        }
    }
}

/// The white furnace where quadrature is hard: smooth lobes near the horizon. Five standard errors.
TEST(BrdfEstimator, NeverCreatesEnergyNearTheHorizon) {
    RandomBrdfs random(23);
    for (const float roughness : {0.0F, 0.06F, 0.1F, 0.2F, 0.5F, 1.0F}) {
        for (const float colour : {1.0F, 25.0F}) {
            Material material;
            material.metallic = 0.0F;
            material.roughness = roughness;
            material.specular_colour = glm::vec3(colour);
            const Brdf brdf = make_brdf(material, glm::vec3(1.0F));
            for (const float c : {1e-5F, 1e-4F, 1e-3F, 3e-3F, 8e-3F, 0.022F}) {
                const Estimate estimate = estimate_albedo(brdf, c, 40'000, random);
                ASSERT_LT(estimate.mean, 1.0 + 5.0 * estimate.error) << roughness << " " << c;
                ASSERT_LT(estimate.error, 8e-3) << roughness << " " << c;
            }
        }
    }
}

}  // namespace
}  // namespace raybundle::test
