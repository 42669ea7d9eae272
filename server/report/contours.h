// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raybundle {

/// A piece of a line of equal values.
struct ContourPiece {
    glm::dvec2 from, to;  ///< in columns and rows of the grid, the first point at (0, 0)
};

/// Lines of equal values of a grid, row by row, by marching squares; values that are not finite
/// leave holes.
std::vector<ContourPiece> contour(std::span<const double> values, std::size_t columns,
                                  std::size_t rows, double level);

/// Round levels (1, 2 or 5 times a power of ten apart) between the least and largest value, five to
/// ten of them.
std::vector<double> round_levels(double least, double largest);

}  // namespace raybundle
