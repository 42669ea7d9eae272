// SPDX-License-Identifier: Apache-2.0
#include "session/measure/measure_messages.h"

#include <cmath>

#include "measure/daylight_scene.h"
#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

constexpr double usual_error = 0.05;
constexpr double usual_maintenance = 0.8;

glm::dvec3 vector(const v1::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

/// Without its margin.
MeasuredArea area_of(const v1::Measure& measure) {
    MeasuredArea area{vector(measure.area().origin()), vector(measure.area().u()),
                      vector(measure.area().v())};
    const double margin = static_cast<double>(measure.margin());
    const glm::dvec3 u = margin * glm::normalize(area.u);
    const glm::dvec3 v = margin * glm::normalize(area.v);
    return {area.origin + u + v, area.u - 2.0 * u, area.v - 2.0 * v};
}

/// Up where the area is level: u and v may turn either way.
glm::dvec3 normal_of(const MeasuredArea& area) {
    const glm::dvec3 normal = glm::cross(area.u, area.v);
    return std::abs(normal.y) > 0.5 * glm::length(normal) && normal.y < 0.0 ? -normal : normal;
}

void place_on_area(const v1::Measure& measure, MeasureRequest& request) {
    const MeasuredArea area = area_of(measure);
    request.grid = {measure.columns(), measure.rows()};
    if (measure.grid() == v1::Measure::EN12464) {
        request.grid = en12464_grid(area);
        request.spacing = en12464_spacing(glm::length(area.u), glm::length(area.v));
    }
    if (request.grid.points() > PointMeasurement::most_points) {
        return;
    }
    const glm::dvec3 direction =
        measure.has_direction() ? vector(measure.direction()) : normal_of(area);
    for (const glm::dvec3& position : points_of(area, request.grid)) {
        request.task.points.push_back({position, direction});
    }
}

using SetFloat = void (v1::Measured::*)(float);

void set_interval(const Interval& from, v1::Measured* message, SetFloat value, SetFloat low,
                  SetFloat high) {
    (message->*value)(static_cast<float>(from.value));
    (message->*low)(static_cast<float>(from.low));
    (message->*high)(static_cast<float>(from.high));
}

}  // namespace

MeasureRequest from_message(const v1::Measure& measure) {
    MeasureRequest request;
    request.quantity = measure.quantity();
    MeasurementSettings& settings = request.task.settings;
    settings.quantity = *quantity_named(v1::Measure::Quantity_Name(measure.quantity()));
    settings.direct = measure.direct();
    if (measure.maintained() || measure.has_maintenance_factor()) {
        request.factor = measure.has_maintenance_factor()
                             ? static_cast<double>(measure.maintenance_factor())
                             : usual_maintenance;
    }
    settings.factor = request.factor;
    if (settings.quantity == Quantity::daylight_factor) {
        settings.factor *= 100.0 / overcast_illuminance;
    }
    request.task.relative_error =
        measure.has_relative_error() ? static_cast<double>(measure.relative_error()) : usual_error;
    if (measure.has_area()) {
        place_on_area(measure, request);
    }
    for (const v1::Measure::Point& point : measure.points()) {
        request.task.points.push_back(
            {vector(point.position()),
             vector(point.has_normal() ? point.normal() : measure.direction())});
    }
    return request;
}

void to_message(const MeasureRequest& request, const PointMeasurer::Result& result,
                v1::Measured* message) {
    message->set_measurement(result.measurement);
    message->set_quantity(request.quantity);
    message->set_epoch(result.epoch);
    message->set_settled(1.0F);
    message->set_columns(request.grid.columns);
    message->set_rows(request.grid.rows);
    message->set_factor(static_cast<float>(request.factor));
    if (request.spacing > 0.0) {
        message->set_spacing(static_cast<float>(request.spacing));
    }
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        v1::Measured::Point& point = *message->add_points();
        to_message(glm::vec3(request.task.points[i].position), point.mutable_position());
        point.set_inside(result.inside[i]);
        if (!result.inside[i]) {
            point.set_value(static_cast<float>(result.values[i].value));
            point.set_low(static_cast<float>(result.values[i].low));
            point.set_high(static_cast<float>(result.values[i].high));
        }
    }
    if (!result.all) {
        return;
    }
    const MeasurementSummary& all = *result.all;
    using M = v1::Measured;
    set_interval(all.mean, message, &M::set_mean, &M::set_mean_low, &M::set_mean_high);
    set_interval(all.minimum, message, &M::set_minimum, &M::set_minimum_low, &M::set_minimum_high);
    set_interval(all.maximum, message, &M::set_maximum, &M::set_maximum_low, &M::set_maximum_high);
    set_interval(all.uniformity, message, &M::set_uniformity, &M::set_uniformity_low,
                 &M::set_uniformity_high);
    set_interval(all.diversity, message, &M::set_diversity, &M::set_diversity_low,
                 &M::set_diversity_high);
    if (std::isfinite(result.relative_error)) {
        message->set_relative_error(static_cast<float>(result.relative_error));
    }
}

}  // namespace raybundle
