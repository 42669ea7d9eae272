// SPDX-License-Identifier: Apache-2.0
// What `accuracy` is to run, from the command line alone.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "options/cli_options.h"
#include "research/accuracy/error_curve.h"
#include "transport/solver.h"
#include "view/final_picture.h"

namespace raybundle {

/// One curve to measure: a method with its settings.
struct PlannedCurve {
    std::string method;  ///< of --method
    std::string name;    ///< of the curve
    std::string knob;    ///< what is varied; empty: nothing
    RenderMethod how;
    SolverSettings solver;                 ///< ray bundles
    double patch_scale = 1.0;              ///< of the edges, ray bundles
    PixelGrid grid = PixelGrid::adaptive;  ///< ray bundles
    std::string without;                   ///< effect that is taken out of the scene; empty: none

    [[nodiscard]] bool uses_bundles() const {
        return std::holds_alternative<StrategyProbabilities>(how);
    }
};

struct AccuracyJob {
    std::vector<PlannedCurve> curves;
    glm::uvec2 size{0};
    double seconds = 0.0;  ///< of each run
    std::size_t repeats = 1;
    double reference_seconds = 0.0;  ///< at most, for each reference

    [[nodiscard]] bool needs_gl() const;
    /// Solving time of all runs, s.
    [[nodiscard]] double run_seconds() const;
};

/// Throws UsageError.
AccuracyJob plan_accuracy(const Options& options);

}  // namespace raybundle
