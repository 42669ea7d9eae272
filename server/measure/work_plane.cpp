// SPDX-License-Identifier: Apache-2.0
#include "measure/work_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raybundle {
namespace {

/// A side that is a whole number of steps long keeps it whatever its rounding.
std::uint32_t steps(double side, double spacing) {
    const double count = std::ceil(side / spacing * (1.0 - 1e-9));
    constexpr double most = std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint32_t>(std::clamp(count, 1.0, most));
}

}  // namespace

double en12464_spacing(double length, double width) {
    const double longer = std::max(length, width);
    const double shorter = std::min(length, width);
    const double d = longer >= 2.0 * shorter ? shorter : longer;
    return std::min(0.2 * std::pow(5.0, std::log10(d)), 10.0);
}

GridSize en12464_grid(const MeasuredArea& area) {
    const double length = glm::length(area.u);
    const double width = glm::length(area.v);
    const double spacing = en12464_spacing(length, width);
    return {steps(length, spacing), steps(width, spacing)};
}

std::vector<glm::dvec3> points_of(const MeasuredArea& area, const GridSize& grid) {
    std::vector<glm::dvec3> points;
    points.reserve(grid.points());
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            points.push_back(area.origin + (column + 0.5) / grid.columns * area.u +
                             (row + 0.5) / grid.rows * area.v);
        }
    }
    return points;
}

}  // namespace raybundle
