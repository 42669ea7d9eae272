// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "measure/point_measurement.h"

namespace raybundle {

enum class Verdict { met, missed, unknown };
/// "met", "missed" or "not yet known".
const char* name_of(Verdict verdict);

/// What a task asks of its area, as a row of EN 12464-1 does.
struct Requirement {
    double mean = 0.0;                 ///< in the unit of the quantity, at least
    std::optional<double> uniformity;  ///< Uo, at least
};

/// By intervals: missed where one lies below what is required, met where all lie above, else
/// unknown.
Verdict judge(const Requirement& requirement, const MeasurementSummary& found);

}  // namespace raybundle
