// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/work_plane.h"
#include "raybundle.pb.h"
#include "session/measure/point_measurer.h"

namespace raybundle {

/// What a valid Measure asks for.
struct MeasureRequest {
    PointMeasurer::Task task;  ///< without points where there would be too many
    GridSize grid;             ///< 0 x 0: single points
    double spacing = 0.0;      ///< m, of EN 12464-1 where that chose the grid, else 0
    double factor = 1.0;       ///< of maintenance
    v1::Measure::Quantity quantity = v1::Measure::QUANTITY_UNSPECIFIED;
};
MeasureRequest from_message(const v1::Measure& measure);

void to_message(const MeasureRequest& request, const PointMeasurer::Result& result,
                v1::Measured* message);

}  // namespace raybundle
