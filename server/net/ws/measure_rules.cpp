// SPDX-License-Identifier: Apache-2.0
#include "net/ws/measure_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace raybundle {
namespace {

constexpr double kMinEdge = 1e-6;  ///< of a direction or an edge
constexpr std::uint64_t kMaxMeasuredPoints = 4096;

glm::dvec3 vector_of(const v1::Vec3& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

/// Whether a direction says where a receiver faces: also across the vertical, if it is to stand.
bool faces(const v1::Vec3& direction, v1::Measure::Quantity quantity) {
    const glm::dvec3 v = vector_of(direction);
    return quantity == v1::Measure::NORMAL ? glm::length(v) >= kMinEdge
                                           : std::hypot(v.x, v.z) >= kMinEdge;
}

void check_directions(const v1::Measure& measure, MessageChecker& check) {
    const v1::Measure::Quantity quantity = measure.quantity();
    const bool wanted = quantity == v1::Measure::VERTICAL || quantity == v1::Measure::NORMAL ||
                        quantity == v1::Measure::SEMICYLINDRICAL;
    if (!wanted) {
        return;
    }
    const bool own = quantity == v1::Measure::NORMAL && measure.has_area();
    check.require(own || measure.has_direction() || !measure.points().empty(), "measure.direction",
                  "is missing");
    check.require(!measure.has_direction() || faces(measure.direction(), quantity),
                  "measure.direction", "must not be zero, nor vertical where it is to stand");
    for (const v1::Measure::Point& point : measure.points()) {
        const bool faced =
            point.has_normal() ? faces(point.normal(), quantity) : measure.has_direction();
        check.require(faced, "measure.points.normal", "is missing, zero, or vertical");
    }
}

void check_area(const v1::Measure& measure, MessageChecker& check) {
    const glm::dvec3 u = vector_of(measure.area().u());
    const glm::dvec3 v = vector_of(measure.area().v());
    check.require(measure.area().has_origin(), "measure.area.origin", "is missing");
    check.require(glm::length(u) >= kMinEdge, "measure.area.u", "must not be zero");
    check.require(glm::length(v) >= kMinEdge, "measure.area.v", "must not be zero");
    const double sine = glm::length(glm::cross(glm::normalize(u), glm::normalize(v)));
    check.require(sine >= kMinEdge, "measure.area.v", "must not lie along u");
    const double margin = static_cast<double>(measure.margin());
    check.require(margin >= 0.0 && 2.0 * margin < std::min(glm::length(u), glm::length(v)),
                  "measure.margin", "must not be negative, and must leave some of the area");
    const std::uint64_t points = std::uint64_t{measure.columns()} * measure.rows();
    check.require(measure.grid() == v1::Measure::EN12464
                      ? points == 0
                      : points >= 1 && points <= kMaxMeasuredPoints,
                  "measure.columns", "needs grid EN12464, or columns times rows of 1..4096");
}

}  // namespace

void check_measure(const v1::Measure& measure, MessageChecker& check) {
    check.require(measure.quantity() != v1::Measure::QUANTITY_UNSPECIFIED &&
                      v1::Measure::Quantity_IsValid(measure.quantity()),
                  "measure.quantity",
                  "must be HORIZONTAL, VERTICAL, NORMAL, CYLINDRICAL, SEMICYLINDRICAL or "
                  "DAYLIGHT_FACTOR");
    check.require(measure.has_area() == measure.points().empty(), "measure.area",
                  "needs either an area or points");
    const auto count = static_cast<std::uint64_t>(measure.points_size());
    check.require(count <= kMaxMeasuredPoints, "measure.points", "must be at most 4096");
    if (measure.has_area()) {
        check_area(measure, check);
    }
    for (const v1::Measure::Point& point : measure.points()) {
        check.require(point.has_position(), "measure.points.position", "is missing");
    }
    check_directions(measure, check);
    const auto share = [&](bool given, float value, const char* field) {
        check.require(!given || (value > 0.0F && value <= 1.0F), field,
                      "must be above 0 and at most 1");
    };
    share(measure.has_relative_error(), measure.relative_error(), "measure.relativeError");
    share(measure.has_maintenance_factor(), measure.maintenance_factor(),
          "measure.maintenanceFactor");
}

}  // namespace raybundle
