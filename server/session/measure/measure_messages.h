// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "measure/requirement.h"
#include "measure/work_plane.h"
#include "raybundle.pb.h"
#include "session/measure/point_measurer.h"

namespace raybundle {

/// What a valid Measure asks for.
struct MeasureRequest {
    PointMeasurer::Task task;  ///< without points where there would be too many
    GridSize grid;             ///< 0 x 0: single points, or those of a polygon
    double spacing = 0.0;      ///< m, of EN 12464-1 where that chose the grid, else 0
    double factor = 1.0;       ///< of maintenance
    v1::Measure::Quantity quantity = v1::Measure::QUANTITY_UNSPECIFIED;
    std::string problem{};  ///< of its outline, which has no points then; empty: none
    // Of an area, to draw it.
    std::vector<glm::dvec3> outline;   ///< its corners
    MeasuredArea lattice;              ///< what the grid lies on
    GridSize lattice_size;             ///< its points
    std::vector<std::uint32_t> cells;  ///< which of them are measured, row by row
};
MeasureRequest from_message(const v1::Measure& measure);

void to_message(const MeasureRequest& request, const PointMeasurer::Result& result,
                v1::Measured* message);
/// What is there before anything is known of it.
void describe(const MeasureRequest& request, v1::Measured* message);
void to_message(std::span<const Check> checks, v1::Measured* message);

}  // namespace raybundle
