// SPDX-License-Identifier: Apache-2.0
#include "transport/strategy_mix.h"

#include <gtest/gtest.h>

#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle {
namespace {

void expect_distribution(const StrategyProbabilities& p) {
    EXPECT_FLOAT_EQ(p.layered + p.plane + p.perspective, 1.0F);
    EXPECT_GT(p.layered, 0.0F);
    EXPECT_GE(p.plane, 0.0F);
    EXPECT_GT(p.perspective, 0.0F);
}

TEST(StrategyMix, AgesFromTheFirstToTheLastProbabilities) {
    const StrategyMix mix = ageing_mix();
    for (std::uint64_t i = 0; i < 2 * StrategyMix::ageing_iterations; i += 32) {
        expect_distribution(mix.at(i));
        EXPECT_LE(mix.at(i).layered, mix.at(i + 32).layered);
    }
    EXPECT_FLOAT_EQ(mix.at(0).layered, mix.first().layered);
    EXPECT_FLOAT_EQ(mix.at(1'000'000'000'000).layered, mix.last().layered);
}

TEST(StrategyMix, ASkyAsksForParallelBundles) {
    SceneBuilder b;
    b.scene.sky_radiance = glm::vec3(100.0F);
    for (const std::uint64_t age : {0U, 300U, 3000U}) {
        const StrategyProbabilities p = with_sky(ageing_mix(), b.scene).at(age);
        expect_distribution(p);
        EXPECT_FLOAT_EQ(p.layered, 0.75F);
    }
    const StrategyMix alone(StrategyProbabilities{0.0F, 0.0F, 1.0F});
    EXPECT_FLOAT_EQ(with_sky(alone, b.scene).at(0).perspective, 1.0F);
}

/// Probabilities that change while a solution is made leave it unbiased: a furnace of albedo 0.5.
TEST(StrategyMix, AgeingKeepsTheFurnace) {
    SceneBuilder b;
    const auto m = b.add_material(glm::vec3(0.5F), glm::vec3(100.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 4, m);
    SolverSettings settings;
    settings.ageing = true;
    settings.coarse = {64, 120};
    settings.coarse_iterations = 1'000'000;
    Solver solver(b.scene, b.mesh, settings);
    while (solver.iterations() < 3072) {
        solver.step({});
    }
    double mean = 0.0;
    const auto irradiance = solver.store().read_irradiance();
    for (const glm::vec4& e : irradiance) {
        mean += static_cast<double>(e.x) / static_cast<double>(irradiance.size());
    }
    const double exact = 3.14159265358979 * 100.0 / 0.5;
    EXPECT_NEAR(mean, exact, 0.01 * exact);
}

}  // namespace
}  // namespace raybundle
