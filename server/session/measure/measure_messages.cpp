// SPDX-License-Identifier: Apache-2.0
#include "session/measure/measure_messages.h"

#include <cmath>

#include "measure/daylight_scene.h"
#include "measure/glare/ugr_measurement.h"
#include "measure/zone_area.h"
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
    request.outline = outline_of(area);
    request.grid = {measure.columns(), measure.rows()};
    if (measure.grid() == v1::Measure::EN12464) {
        request.grid = en12464_grid(area);
        request.spacing = en12464_spacing(glm::length(area.u), glm::length(area.v));
    }
    if (request.grid.points() > most_points(request.task.settings.quantity)) {
        return;
    }
    request.lattice = area;
    request.lattice_size = request.grid;
    const glm::dvec3 direction =
        measure.has_direction() ? vector(measure.direction()) : normal_of(area);
    for (const glm::dvec3& position : points_of(area, request.grid)) {
        request.cells.push_back(static_cast<std::uint32_t>(request.cells.size()));
        request.task.points.push_back({position, direction});
    }
}

/// A polygon, or the strip around an area.
void place_in_outline(const v1::Measure& measure, MeasureRequest& request) {
    ZoneShape shape;
    shape.margin = static_cast<double>(measure.margin());
    shape.surrounding = static_cast<double>(measure.surrounding());
    for (const v1::Vec3& corner : measure.outline()) {
        shape.outline.push_back(vector(corner));
    }
    if (measure.has_area()) {
        const v1::Measure::Area& area = measure.area();
        shape.outline = outline_of({vector(area.origin()), vector(area.u()), vector(area.v())});
    }
    request.outline = shape.outline;
    request.problem = outline_problem(shape.outline);
    if (!request.problem.empty()) {
        return;
    }
    ZoneGrid zone = lay_grid(shape, {measure.columns(), measure.rows()},
                             most_points(request.task.settings.quantity));
    request.spacing = zone.spacing;
    request.lattice = zone.area;
    request.lattice_size = zone.grid;
    request.cells = std::move(zone.cells);
    const glm::dvec3 direction =
        measure.has_direction() ? vector(measure.direction()) : glm::dvec3(0.0, 1.0, 0.0);
    for (const glm::dvec3& position : zone.points) {
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

void set_ratios(const MeasurementSummary& all, v1::Measured* message) {
    using M = v1::Measured;
    set_interval(all.uniformity, message, &M::set_uniformity, &M::set_uniformity_low,
                 &M::set_uniformity_high);
    set_interval(all.diversity, message, &M::set_diversity, &M::set_diversity_low,
                 &M::set_diversity_high);
}

v1::Verdict verdict_message(Verdict verdict) {
    return verdict == Verdict::met      ? v1::MET
           : verdict == Verdict::missed ? v1::MISSED
                                        : v1::NOT_YET_KNOWN;
}

v1::Glare::State state_message(GlareRating::State state) {
    switch (state) {
        case GlareRating::State::rated:
            return v1::Glare::RATED;
        case GlareRating::State::no_source:
            return v1::Glare::NO_SOURCE;
        default:
            return v1::Glare::OUTSIDE;
    }
}

void describe_glare(const GlareRating& rating, v1::Glare* message) {
    message->set_state(state_message(rating.state));
    to_message(glm::vec3(rating.view), message->mutable_direction());
    message->set_background(static_cast<float>(rating.background));
    message->set_counted(rating.sources);
    message->set_below(rating.below);
    message->set_beyond(rating.beyond);
    message->set_small(rating.small);
    message->set_large(rating.large);
    message->set_words(rating.words);
    for (const GlareShare& share : rating.shares) {
        v1::Glare::Source& source = *message->add_sources();
        source.set_name(share.name);
        source.set_light(share.light);
        to_message(glm::vec3(share.position), source.mutable_position());
        source.set_share(static_cast<float>(share.share));
        source.set_luminance(static_cast<float>(share.luminance));
        source.set_solid_angle(static_cast<float>(share.solid_angle));
        source.set_position_index(static_cast<float>(share.position_index));
    }
    for (const double luminance : rating.ratios) {
        message->add_luminances(static_cast<float>(luminance));
    }
}

}  // namespace

MeasureRequest from_message(const v1::Measure& measure) {
    MeasureRequest request;
    request.quantity = measure.quantity();
    MeasurementSettings& settings = request.task.settings;
    settings.quantity = *quantity_named(v1::Measure::Quantity_Name(measure.quantity()));
    settings.direct = measure.direct();
    request.task.maintained = measure.maintained() && !measure.has_maintenance_factor();
    if (measure.has_maintenance_factor()) {
        request.factor = static_cast<double>(measure.maintenance_factor());
    } else if (measure.maintained() && settings.quantity == Quantity::daylight_factor) {
        request.factor = usual_maintenance;  // of panes: no lamp shines
    }
    settings.small_sources = measure.small_sources();
    if (measure.directions() > 0) {
        settings.views = views_all_round(measure.directions(), measure.has_direction()
                                                                   ? vector(measure.direction())
                                                                   : glm::dvec3(0.0, 0.0, -1.0));
    }
    request.task.luminaires = !measure.name().empty() && has_luminaires(settings.quantity);
    settings.factor = request.factor;
    if (settings.quantity == Quantity::daylight_factor) {
        settings.factor *= 100.0 / overcast_illuminance;
    }
    request.task.relative_error =
        measure.has_relative_error() ? static_cast<double>(measure.relative_error()) : usual_error;
    if (!measure.outline().empty() || (measure.has_area() && measure.surrounding() > 0.0F)) {
        place_in_outline(measure, request);
    } else if (measure.has_area()) {
        place_on_area(measure, request);
    }
    for (const v1::Measure::Point& point : measure.points()) {
        request.task.points.push_back(
            {vector(point.position()),
             vector(point.has_normal() ? point.normal() : measure.direction())});
    }
    return request;
}

void describe(const MeasureRequest& request, v1::Measured* message) {
    message->set_quantity(request.quantity);
    message->set_columns(request.grid.columns);
    message->set_rows(request.grid.rows);
    message->set_factor(static_cast<float>(request.factor));
    message->set_maintained(request.task.maintained || request.factor != 1.0);
    message->set_direct(request.task.settings.direct);
    if (request.spacing > 0.0) {
        message->set_spacing(static_cast<float>(request.spacing));
    }
    for (const glm::dvec3& corner : request.outline) {
        to_message(glm::vec3(corner), message->add_outline());
    }
}

void to_message(std::span<const Check> checks, v1::Measured* message) {
    for (const Check& one : checks) {
        v1::Check& check = *message->add_checks();
        check.set_what(one.what);
        check.set_required(static_cast<float>(one.required));
        check.set_at_most(one.at_most);
        check.set_verdict(verdict_message(one.verdict));
        check.set_words(one.words);
    }
    if (!checks.empty()) {
        message->set_verdict(verdict_message(verdict_of(checks)));
    }
}

void to_message(const MeasureRequest& request, const PointMeasurer::Result& result,
                v1::Measured* message) {
    describe(request, message);
    message->set_measurement(result.measurement);
    message->set_epoch(result.epoch);
    message->set_settled(1.0F);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        v1::Measured::Point& point = *message->add_points();
        to_message(glm::vec3(request.task.points[i].position), point.mutable_position());
        point.set_inside(result.inside[i]);
        if (!result.glare.empty() && !result.inside[i]) {
            describe_glare(result.glare[i], point.mutable_glare());
        }
        const bool known =
            result.glare.empty() || result.glare[i].state == GlareRating::State::rated;
        if (!result.inside[i] && known) {
            point.set_value(static_cast<float>(result.values[i].value));
            point.set_low(static_cast<float>(result.values[i].low));
            point.set_high(static_cast<float>(result.values[i].high));
        }
    }
    for (const ZoneLuminaire& found : result.luminaires) {
        v1::Measured::Luminaire& luminaire = *message->add_luminaires();
        luminaire.set_light(found.light);
        luminaire.set_name(found.name);
        luminaire.set_share(static_cast<float>(found.share));
        if (found.colour_rendering) {
            luminaire.set_colour_rendering(found.colour_rendering->least);
        }
        if (found.colour_rendering &&
            found.colour_rendering->most > found.colour_rendering->least) {
            luminaire.set_colour_rendering_most(found.colour_rendering->most);
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
    if (!is_glare(request.task.settings.quantity)) {
        set_ratios(all, message);
    }
    if (std::isfinite(result.relative_error)) {
        message->set_relative_error(static_cast<float>(result.relative_error));
    }
}

}  // namespace raybundle
