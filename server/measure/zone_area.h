// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "measure/work_plane.h"

namespace raybundle {

/// What is measured of a level polygon.
struct ZoneShape {
    std::vector<glm::dvec3> outline;  ///< corners, world space, m; as high as the first
    double margin = 0.0;              ///< m, along its edges, that is left out
    /// Above 0: the strip of this width around it instead of what is within, m.
    double surrounding = 0.0;
};

/// A grid over a polygon, of which only some points belong to it.
struct ZoneGrid {
    MeasuredArea area;                 ///< rectangle along the polygon's longest edge
    GridSize grid;                     ///< of that
    double spacing = 0.0;              ///< m, largest that EN 12464-1 allows, if that chose it
    std::vector<std::uint32_t> cells;  ///< numbers of the points that belong to it, row by row
    std::vector<glm::dvec3> points;    ///< these
};

/// Why a polygon cannot be measured: it has too few corners, no area, or crosses itself, e.g.
/// "crosses itself: the edge from corner 1 to 2 meets that from corner 3 to 4"; empty: it can.
std::string outline_problem(const std::vector<glm::dvec3>& outline);

/// wanted: points along the rectangle's sides, or 0 x 0: as dense as EN 12464-1 asks for the
/// rectangle, and of a strip at least one row of points. Without points where none of them lies in
/// the shape, or there are more than `most`.
ZoneGrid lay_grid(const ZoneShape& shape, const GridSize& wanted, std::uint64_t most);

/// Corners of an area, in order.
std::vector<glm::dvec3> outline_of(const MeasuredArea& area);

}  // namespace raybundle
