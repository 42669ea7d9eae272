// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "measure/make_measurement.h"
#include "measure/requirement.h"
#include "measure/zone_area.h"
#include "measure/zone_luminaires.h"

namespace raybundle {

/// What the options ask for.
struct MeasureTask {
    MeasurementSettings settings;
    std::vector<CalculationPoint> points;
    GridSize grid;            ///< 0 x 0: single points
    double spacing = 0.0;     ///< m, largest that EN 12464-1 allows, where that chose the grid
    GridSize spacing_grid;    ///< that it chose: of an outline, of the rectangle around it
    bool maintained = false;  ///< by the lamps' own factors
    std::optional<Requirement> requirement;
    std::vector<ZoneLuminaire> luminaires;  ///< that light the points, where has_luminaires()

    [[nodiscard]] std::vector<Check> checks(const Measurement& found) const {
        return requirement
                   ? check(*requirement, settings.quantity, found.all(), found.glare(), luminaires)
                   : std::vector<Check>();
    }
};

/// To the standard output; seconds: that it took.
void print_json(const MeasureTask& task, const Measurement& points, double seconds);
void print_text(const MeasureTask& task, const Measurement& points, double seconds);

}  // namespace raybundle
