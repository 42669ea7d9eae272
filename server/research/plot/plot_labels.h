// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace raybundle {

/// Moves texts that stand in one column apart: returns for each wanted height (pixels, downwards,
/// any order) one at least `spacing` from its neighbours, in the same order from top to bottom,
/// within [top, bottom] as far as there is room, and near what was wanted.
std::vector<double> spread_labels(const std::vector<double>& wanted, double spacing, double top,
                                  double bottom);

}  // namespace raybundle
