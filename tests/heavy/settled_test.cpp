// SPDX-License-Identifier: Apache-2.0
// `settled` is 1 - remaining correction / size of the correction (design, "Words"), where the noise
// that the solution had before the change is no part of what remains; a corrected solution is
// better than a stale one. Both against converged fresh solves.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "../oracle/fresh_solves.h"
#include "../oracle/moved_box.h"

namespace raybundle {
namespace {

SolverSettings quick(std::uint64_t seed) {
    return quick_settings(seed, {96, 150});
}

std::vector<double> converged(const glm::vec3& place, std::uint64_t seed) {
    const SceneBuilder b = room_with_box(place);
    Solver fresh(b.scene, b.mesh, quick(seed));
    iterate(fresh, 1536);
    return luminances(fresh);
}

/// Area-weighted distance over the patches that a change concerns (by more than 1 %).
double distance(const std::vector<double>& a, const std::vector<double>& truth,
                const std::vector<double>& stale) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::abs(truth[i] - stale[i]) > 0.01 * std::max(truth[i], stale[i])) {
            sum += (a[i] - truth[i]) * (a[i] - truth[i]);
        }
    }
    return std::sqrt(sum);
}

const std::vector<glm::vec3> places = {
    {1.2F, 0, 1.5F}, {2.6F, 0, 2.4F}, {1.0F, 0.8F, 3.0F}, {2.0F, 0, 1.0F}, {3.2F, 0.3F, 1.2F}};

TEST(Settled, IsTheShareOfTheCorrectionThatIsWorkedIn) {
    const std::vector<double> truth = converged(places[1], 50);
    const std::vector<double> truth_before = converged(places[0], 51);
    double worst = 0.0;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const SceneBuilder b = room_with_box(places[0]);
        Solver solver(b.scene, b.mesh, quick(seed));
        iterate(solver, 1024);
        const std::vector<double> stale = luminances(solver);
        const double size = distance(stale, truth, stale);
        double noise = 0.0;  // squared, of the patches that distance() looks at
        for (std::size_t i = 0; i < stale.size(); ++i) {
            if (std::abs(truth[i] - stale[i]) > 0.01 * std::max(truth[i], stale[i])) {
                noise += (stale[i] - truth_before[i]) * (stale[i] - truth_before[i]);
            }
        }
        move_box(solver, places[1]);
        for (const std::uint64_t more : {0U, 32U, 64U, 128U, 256U, 512U}) {
            iterate(solver, more);
            const double left = distance(luminances(solver), truth, stale);
            const double actual = 1.0 - std::sqrt(std::max(left * left - noise, 0.0)) / size;
            const double settled = solver.statistics().settled;
            worst = std::max(worst, std::abs(settled - actual));
            EXPECT_NEAR(settled, actual, 0.2) << "seed " << seed << ", after " << more << " more";
            RecordProperty("seed" + std::to_string(seed) + "_" + std::to_string(more),
                           std::to_string(settled) + " " + std::to_string(actual));
        }
        EXPECT_GT(solver.statistics().settled, 0.9);
    }
    RecordProperty("worst", std::to_string(worst));
}

/// >= 95 % of moves and seeds: 57 of 60 is the least count that passes. Were the share of better
/// ones 0.99, 57 or more would be counted with probability 0.997; were it 0.85, with 0.5 %.
TEST(Settled, ACorrectedSolutionIsBetterThanTheStaleOne) {
    std::map<std::size_t, std::vector<double>> truths;
    for (std::size_t i = 0; i < places.size(); ++i) {
        truths[i] = converged(places[i], 60 + i);
    }
    int better = 0;
    int moves = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const SceneBuilder b = room_with_box(places[0]);
        Solver solver(b.scene, b.mesh, quick(seed));
        iterate(solver, 256);
        for (std::size_t i = 1; i <= 10; ++i) {
            const std::size_t to = (i * (1 + seed % 2)) % places.size();
            const std::vector<double> stale = luminances(solver);
            move_box(solver, places[to]);
            const double after = distance(luminances(solver), truths[to], stale);
            better += after < distance(stale, truths[to], stale) ? 1 : 0;
            ++moves;
            iterate(solver, 32);
        }
    }
    EXPECT_EQ(moves, 60);
    EXPECT_GE(better, 57);
    RecordProperty("better", better);
}

}  // namespace
}  // namespace raybundle
