// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace raybundle {

/// A parallelogram on which points are measured, metres, world space.
struct MeasuredArea {
    glm::dvec3 origin{0.0};  ///< a corner
    glm::dvec3 u{0.0};       ///< its two edges from there
    glm::dvec3 v{0.0};
};

struct GridSize {
    std::uint32_t columns = 0;  ///< along u
    std::uint32_t rows = 0;     ///< along v

    [[nodiscard]] std::uint64_t points() const { return std::uint64_t{columns} * rows; }
};

/// Largest distance of points, m, that EN 12464-1 allows on an area: p = 0.2 * 5^log10(d), at most
/// 10 m, d the longer side, or the shorter where the longer is twice as long or more.
double en12464_spacing(double length, double width);
/// So many points that they lie no further apart than that.
GridSize en12464_grid(const MeasuredArea& area);
/// Row by row along u, evenly spaced, half a step from the edges.
std::vector<glm::dvec3> points_of(const MeasuredArea& area, const GridSize& grid);

}  // namespace raybundle
