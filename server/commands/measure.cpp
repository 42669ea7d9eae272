// SPDX-License-Identifier: Apache-2.0
// `measure`: light at points in the air, without a GL context.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "app/progress.h"
#include "app/stopwatch.h"
#include "commands/command.h"
#include "commands/measure_task.h"
#include "measure/daylight_scene.h"
#include "measure/glare/ugr_measurement.h"
#include "measure/make_measurement.h"
#include "measure/requirement.h"
#include "measure/work_plane.h"

namespace raybundle {
namespace {

constexpr double usual_error = 0.05;
constexpr double usual_seconds = 60.0;

double parse_number(const std::string& option, const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    if (last != end || error != std::errc() || !(value >= 0.0 && value <= 1e9)) {
        throw UsageError(option + ": '" + text + "' is not a number of 0 to 1e9");
    }
    return value;
}

Requirement parse_requirement(const std::string& text, Quantity quantity) {
    const std::size_t slash = text.find('/');
    Requirement requirement;
    if (is_glare(quantity)) {
        requirement.most = parse_number("--require", text);
        return requirement;
    }
    requirement.mean = parse_number("--require", text.substr(0, slash));
    if (slash == std::string::npos) {
        return requirement;
    }
    const std::string rest = text.substr(slash + 1);
    const std::size_t second = rest.find('/');
    requirement.uniformity = parse_number("--require", rest.substr(0, second));
    if (*requirement.uniformity > 1.0) {
        throw UsageError("--require: a uniformity is at most 1");
    }
    if (second != std::string::npos) {
        if (!has_luminaires(quantity)) {
            throw UsageError("--require: only HORIZONTAL and NORMAL take Ra");
        }
        requirement.colour_rendering = parse_number("--require", rest.substr(second + 1));
        if (*requirement.colour_rendering > 100.0) {
            throw UsageError("--require: Ra is at most 100");
        }
    }
    return requirement;
}

MeasuredArea area_of(const MeasureOptions& options) {
    MeasuredArea area{parse_vector("--plane", options.plane[0]),
                      parse_vector("--plane", options.plane[1]),
                      parse_vector("--plane", options.plane[2])};
    const double length = glm::length(area.u);
    const double width = glm::length(area.v);
    if (!(glm::length(glm::cross(area.u, area.v)) > 1e-6 * length * width)) {
        throw UsageError("--plane: its edges are 0, or lie along each other");
    }
    if (!(2.0 * options.margin < std::min(length, width))) {
        throw UsageError("--margin: leaves nothing of the plane");
    }
    const glm::dvec3 u = area.u / length;
    const glm::dvec3 v = area.v / width;
    area.origin += options.margin * (u + v);
    area.u -= 2.0 * options.margin * u;
    area.v -= 2.0 * options.margin * v;
    return area;
}

glm::dvec3 direction_of(const MeasureOptions& options, Quantity quantity) {
    const bool wanted = quantity == Quantity::vertical || quantity == Quantity::normal ||
                        quantity == Quantity::semicylindrical ||
                        (is_glare(quantity) && options.directions == 0);
    if (options.direction.empty() && wanted) {
        throw UsageError(std::string("--direction: ") + name_of(quantity) + " needs one");
    }
    if (!wanted && options.direction.empty()) {
        return is_glare(quantity) ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0);
    }
    const glm::dvec3 direction = parse_vector("--direction", options.direction);
    const double across = quantity == Quantity::normal
                              ? glm::length(direction)
                              : glm::length(glm::dvec2(direction.x, direction.z));
    if (!(across > 1e-6)) {
        throw UsageError(std::string("--direction: says nothing for ") + name_of(quantity));
    }
    return direction;
}

GridSize grid_of(const std::string& text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const auto part = [](const std::string& digits) {
        return static_cast<std::uint32_t>(parse_number("--grid", digits));
    };
    const GridSize grid = {part(text.substr(0, cross)),
                           part(text.substr(std::min(cross + 1, text.size())))};
    if (grid.points() < 1) {
        throw UsageError("--grid: has no points");
    }
    return grid;
}

std::vector<glm::dvec3> place_on_plane(const MeasureOptions& options, std::size_t most,
                                       MeasureTask& task) {
    const MeasuredArea area = area_of(options);
    if (options.grid == "EN12464") {
        task.grid = en12464_grid(area);
        task.spacing = en12464_spacing(glm::length(area.u), glm::length(area.v));
    } else {
        task.grid = grid_of(options.grid);
    }
    task.spacing_grid = task.grid;
    if (task.grid.points() > most) {
        throw UsageError(fmt::format("measure: the grid has {} x {} points, not 1 to {}",
                                     task.grid.columns, task.grid.rows, most));
    }
    return points_of(area, task.grid);
}

std::vector<glm::dvec3> place_in_outline(const MeasureOptions& options, std::size_t most,
                                         MeasureTask& task) {
    ZoneShape shape;
    for (const std::string& corner : options.outline) {
        shape.outline.push_back(parse_vector("--outline", corner));
    }
    if (!options.plane.empty()) {
        shape.outline = outline_of(area_of(options));
    }
    shape.margin = options.margin;
    shape.surrounding = options.surrounding;
    if (const std::string problem = outline_problem(shape.outline); !problem.empty()) {
        throw UsageError("--outline: " + problem);
    }
    const bool standard = options.grid == "EN12464";
    ZoneGrid zone = lay_grid(shape, standard ? GridSize() : grid_of(options.grid), most);
    if (zone.points.empty()) {
        throw UsageError(
            fmt::format("measure: of the grid's {} x {} points none, or more than {}, "
                        "belong to the outline",
                        zone.grid.columns, zone.grid.rows, most));
    }
    task.spacing = zone.spacing;
    task.spacing_grid = zone.grid;
    return std::move(zone.points);
}

void place_points(const MeasureOptions& options, MeasureTask& task) {
    const std::size_t most = most_points(task.settings.quantity);
    const glm::dvec3 direction = direction_of(options, task.settings.quantity);
    if (options.directions > 0 && is_glare(task.settings.quantity)) {
        task.settings.views = views_all_round(options.directions, direction);
    }
    const int ways = (options.plane.empty() ? 0 : 1) + (options.points.empty() ? 0 : 1) +
                     (options.outline.empty() ? 0 : 1);
    if (ways != 1) {
        throw UsageError("measure: needs either --plane, --outline or --point");
    }
    std::vector<glm::dvec3> places;
    for (const std::string& point : options.points) {
        places.push_back(parse_vector("--point", point));
    }
    if (options.points.empty()) {
        const bool polygon = !options.outline.empty() || options.surrounding > 0.0;
        places = (polygon ? place_in_outline : place_on_plane)(options, most, task);
    }
    if (places.size() > most) {
        throw UsageError(fmt::format("measure: has {} points, not 1 to {}", places.size(), most));
    }
    for (const glm::dvec3& place : places) {
        task.points.push_back({place, direction});
    }
}

MeasureTask task_of(const Options& options) {
    MeasureTask task;
    const auto quantity = quantity_named(options.measure.quantity);
    if (!quantity) {
        throw UsageError("--quantity: '" + options.measure.quantity +
                         "' is none of HORIZONTAL, VERTICAL, NORMAL, CYLINDRICAL, "
                         "SEMICYLINDRICAL, DAYLIGHT_FACTOR, UGR, DGP");
    }
    task.settings.quantity = *quantity;
    task.settings.direct = options.measure.direct;
    task.settings.small_sources = options.measure.small_sources;
    task.settings.seed = options.scene.seed;
    task.settings.factor = options.measure.maintenance.value_or(1.0);
    task.maintained = options.measure.maintained;
    if (*quantity == Quantity::daylight_factor) {
        task.settings.factor *= 100.0 / overcast_illuminance;
    }
    if (!options.measure.require.empty()) {
        task.requirement = parse_requirement(options.measure.require, *quantity);
    }
    place_points(options.measure, task);
    return task;
}

/// Whether more samples would not decide anything.
bool decided(const MeasureTask& task, const Measurement& points) {
    const std::vector<Check> checks = task.checks(points);
    return verdict_of(checks) == Verdict::missed ||
           std::none_of(checks.begin(), checks.end(), [](const Check& one) {
               return one.by_measurement && one.verdict == Verdict::unknown;
           });
}

/// Goes on until the error is met and what is required is known, or time is over. Returns seconds.
double gather(const Options& options, const MeasureTask& task, Measurement& points) {
    constexpr std::uint64_t looks = 8;  // at the error, each time there are an eighth more samples
    const double wanted = options.stop.error.value_or(usual_error);
    const double most_seconds = options.stop.seconds.value_or(usual_seconds);
    const bool timed = options.stop.seconds && !options.stop.error;
    Progress bar;
    bar.begin("measuring", {});
    const Stopwatch stopwatch;
    double seconds = 0.0;
    std::uint64_t next = PointMeasurement::least_rounds;
    do {
        points.add_round();
        seconds = stopwatch.seconds();
        if (points.rounds() < next) {
            continue;
        }
        next += std::max<std::uint64_t>(points.rounds() / looks, 1);
        const double error = points.relative_error();
        // An error of 0 stays: more samples decide nothing, as of glare in air.
        if (!timed && error <= wanted && (error == 0.0 || decided(task, points))) {
            break;
        }
        if (bar.due()) {
            bar.show(std::min(seconds / most_seconds, 1.0), most_seconds - seconds,
                     fmt::format("intervals up to {:.1f} % wide", 100.0 * error));
        }
    } while (seconds < most_seconds || points.rounds() < PointMeasurement::least_rounds);
    return seconds;
}

}  // namespace

int run_measure(const Options& options) {
    MeasureTask task = task_of(options);
    LoadedScene loaded = load_scene(options);
    if (task.settings.quantity == Quantity::daylight_factor) {
        leave_overcast_sky(loaded.scene, loaded.mesh);
    }
    if (task.maintained) {
        maintain_lamps(loaded.scene, loaded.mesh);
    }
    const auto scene = std::make_shared<const MeasuredScene>(loaded.scene, loaded.mesh);
    const std::unique_ptr<Measurement> points = make_measurement(scene, task.points, task.settings);
    if (has_luminaires(task.settings.quantity)) {
        task.luminaires =
            find_zone_luminaires(*scene, task.points, task.settings.quantity, task.settings.direct);
    }
    if (points->measured() == 0) {
        spdlog::error("all points lie in solids");
        return exit_failed;
    }
    const double seconds = gather(options, task, *points);
    (options.measure.json_to_stdout ? print_json : print_text)(task, *points, seconds);
    if (!task.requirement) {
        return exit_done;
    }
    switch (verdict_of(task.checks(*points))) {
        case Verdict::met:
            return exit_done;
        case Verdict::missed:
            return exit_requirement_missed;
        default:
            return exit_requirement_unknown;
    }
}

}  // namespace raybundle
