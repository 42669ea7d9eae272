// SPDX-License-Identifier: Apache-2.0
#include "transport/strategy_mix.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle::strategy_mix_test {
namespace {

void expect_distribution(const StrategyProbabilities& p) {
    EXPECT_FLOAT_EQ(p.layered + p.plane + p.perspective, 1.0F);
    EXPECT_GT(p.layered, 0.0F);
    EXPECT_GE(p.plane, 0.0F);
    EXPECT_GT(p.perspective, 0.0F);
}

/// Adapts over and over to bundles that scatter so, squared, whatever the odds.
StrategyProbabilities settle(StrategyMix mix, double layered_scatter, double perspective_scatter) {
    std::array<double, 2> counted{};
    std::array<double, 2> sums{};
    for (int round = 0; round < 50; ++round) {
        const int layered = static_cast<int>(std::lround(100.0F * mix.probabilities().layered));
        mix.count(Strategy::layered, layered);
        mix.count(Strategy::perspective, 100 - layered);
        mix.count(Strategy::plane, 7);  // does not matter
        counted[0] += layered;
        counted[1] += 100 - layered;
        sums[0] += layered * layered_scatter;
        sums[1] += (100 - layered) * perspective_scatter;
        mix.adapt(sums);
        for (std::size_t i = 0; i < 2; ++i) {
            counted[i] *= 0.5;
            sums[i] *= 0.5;
        }
        expect_distribution(mix.probabilities());
    }
    return mix.probabilities();
}

/// A third of the way, as logarithms, from where the scatter is worth its cost.
TEST(StrategyMix, TurnsToWhatScattersMore) {
    const StrategyMix mix({0.3F, 0.0F, 0.7F}, true);
    EXPECT_NEAR(settle(mix, layered_bundle_cost, 1.0).layered, 0.3F, 1e-4F);
    for (const double ratio : {0.2, 0.5, 3.0, 20.0}) {
        const double odds = 3.0 / 7.0 * std::cbrt(ratio);
        EXPECT_NEAR(settle(mix, ratio * layered_bundle_cost, 1.0).layered, odds / (1.0 + odds),
                    1e-4)
            << ratio;
    }
    EXPECT_FLOAT_EQ(settle(mix, 1e9, 1.0).layered, 0.9F);
    EXPECT_FLOAT_EQ(settle(mix, 1e-9, 1.0).layered, 0.1F);
}

TEST(StrategyMix, StaysWhereNothingIsKnown) {
    StrategyMix mix({0.3F, 0.0F, 0.7F}, true);
    EXPECT_FALSE(mix.is_due());
    mix.adapt({1.0, 50.0});  // of no bundles
    EXPECT_FLOAT_EQ(mix.probabilities().layered, 0.3F);
    mix.count(Strategy::perspective, 100);
    EXPECT_TRUE(mix.is_due());
    mix.adapt({0.0, 50.0});
    EXPECT_FLOAT_EQ(mix.probabilities().layered, 0.3F);
    mix.count(Strategy::layered, 100);
    mix.adapt({std::numeric_limits<double>::quiet_NaN(), 50.0});
    EXPECT_FLOAT_EQ(mix.probabilities().layered, 0.3F);
    mix.count(Strategy::layered, 100);
    mix.forget();
    EXPECT_FALSE(mix.is_due());
    for (const StrategyProbabilities& given :
         {StrategyProbabilities{0.0F, 0.0F, 1.0F}, StrategyProbabilities{1.0F, 0.0F, 0.0F}}) {
        EXPECT_FALSE(StrategyMix(given, true).adaptive());
    }
    EXPECT_FALSE(StrategyMix({0.3F, 0.0F, 0.7F}, false).adaptive());
}

TEST(StrategyMix, ASkyAsksForParallelBundles) {
    SceneBuilder b;
    b.scene.sky_radiance = glm::vec3(100.0F);
    const StrategyProbabilities p = suited_to(b.scene, {0.3F, 0.0F, 0.7F});
    expect_distribution(p);
    EXPECT_FLOAT_EQ(p.layered, 0.75F);
    EXPECT_FLOAT_EQ(suited_to(b.scene, {0.0F, 0.0F, 1.0F}).perspective, 1.0F);
}

TEST(StrategyMix, PunctualLightsAloneAskForHalfOfThem) {
    SceneBuilder b;
    b.scene.punctual_lights.emplace_back();
    for (const StrategyProbabilities& given :
         {StrategyProbabilities{0.3F, 0.0F, 0.7F}, StrategyProbabilities{0.15F, 0.15F, 0.7F}}) {
        const StrategyProbabilities p = suited_to(b.scene, given);
        expect_distribution(p);
        EXPECT_FLOAT_EQ(p.layered, 0.5F);
        EXPECT_FLOAT_EQ(p.plane, given.plane);
    }
    b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
    EXPECT_FLOAT_EQ(suited_to(b.scene, {0.3F, 0.0F, 0.7F}).layered, 0.3F);
}

Solver furnace(const SceneBuilder& b, std::uint64_t iterations) {
    SolverSettings settings;
    settings.coarse = {64, 120};
    settings.coarse_iterations = 1'000'000;
    Solver solver(b.scene, b.mesh, settings);
    while (solver.iterations() < iterations) {
        solver.step({});
    }
    return solver;
}

/// Probabilities that change while a solution is made leave it unbiased, and a seed gives the same
/// ones again: a furnace of albedo 0.5.
TEST(StrategyMix, AdaptingKeepsTheFurnace) {
    SceneBuilder b;
    const auto m = b.add_material(glm::vec3(0.5F), glm::vec3(100.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 4, m);
    const Solver solver = furnace(b, 3072);
    EXPECT_GT(std::fabs(solver.probabilities().layered - 0.3F), 0.01F);
    double mean = 0.0;
    const auto irradiance = solver.store().read_irradiance();
    for (const glm::vec4& e : irradiance) {
        mean += static_cast<double>(e.x) / static_cast<double>(irradiance.size());
    }
    const double exact = 3.14159265358979 * 100.0 / 0.5;
    EXPECT_NEAR(mean, exact, 0.01 * exact);

    const Solver first = furnace(b, 320);
    const Solver second = furnace(b, 320);
    EXPECT_EQ(first.probabilities().layered, second.probabilities().layered);
    EXPECT_EQ(first.store().read_irradiance(), second.store().read_irradiance());
}

}  // namespace
}  // namespace raybundle::strategy_mix_test
