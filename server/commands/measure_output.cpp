// SPDX-License-Identifier: Apache-2.0
// What `measure` prints.
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/measure_task.h"
#include "scene/significant.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;
using State = GlareRating::State;

Json json_of(const Interval& interval) {
    return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

Json json_of(const glm::dvec3& v) {
    return {{"x", v.x}, {"y", v.y}, {"z", v.z}};
}

const char* name_of(State state) {
    return state == State::rated ? "RATED" : state == State::no_source ? "NO_SOURCE" : "OUTSIDE";
}

Json json_of(const GlareRating& rating) {
    Json json = {{"state", name_of(rating.state)},  {"direction", json_of(rating.view)},
                 {"background", rating.background}, {"counted", rating.sources},
                 {"below", rating.below},           {"beyond", rating.beyond},
                 {"small", rating.small},           {"large", rating.large},
                 {"words", rating.words},           {"sources", Json::array()}};
    for (const GlareShare& share : rating.shares) {
        json["sources"].push_back({{"name", share.name},
                                   {"light", share.light},
                                   {"position", json_of(share.position)},
                                   {"share", share.share},
                                   {"luminance", share.luminance},
                                   {"solidAngle", share.solid_angle},
                                   {"positionIndex", share.position_index}});
    }
    if (!rating.ratios.empty()) {
        json["luminances"] = rating.ratios;
    }
    return json;
}

void add_points(const Measurement& points, Json& json) {
    const std::vector<Interval> values = points.values();
    const std::vector<GlareRating> ratings = points.glare();
    for (std::size_t i = 0; i < points.points().size(); ++i) {
        Json point = {{"position", json_of(points.points()[i].position)}};
        if (points.inside(i)) {
            point["inside"] = true;
        } else if (ratings.empty() || ratings[i].state == State::rated) {
            point.update(json_of(values[i]));
        }
        if (!ratings.empty() && !points.inside(i)) {
            point["glare"] = json_of(ratings[i]);
        }
        json["points"].push_back(point);
    }
}

void add_requirement(const MeasureTask& task, const Measurement& points, Json& json) {
    const std::vector<Check> checks = task.checks(points);
    json["requirement"] = {{"verdict", name_of(verdict_of(checks))}, {"checks", Json::array()}};
    const auto set = [&](const char* name, const std::optional<double>& value) {
        if (value) {
            json["requirement"][name] = *value;
        }
    };
    set("mean", task.requirement->mean);
    set("uniformity", task.requirement->uniformity);
    set("most", task.requirement->most);
    set("colourRendering", task.requirement->colour_rendering);
    for (const Check& one : checks) {
        json["requirement"]["checks"].push_back({{"what", one.what},
                                                 {"required", one.required},
                                                 {"atMost", one.at_most},
                                                 {"verdict", name_of(one.verdict)}});
        if (!one.words.empty()) {
            json["requirement"]["checks"].back()["words"] = one.words;
        }
    }
}

void add_luminaires(const MeasureTask& task, Json& json) {
    json["luminaires"] = Json::array();
    for (const ZoneLuminaire& luminaire : task.luminaires) {
        Json one = {
            {"light", luminaire.light}, {"name", luminaire.name}, {"share", luminaire.share}};
        if (luminaire.colour_rendering) {
            one["colourRendering"] = luminaire.colour_rendering->least;
            if (luminaire.colour_rendering->most > luminaire.colour_rendering->least) {
                one["colourRenderingMost"] = luminaire.colour_rendering->most;
            }
        }
        json["luminaires"].push_back(std::move(one));
    }
}

std::string text_of(const Measurement& points, std::size_t i, const Interval& value,
                    const std::vector<GlareRating>& ratings) {
    if (points.inside(i)) {
        return "in a solid";
    }
    if (!ratings.empty() && ratings[i].state != State::rated) {
        return ratings[i].state == State::no_source ? "no source" : "outside";
    }
    // Direct light of lights without extent is exact: what is left is the rounding of the mean.
    const double error = value.high - value.value;
    const bool exact = error <= 1e-12 * std::abs(value.value);
    return significant(value.value, 4) + " ±" + significant(exact ? 0.0 : error, 2);
}

void print_values(const MeasureTask& task, const Measurement& points) {
    const std::size_t columns = std::max<std::size_t>(task.grid.columns, 1);
    const std::vector<Interval> values = points.values();
    const std::vector<GlareRating> ratings = points.glare();
    for (std::size_t i = 0; i < points.points().size(); ++i) {
        const glm::dvec3& p = points.points()[i].position;
        if (i % columns == 0) {
            fmt::print("{:9.3f} {:9.3f} {:9.3f} ", p.x, p.y, p.z);
        }
        fmt::print(" {:>13}", text_of(points, i, values[i], ratings));
        if (i % columns == columns - 1) {
            fmt::print("\n");
        }
    }
}

/// Of the place that is worst.
void print_glare(const Measurement& points) {
    const std::vector<GlareRating> ratings = points.glare();
    const GlareRating* worst = nullptr;
    for (std::size_t i = 0; i < ratings.size(); ++i) {
        const bool counts = !points.inside(i) && ratings[i].state != State::no_source;
        if (counts && (worst == nullptr || ratings[i].value.value > worst->value.value)) {
            worst = &ratings[i];
        }
    }
    if (worst == nullptr) {
        fmt::print("nothing glares at any place\n");
        return;
    }
    fmt::print("worst view {:.2f}, {:.2f}, {:.2f}{}{}\n", worst->view.x, worst->view.y,
               worst->view.z, worst->words.empty() ? "" : ": ", worst->words);
    for (const GlareShare& share : worst->shares) {
        fmt::print("{:5.1f} %  {} cd/m², {:.3g} sr, p = {:.3g}  {}\n", 100.0 * share.share,
                   significant(share.luminance, 4), share.solid_angle, share.position_index,
                   share.name);
    }
    if (worst->ratios.size() == 3) {
        fmt::print("mean luminance within 10°, 10° to 30°, 30° to 60°: {}, {}, {} cd/m²\n",
                   significant(worst->ratios[0], 4), significant(worst->ratios[1], 4),
                   significant(worst->ratios[2], 4));
    }
}

void print_summary(const MeasureTask& task, const MeasurementSummary& all) {
    const char* const unit = unit_of(task.settings.quantity);
    const auto line = [](const char* name, const Interval& found, const char* of) {
        fmt::print("{:<10} {} {} ({} to {})\n", name, significant(found.value, 4), of,
                   significant(found.low, 4), significant(found.high, 4));
    };
    line("mean", all.mean, unit);
    line("minimum", all.minimum, unit);
    line("maximum", all.maximum, unit);
    if (!is_glare(task.settings.quantity)) {
        line("Uo", all.uniformity, "");
        line("Ud", all.diversity, "");
    }
}

}  // namespace

void print_json(const MeasureTask& task, const Measurement& points, double seconds) {
    Json json = {{"quantity", name_of(task.settings.quantity)},
                 {"unit", unit_of(task.settings.quantity)},
                 {"direct", task.settings.direct},
                 {"columns", task.grid.columns},
                 {"rows", task.grid.rows},
                 {"points", Json::array()}};
    add_points(points, json);
    if (const auto all = points.all()) {
        json["mean"] = json_of(all->mean);
        json["minimum"] = json_of(all->minimum);
        json["maximum"] = json_of(all->maximum);
        if (!is_glare(task.settings.quantity)) {
            json["uniformity"] = json_of(all->uniformity);
            json["diversity"] = json_of(all->diversity);
        }
    }
    json["inside"] = points.points().size() - points.measured();
    json["relativeError"] = points.relative_error();
    json["paths"] = points.rounds() * PointMeasurement::batches;  // of each point
    json["seconds"] = seconds;
    if (has_luminaires(task.settings.quantity)) {
        add_luminaires(task, json);
    }
    if (task.requirement) {
        add_requirement(task, points, json);
    }
    fmt::print("{}\n", json.dump(2));
}

void print_text(const MeasureTask& task, const Measurement& points, double seconds) {
    const char* const unit = unit_of(task.settings.quantity);
    fmt::print("{}{}{}{}, 95 % intervals; each line begins with its first point's x, y, z in m\n",
               name_of(task.settings.quantity), task.settings.direct ? ", direct light" : "",
               *unit == '\0' ? "" : ", ", unit);
    if (task.spacing > 0.0) {
        fmt::print("grid of EN 12464-1: {} x {} points, spacing of {:.3f} m at most\n",
                   task.spacing_grid.columns, task.spacing_grid.rows, task.spacing);
    }
    print_values(task, points);
    if (const auto all = points.all()) {
        print_summary(task, *all);
    }
    if (is_glare(task.settings.quantity)) {
        print_glare(points);
    }
    if (const std::size_t inside = points.points().size() - points.measured(); inside > 0) {
        fmt::print("{} points lie in solids and are left out\n", inside);
    }
    fmt::print("{} paths for each point in {:.2f} s\n", points.rounds() * PointMeasurement::batches,
               seconds);
    if (task.requirement) {
        std::string words;
        const std::vector<Check> checks = task.checks(points);
        for (const Check& one : checks) {
            words += fmt::format("{}{} {}{:g}", words.empty() ? "" : " and ", one.what,
                                 one.at_most ? "at most " : "", one.required);
        }
        fmt::print("required {}: {}\n", words, name_of(verdict_of(checks)));
        for (const Check& one : checks) {
            if (!one.words.empty()) {
                fmt::print("{} {}: {}\n", one.what, name_of(one.verdict), one.words);
            }
        }
    }
}

}  // namespace raybundle
