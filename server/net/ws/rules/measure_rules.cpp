// SPDX-License-Identifier: Apache-2.0
#include "net/ws/rules/measure_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace raybundle {
namespace {

constexpr std::uint64_t kMaxMeasuredPoints = 4096;
constexpr int kMaxCorners = 64;
constexpr float kMaxSurrounding = 100.0F;  ///< m

bool is_glare(const v1::Measure& measure) {
    return measure.quantity() == v1::Measure::UGR || measure.quantity() == v1::Measure::DGP;
}

/// Whether a direction says where a receiver faces: also across the vertical, if it is to stand.
bool faces(const v1::Vec3& direction, v1::Measure::Quantity quantity) {
    const glm::dvec3 v = to_vector(direction);
    return quantity == v1::Measure::NORMAL ? glm::length(v) >= kMinLength
                                           : std::hypot(v.x, v.z) >= kMinLength;
}

void check_directions(const v1::Measure& measure, MessageChecker& check) {
    const v1::Measure::Quantity quantity = measure.quantity();
    const bool wanted = quantity == v1::Measure::VERTICAL || quantity == v1::Measure::NORMAL ||
                        quantity == v1::Measure::SEMICYLINDRICAL ||
                        (is_glare(measure) && measure.directions() == 0);
    const bool first = measure.directions() != 0 && measure.has_direction();
    check.require(!first || faces(measure.direction(), quantity), "measure.direction",
                  "must not be vertical");
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
        const bool none = is_glare(measure) && !point.has_normal();
        check.require(faced, none ? "measure.direction" : "measure.points.normal",
                      "is missing, zero, or vertical");
    }
}

void check_grid(const v1::Measure& measure, MessageChecker& check) {
    const std::uint64_t points = std::uint64_t{measure.columns()} * measure.rows();
    check.require(measure.grid() == v1::Measure::EN12464
                      ? points == 0
                      : points >= 1 && points <= kMaxMeasuredPoints,
                  "measure.columns", "needs grid EN12464, or columns times rows of 1..4096");
}

void check_area(const v1::Measure& measure, MessageChecker& check) {
    const glm::dvec3 u = to_vector(measure.area().u());
    const glm::dvec3 v = to_vector(measure.area().v());
    check.require(measure.area().has_origin(), "measure.area.origin", "is missing");
    check.require(glm::length(u) >= kMinLength, "measure.area.u", "must not be zero");
    check.require(glm::length(v) >= kMinLength, "measure.area.v", "must not be zero");
    const double sine = glm::length(glm::cross(glm::normalize(u), glm::normalize(v)));
    check.require(sine >= kMinLength, "measure.area.v", "must not lie along u");
    const double margin = static_cast<double>(measure.margin());
    check.require(margin >= 0.0 && 2.0 * margin < std::min(glm::length(u), glm::length(v)),
                  "measure.margin", "must not be negative, and must leave some of the area");
    const bool level = std::abs(u.y) < kMinLength && std::abs(v.y) < kMinLength;
    check.require(measure.surrounding() == 0.0F || level, "measure.surrounding",
                  "needs a level area");
    check_grid(measure, check);
}

void check_outline(const v1::Measure& measure, MessageChecker& check) {
    check.require(measure.outline_size() >= 3 && measure.outline_size() <= kMaxCorners,
                  "measure.outline", "must have 3..64 corners");
    const float margin = measure.margin();
    check.require(margin >= 0.0F && margin <= 1e6F, "measure.margin", "must be 0..1e6");
    check_grid(measure, check);
}

/// Where it is measured.
void check_place(const v1::Measure& measure, MessageChecker& check) {
    const int ways = (measure.has_area() ? 1 : 0) + (measure.points().empty() ? 0 : 1) +
                     (measure.outline().empty() ? 0 : 1);
    check.require(ways == 1, "measure.area", "needs either an area, an outline or points");
    const auto count = static_cast<std::uint64_t>(measure.points_size());
    check.require(count <= kMaxMeasuredPoints, "measure.points", "must be at most 4096");
    if (measure.has_area()) {
        check_area(measure, check);
    }
    if (!measure.outline().empty()) {
        check_outline(measure, check);
    }
    for (const v1::Measure::Point& point : measure.points()) {
        check.require(point.has_position(), "measure.points.position", "is missing");
    }
    check.require(measure.surrounding() >= 0.0F && measure.surrounding() <= kMaxSurrounding,
                  "measure.surrounding", "must be 0..100");
    check.require(measure.surrounding() == 0.0F || measure.points().empty(), "measure.surrounding",
                  "needs an area or an outline");
}

void check_name(const v1::Measure& measure, MessageChecker& check) {
    check.require(measure.name().empty() || measure.keep(), "measure.name", "needs keep");
    check.require(characters(measure.name()) <= kMaxName, "measure.name",
                  "must be at most 64 characters");
    check.require(characters(measure.requirement()) <= kMaxName, "measure.requirement",
                  "must be at most 64 characters");
    check.require(
        measure.directions() == 0 || measure.directions() == 4 || measure.directions() == 8,
        "measure.directions", "must be 0, 4 or 8");
}

}  // namespace

void check_zone(const v1::SetZone& zone, MessageChecker& check) {
    const std::size_t length = characters(zone.name());
    check.require(!zone.has_name() || (length >= 1 && length <= kMaxName), "setZone.name",
                  "must be 1..64 characters");
    check.require(characters(zone.requirement()) <= kMaxName, "setZone.requirement",
                  "must be at most 64 characters");
}

void check_requirement(const v1::SetRequirement& set, MessageChecker& check) {
    const v1::Requirement& row = set.requirement();
    check.require(!row.name().empty() && characters(row.name()) <= kMaxName,
                  "setRequirement.requirement.name", "must be 1..64 characters");
    const auto within = [&](bool given, float value, float most, const std::string& field) {
        check.require(!given || (value >= 0.0F && value <= most),
                      "setRequirement.requirement." + field,
                      "must be 0.." + std::to_string(static_cast<int>(most)));
    };
    constexpr float kMaxIlluminance = 1e6F;
    within(row.has_mean(), row.mean(), kMaxIlluminance, "mean");
    within(row.has_uniformity(), row.uniformity(), 1.0F, "uniformity");
    within(row.has_glare(), row.glare(), 100.0F, "glare");
    within(row.has_cylindrical(), row.cylindrical(), kMaxIlluminance, "cylindrical");
    within(row.has_vertical(), row.vertical(), kMaxIlluminance, "vertical");
    within(row.has_daylight_factor(), row.daylight_factor(), 100.0F, "daylightFactor");
    within(row.has_daylight_glare(), row.daylight_glare(), 1.0F, "daylightGlare");
    within(row.has_colour_rendering(), row.colour_rendering(), 100.0F, "colourRendering");
}

void check_measure(const v1::Measure& measure, MessageChecker& check) {
    check.require(measure.quantity() != v1::Measure::QUANTITY_UNSPECIFIED &&
                      v1::Measure::Quantity_IsValid(measure.quantity()),
                  "measure.quantity",
                  "must be HORIZONTAL, VERTICAL, NORMAL, CYLINDRICAL, SEMICYLINDRICAL, "
                  "DAYLIGHT_FACTOR, UGR or DGP");
    check_place(measure, check);
    check_name(measure, check);
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
