// SPDX-License-Identifier: Apache-2.0
// What a patch is to be, by several fresh solves.
#pragma once

#include <cstdint>
#include <vector>

#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle {

/// Luminance of the irradiance of every patch, lx.
std::vector<double> luminances(const Solver& solver);

/// Mean and standard deviation of single solves, of every patch.
struct FreshSolves {
    std::vector<double> mean;
    std::vector<double> deviation;
    int solves = 0;

    /// Largest distance of a solution from the mean, in standard deviations of the difference.
    [[nodiscard]] double worst(const std::vector<double>& solution) const;
    /// Sum of a solution over that of the mean.
    [[nodiscard]] double level(const std::vector<double>& solution) const;
};

/// `solves` of them, with seeds from settings.seed on. Of few solves one patch in many has too
/// small a deviation by chance: none is below what all have together, relative to their means; and
/// where it is dark, none is below 0.2 % of the mean of all patches.
FreshSolves solve_afresh(const SceneBuilder& b, SolverSettings settings, int solves,
                         std::uint64_t iterations);

}  // namespace raybundle
