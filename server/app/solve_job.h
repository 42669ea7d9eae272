// SPDX-License-Identifier: Apache-2.0
// Solving until the options say that it is enough.
#pragma once

#include "options/cli_options.h"
#include "transport/solver.h"
#include "view/final_picture.h"

namespace raybundle {

struct SolveOutcome {
    double seconds = 0.0;
    ImageStatistics statistics;  ///< of the picture
};

/// With a picture that takes part. Warns where --error is not reached.
SolveOutcome solve_picture(Solver& solver, FinalPicture& picture, const Options& options);

/// Patches alone, without --error; to the end of a group of iterations. Returns the time it took,
/// s.
double solve_patches(Solver& solver, const Options& options);

}  // namespace raybundle
