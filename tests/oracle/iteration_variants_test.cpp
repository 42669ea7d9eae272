// SPDX-License-Identifier: Apache-2.0
// Variants of the iteration that the dissertation compares: bias traded for noise (ch. 5.4), and
// stochastic iteration without a separated main part (ch. 4.4).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle::iteration_variants_test {
namespace {

/// Mean irradiance of all patches in a room lit by one small lamp.
std::vector<float> solve_room(const SolverSettings& changed, std::uint64_t iterations) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.5F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 8, wall);
    b.add_quad({1.5F, 2.9F, 2}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    SolverSettings settings = changed;
    settings.coarse = {128, 240};
    settings.coarse_iterations = 1'000'000;
    Solver solver(b.scene, b.mesh, settings);
    while (solver.iterations() < iterations) {
        solver.step({});
    }
    std::vector<float> result;
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        result.push_back(e.x);
    }
    return result;
}

const std::vector<float>& converged_room() {
    static const std::vector<float> room = [] {
        SolverSettings other_seed;
        other_seed.seed = 99;
        return solve_room(other_seed, 4096);
    }();
    return room;
}

struct Deviation {
    double mean = 0.0;
    double root_mean_square = 0.0;
    double worst = 0.0;
};

/// From the converged room, in units of its mean irradiance.
Deviation deviation(const SolverSettings& settings, std::uint64_t iterations) {
    const std::vector<float> found = solve_room(settings, iterations);
    const std::vector<float>& truth = converged_room();
    const double count = static_cast<double>(truth.size());
    const double level = std::accumulate(truth.begin(), truth.end(), 0.0) / count;
    Deviation d;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double x = static_cast<double>(found[i] - truth[i]) / level;
        d.mean += x / count;
        d.root_mean_square += x * x / count;
        d.worst = std::max(d.worst, std::abs(x));
    }
    d.root_mean_square = std::sqrt(d.root_mean_square);
    return d;
}

SolverSettings perspective_alone() {
    SolverSettings settings;
    settings.probabilities = {0.0F, 0.0F, 1.0F};
    return settings;
}

TEST(HeavyBiasForNoise, TamesTheCornersOfPerspectiveBundles) {
    SolverSettings biased = perspective_alone();
    constexpr std::uint64_t iterations = 200;
    biased.noise_horizon = iterations;
    const Deviation without = deviation(perspective_alone(), iterations);
    const Deviation with = deviation(biased, iterations);
    EXPECT_LT(with.worst, 0.75 * without.worst);
    EXPECT_LT(with.root_mean_square, without.root_mean_square);
    EXPECT_LT(with.mean, without.mean);  // what is cut off is missing
    EXPECT_GT(with.mean, without.mean - 0.1);
}

TEST(HeavyBiasForNoise, IsUnbiasedInTheLimit) {
    SolverSettings biased = perspective_alone();
    biased.noise_horizon = 4000;
    EXPECT_NEAR(deviation(biased, 4000).mean, 0.0, 0.01);
}

TEST(HeavyBiasForNoise, IsNotNeededBesideParallelBundles) {
    SolverSettings biased;
    biased.noise_horizon = 64;  // their density bounds what a perspective bundle brings
    EXPECT_EQ(deviation(biased, 64).worst, deviation({}, 64).worst);
}

TEST(HeavyMainPart, LowersTheErrorAtEqualIterations) {
    SolverSettings plain;
    plain.main_part = false;
    const Deviation without = deviation(plain, 400);
    const Deviation with = deviation({}, 400);
    EXPECT_LT(with.root_mean_square, 0.5 * without.root_mean_square);
}

/// Each bundle is divided by the density of the shares that it was drawn with: shares that change
/// are unbiased.
void expect_mean_left_by(const StrategyProbabilities& later) {
    SolverSettings settings;
    settings.adapt_probabilities = false;
    settings.first_probabilities = StrategyProbabilities{0.1F, 0.0F, 0.9F};
    settings.probabilities = later;
    EXPECT_NEAR(deviation(settings, 1024).mean, 0.0, 0.01);
}

TEST(HeavyShares, ThatChangeLeaveTheMean) {
    expect_mean_left_by({0.5F, 0.0F, 0.5F});
}

TEST(HeavyShares, ThatChangeLeaveTheMeanWithPlanesAmongThem) {
    expect_mean_left_by({0.15F, 0.15F, 0.7F});
}

}  // namespace
}  // namespace raybundle::iteration_variants_test
