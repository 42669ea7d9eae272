// SPDX-License-Identifier: Apache-2.0
// Bundles become finer as the estimated noise falls.
#include <gtest/gtest.h>

#include "oracle/oracle_solve.h"

namespace raybundle::bundle_resolution_test {
namespace {

/// Iterations after which a room has fine bundles, if it may from 256 on.
std::uint64_t iterations_to_fine_bundles(float noise) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.5F), glm::vec3(100.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 6, wall);
    SolverSettings settings;
    settings.coarse = {64, 120};
    settings.fine = {128, 240};
    settings.coarse_iterations = 256;
    settings.fine_noise = noise;
    Solver solver(b.scene, b.mesh, settings);
    while (solver.resolution().hemicube != 128 && solver.iterations() < 4000) {
        solver.step({});
    }
    return solver.iterations();
}

TEST(BundleResolution, FollowsTheNoise) {
    EXPECT_EQ(iterations_to_fine_bundles(1.0F), 257U);
    const std::uint64_t low = iterations_to_fine_bundles(0.01F);
    EXPECT_GT(low, 300U);
    EXPECT_LT(low, 2000U);
    EXPECT_EQ(iterations_to_fine_bundles(0.0F), 8 * 256U + 1U);
}

/// The estimate is of the size of the error (here within a factor of 2.5 on either side).
TEST(HeavyBundleResolution, NoiseIsOfTheSizeOfTheError) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 6, wall);
    b.add_quad({1.5F, 2.9F, 2}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    OracleSettings settings;
    settings.iterations = 6000;
    settings.seed = 9;
    const auto truth = solve(b, settings).store().read_irradiance();
    settings.iterations = 600;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        settings.seed = seed;
        const Solver solver = solve(b, settings);
        const auto found = solver.store().read_irradiance();
        double square = 0.0;
        double error = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const auto exact = static_cast<double>(truth[i].x);
            square += exact * exact;
            error += std::pow(static_cast<double>(found[i].x) - exact, 2);
        }
        error = std::sqrt(error / square);
        EXPECT_GT(solver.noise(), error / 2.5);
        EXPECT_LT(solver.noise(), error * 2.5);
    }
}

}  // namespace
}  // namespace raybundle::bundle_resolution_test
