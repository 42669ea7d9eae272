// SPDX-License-Identifier: Apache-2.0
// `measure`: light at points in the air, without a GL context.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/progress.h"
#include "app/stopwatch.h"
#include "commands/command.h"
#include "measure/daylight_scene.h"
#include "measure/requirement.h"
#include "measure/work_plane.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;

constexpr double usual_error = 0.05;
constexpr double usual_seconds = 60.0;

/// What the options ask for.
struct Task {
    MeasurementSettings settings;
    std::vector<CalculationPoint> points;
    GridSize grid;         ///< 0 x 0: single points
    double spacing = 0.0;  ///< m, largest that EN 12464-1 allows, where that chose the grid
    std::optional<Requirement> requirement;
};

double parse_number(const std::string& option, const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    if (last != end || error != std::errc() || !(value >= 0.0 && value <= 1e9)) {
        throw UsageError(option + ": '" + text + "' is not a number of 0 to 1e9");
    }
    return value;
}

Requirement parse_requirement(const std::string& text) {
    const std::size_t slash = text.find('/');
    Requirement requirement;
    requirement.mean = parse_number("--require", text.substr(0, slash));
    if (slash != std::string::npos) {
        requirement.uniformity = parse_number("--require", text.substr(slash + 1));
        if (*requirement.uniformity > 1.0) {
            throw UsageError("--require: a uniformity is at most 1");
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
                        quantity == Quantity::semicylindrical;
    if (options.direction.empty() && wanted) {
        throw UsageError(std::string("--direction: ") + name_of(quantity) + " needs one");
    }
    if (!wanted) {
        return glm::dvec3(0.0, 1.0, 0.0);
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

void place_points(const MeasureOptions& options, Task& task) {
    const glm::dvec3 direction = direction_of(options, task.settings.quantity);
    if (options.plane.empty() == options.points.empty()) {
        throw UsageError("measure: needs either --plane or --point");
    }
    for (const std::string& point : options.points) {
        task.points.push_back({parse_vector("--point", point), direction});
    }
    if (!options.plane.empty()) {
        const MeasuredArea area = area_of(options);
        if (options.grid == "EN12464") {
            task.grid = en12464_grid(area);
            task.spacing = en12464_spacing(glm::length(area.u), glm::length(area.v));
        } else {
            const std::size_t cross = std::min(options.grid.find('x'), options.grid.size());
            const auto part = [&](const std::string& text) {
                return static_cast<std::uint32_t>(parse_number("--grid", text));
            };
            task.grid = {part(options.grid.substr(0, cross)),
                         part(options.grid.substr(std::min(cross + 1, options.grid.size())))};
        }
        if (task.grid.points() >= 1 && task.grid.points() <= PointMeasurement::most_points) {
            for (const glm::dvec3& position : points_of(area, task.grid)) {
                task.points.push_back({position, direction});
            }
        }
    }
    if (task.points.empty() || task.points.size() > PointMeasurement::most_points) {
        throw UsageError(fmt::format("measure: the grid has {} x {} points, not 1 to {}",
                                     task.grid.columns, task.grid.rows,
                                     PointMeasurement::most_points));
    }
}

Task task_of(const Options& options) {
    Task task;
    const auto quantity = quantity_named(options.measure.quantity);
    if (!quantity) {
        throw UsageError("--quantity: '" + options.measure.quantity +
                         "' is none of HORIZONTAL, VERTICAL, NORMAL, CYLINDRICAL, "
                         "SEMICYLINDRICAL, DAYLIGHT_FACTOR");
    }
    task.settings.quantity = *quantity;
    task.settings.direct = options.measure.direct;
    task.settings.seed = options.scene.seed;
    task.settings.factor = options.measure.maintenance.value_or(1.0);
    if (*quantity == Quantity::daylight_factor) {
        task.settings.factor *= 100.0 / overcast_illuminance;
    }
    if (!options.measure.require.empty()) {
        task.requirement = parse_requirement(options.measure.require);
    }
    place_points(options.measure, task);
    return task;
}

bool decided(const Task& task, const PointMeasurement& points) {
    return !task.requirement || judge(*task.requirement, points.summary()) != Verdict::unknown;
}

/// Goes on until the error is met and what is required is known, or time is over. Returns seconds.
double gather(const Options& options, const Task& task, PointMeasurement& points) {
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
        if (!timed && error <= wanted && decided(task, points)) {
            break;
        }
        if (bar.due()) {
            bar.show(std::min(seconds / most_seconds, 1.0), most_seconds - seconds,
                     fmt::format("intervals up to {:.1f} % wide", 100.0 * error));
        }
    } while (seconds < most_seconds || points.rounds() < PointMeasurement::least_rounds);
    return seconds;
}

Json json_of(const Interval& interval) {
    return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

Json json_of(const glm::dvec3& v) {
    return {{"x", v.x}, {"y", v.y}, {"z", v.z}};
}

void print_json(const Task& task, const PointMeasurement& points, double seconds) {
    const MeasurementSummary all = points.summary();
    Json json = {{"quantity", name_of(task.settings.quantity)},
                 {"unit", unit_of(task.settings.quantity)},
                 {"direct", task.settings.direct},
                 {"columns", task.grid.columns},
                 {"rows", task.grid.rows},
                 {"points", Json::array()}};
    const std::vector<Interval> values = points.values();
    for (std::size_t i = 0; i < points.points().size(); ++i) {
        Json point = {{"position", json_of(points.points()[i].position)}};
        if (points.inside(i)) {
            point["inside"] = true;
        } else {
            point.update(json_of(values[i]));
        }
        json["points"].push_back(point);
    }
    json["mean"] = json_of(all.mean);
    json["minimum"] = json_of(all.minimum);
    json["maximum"] = json_of(all.maximum);
    json["uniformity"] = json_of(all.uniformity);
    json["diversity"] = json_of(all.diversity);
    json["inside"] = points.points().size() - points.measured();
    json["relativeError"] = points.relative_error();
    json["paths"] = points.rounds() * PointMeasurement::batches;  // of each point
    json["seconds"] = seconds;
    if (task.requirement) {
        json["requirement"] = {{"mean", task.requirement->mean},
                               {"verdict", name_of(judge(*task.requirement, all))}};
        if (task.requirement->uniformity) {
            json["requirement"]["uniformity"] = *task.requirement->uniformity;
        }
    }
    fmt::print("{}\n", json.dump(2));
}

void print_values(const Task& task, const PointMeasurement& points) {
    const std::size_t columns = std::max<std::size_t>(task.grid.columns, 1);
    const std::vector<Interval> values = points.values();
    for (std::size_t i = 0; i < points.points().size(); ++i) {
        const glm::dvec3& p = points.points()[i].position;
        if (i % columns == 0) {
            fmt::print("{:9.3f} {:9.3f} {:9.3f} ", p.x, p.y, p.z);
        }
        const Interval& value = values[i];
        fmt::print("{:>14}", points.inside(i) ? "in a solid"
                                              : fmt::format("{:.4g} ±{:.2g}", value.value,
                                                            value.high - value.value));
        if (i % columns == columns - 1) {
            fmt::print("\n");
        }
    }
}

void print_text(const Task& task, const PointMeasurement& points, double seconds) {
    const MeasurementSummary all = points.summary();
    const char* const unit = unit_of(task.settings.quantity);
    fmt::print("{}{}, {}, 95 % intervals; each line begins with its first point's x, y, z in m\n",
               name_of(task.settings.quantity), task.settings.direct ? ", direct light" : "", unit);
    if (task.spacing > 0.0) {
        fmt::print("grid of EN 12464-1: {} x {} points, spacing of {:.3f} m at most\n",
                   task.grid.columns, task.grid.rows, task.spacing);
    }
    print_values(task, points);
    const auto line = [](const char* name, const Interval& found, const char* of) {
        fmt::print("{:<10} {:.4g} {} ({:.4g} to {:.4g})\n", name, found.value, of, found.low,
                   found.high);
    };
    line("mean", all.mean, unit);
    line("minimum", all.minimum, unit);
    line("maximum", all.maximum, unit);
    line("Uo", all.uniformity, "");
    line("Ud", all.diversity, "");
    if (const std::size_t inside = points.points().size() - points.measured(); inside > 0) {
        fmt::print("{} points lie in solids and are left out\n", inside);
    }
    fmt::print("{} paths for each point in {:.2f} s\n", points.rounds() * PointMeasurement::batches,
               seconds);
    if (task.requirement) {
        fmt::print("required {}: {}\n",
                   task.requirement->uniformity
                       ? fmt::format("{:g} {} and Uo {:g}", task.requirement->mean, unit,
                                     *task.requirement->uniformity)
                       : fmt::format("{:g} {}", task.requirement->mean, unit),
                   name_of(judge(*task.requirement, all)));
    }
}

}  // namespace

int run_measure(const Options& options) {
    const Task task = task_of(options);
    LoadedScene loaded = load_scene(options);
    if (task.settings.quantity == Quantity::daylight_factor) {
        leave_overcast_sky(loaded.scene, loaded.mesh);
    }
    PointMeasurement points(std::make_shared<const MeasuredScene>(loaded.scene, loaded.mesh),
                            task.points, task.settings);
    if (points.measured() == 0) {
        spdlog::error("all points lie in solids");
        return exit_failed;
    }
    const double seconds = gather(options, task, points);
    (options.measure.json_to_stdout ? print_json : print_text)(task, points, seconds);
    if (!task.requirement) {
        return exit_done;
    }
    switch (judge(*task.requirement, points.summary())) {
        case Verdict::met:
            return exit_done;
        case Verdict::missed:
            return exit_requirement_missed;
        default:
            return exit_requirement_unknown;
    }
}

}  // namespace raybundle
