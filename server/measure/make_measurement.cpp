// SPDX-License-Identifier: Apache-2.0
#include "measure/make_measurement.h"

#include <utility>

#include "measure/glare/dgp_measurement.h"
#include "measure/glare/ugr_measurement.h"

namespace raybundle {

std::size_t most_points(Quantity quantity) {
    return quantity == Quantity::dgp   ? DgpMeasurement::most_points
           : quantity == Quantity::ugr ? UgrMeasurement::most_points
                                       : PointMeasurement::most_points;
}

std::unique_ptr<Measurement> make_measurement(std::shared_ptr<const MeasuredScene> scene,
                                              std::vector<CalculationPoint> points,
                                              const MeasurementSettings& settings) {
    if (settings.quantity == Quantity::ugr) {
        return std::make_unique<UgrMeasurement>(
            std::move(scene), std::move(points),
            UgrSettings{settings.views, settings.small_sources, settings.seed});
    }
    if (settings.quantity == Quantity::dgp) {
        return std::make_unique<DgpMeasurement>(std::move(scene), std::move(points),
                                                DgpSettings{settings.views, settings.seed});
    }
    return std::make_unique<PointMeasurement>(std::move(scene), std::move(points), settings);
}

}  // namespace raybundle
