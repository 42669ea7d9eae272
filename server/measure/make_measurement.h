// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "measure/point_measurement.h"

namespace raybundle {

/// Most points that a measurement of this quantity has.
std::size_t most_points(Quantity quantity);

/// A measurement of the quantity. Throws std::invalid_argument where there are no points, or too
/// many.
std::unique_ptr<Measurement> make_measurement(std::shared_ptr<const MeasuredScene> scene,
                                              std::vector<CalculationPoint> points,
                                              const MeasurementSettings& settings);

}  // namespace raybundle
