// SPDX-License-Identifier: Apache-2.0
// An isothermal world: under a sky of radiance L, surfaces of albedo a that emit (1 - a) L send L
// everywhere, whatever their shape, and receive pi L. Lines meet any number of surfaces before the
// sky.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "oracle/oracle_solve.h"

namespace raybundle::sky_furnace_test {
namespace {

constexpr double sky = 100.0;  // cd/m²

/// A floor with shelves above it: up to twelve surfaces on a line.
SceneBuilder shelves() {
    SceneBuilder b;
    b.scene.sky_radiance = glm::vec3(static_cast<float>(sky));
    const auto m = b.add_material(glm::vec3(0.6F), glm::vec3(0.4F * static_cast<float>(sky)));
    for (int i = 0; i < 6; ++i) {
        const float y = 0.6F * static_cast<float>(i);
        const float x = 0.25F * static_cast<float>(i % 3);
        b.add_box({x, y, 0}, {x + 2.0F, y + 0.2F, 2}, false, 3, m);
    }
    return b;
}

class SkyFurnace : public testing::TestWithParam<StrategyProbabilities> {};

/// Within 1 % for each shelf: the noise of a shelf's mean is 0.2 % (eight seeds).
TEST_P(SkyFurnace, IsUniform) {
    const SceneBuilder b = shelves();
    OracleSettings settings;
    settings.probabilities = GetParam();
    const Solver solver = solve(b, settings);
    const auto irradiance = solver.store().read_irradiance();
    const std::size_t patches = b.mesh.patch_count() / 6;
    for (std::size_t shelf = 0; shelf < 6; ++shelf) {
        const double mean = mean_irradiance(b, irradiance, shelf * patches, (shelf + 1) * patches);
        EXPECT_NEAR(mean / (glm::pi<double>() * sky), 1.0, 0.01) << "shelf " << shelf;
    }
}

INSTANTIATE_TEST_SUITE_P(Strategies, SkyFurnace,
                         testing::Values(StrategyProbabilities{1.0F, 0.0F, 0.0F},
                                         StrategyProbabilities{0.5F, 0.0F, 0.5F},
                                         StrategyProbabilities{0.4F, 0.3F, 0.3F}));

}  // namespace
}  // namespace raybundle::sky_furnace_test
