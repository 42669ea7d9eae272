// SPDX-License-Identifier: Apache-2.0
#include "fresh_solves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "moved_box.h"

namespace raybundle {

std::vector<double> luminances(const Solver& solver) {
    std::vector<double> result;
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        result.push_back(static_cast<double>(luminance(glm::vec3(e))));
    }
    return result;
}

double FreshSolves::worst(const std::vector<double>& solution) const {
    const double spread = std::sqrt(1.0 + 1.0 / solves);
    double largest = 0.0;
    for (std::size_t i = 0; i < solution.size(); ++i) {
        const double distance = std::abs(solution[i] - mean[i]);
        largest = std::isfinite(distance) ? std::max(largest, distance / (spread * deviation[i]))
                                          : std::numeric_limits<double>::infinity();
    }
    return largest;
}

double FreshSolves::level(const std::vector<double>& solution) const {
    return std::accumulate(solution.begin(), solution.end(), 0.0) /
           std::accumulate(mean.begin(), mean.end(), 0.0);
}

FreshSolves solve_afresh(const SceneBuilder& b, SolverSettings settings, int solves,
                         std::uint64_t iterations) {
    std::vector<std::vector<double>> runs;
    for (int k = 0; k < solves; ++k) {
        Solver fresh(b.scene, b.mesh, settings);
        iterate(fresh, iterations);
        runs.push_back(luminances(fresh));
        ++settings.seed;
    }
    FreshSolves result;
    result.solves = solves;
    double pooled = 0.0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < runs.front().size(); ++i) {
        double sum = 0.0;
        double squares = 0.0;
        for (const std::vector<double>& run : runs) {
            sum += run[i] / solves;
            squares += run[i] * run[i] / solves;
        }
        const double variance = std::max(squares - sum * sum, 0.0) * solves / (solves - 1.0);
        result.mean.push_back(sum);
        result.deviation.push_back(std::sqrt(variance));
        if (sum > 0.0) {
            pooled += variance / (sum * sum);
            ++lit;
        }
    }
    const double dark = 0.002 * std::accumulate(result.mean.begin(), result.mean.end(), 0.0) /
                        static_cast<double>(result.mean.size());
    const double least = lit > 0 ? std::sqrt(pooled / static_cast<double>(lit)) : 0.0;
    for (std::size_t i = 0; i < result.mean.size(); ++i) {
        result.deviation[i] = std::max({result.deviation[i], least * result.mean[i], dark});
    }
    return result;
}

}  // namespace raybundle
