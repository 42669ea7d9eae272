// SPDX-License-Identifier: Apache-2.0
// usage: raybundle_change_figure DIR [CASE ...]
// Draws how far the served light is from the truth after changes, and how far that of new solves
// is: one plot a case, DIR/CASE.svg, and all figures in DIR/changes.json. What the picture states
// is the band: its 95 % interval. Some minutes.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "changed_scene.h"
#include "gpu/egl_context.h"
#include "research/plot/line_plot.h"

namespace raybundle {
namespace {

constexpr int seeds = 3;
constexpr std::uint64_t iterations_before = 800;
const std::vector<std::uint64_t> after = {8, 16, 24, 48, 96, 192, 384, 768};

/// Root mean square over seeds of the relative error at each of the times.
std::vector<double> errors(const std::vector<std::vector<Served>>& runs,
                           const std::vector<double>& truth, double scale) {
    std::vector<double> result;
    for (std::size_t k = 0; k < after.size(); ++k) {
        double sum = 0.0;
        for (const std::vector<Served>& run : runs) {
            const double error = error_of(run[k], truth, scale);
            sum += error * error / static_cast<double>(runs.size());
        }
        result.push_back(std::sqrt(sum));
    }
    return result;
}

/// Mean of the points of the last pictures.
std::vector<double> last_light(const std::vector<std::vector<Served>>& runs) {
    std::vector<double> truth(runs.front().back().points.size(), 0.0);
    for (const std::vector<Served>& run : runs) {
        for (std::size_t i = 0; i < truth.size(); ++i) {
            truth[i] += run.back().points[i] / static_cast<double>(runs.size());
        }
    }
    return truth;
}

PlotSeries series_of(const std::string& name, std::size_t style,
                     const std::vector<double>& values) {
    PlotSeries series;
    series.name = name;
    series.style = style;
    for (std::size_t k = 0; k < after.size(); ++k) {
        series.points.push_back({.x = static_cast<double>(after[k]), .y = values[k], .band = {}});
    }
    return series;
}

nlohmann::json measure(const ChangeCase& c, const std::filesystem::path& folder) {
    std::vector<std::vector<Served>> fresh;
    std::vector<std::vector<Served>> changed;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        fresh.push_back(solve_anew(c, 100 + seed, after));
        changed.push_back(change_and_solve(c, seed, iterations_before, after));
    }
    const std::vector<double> truth = last_light(fresh);
    const double scale = 1e-3 * c.bright;
    const std::vector<double> of_fresh = errors(fresh, truth, scale);
    const std::vector<double> of_changed = errors(changed, truth, scale);
    LinePlot plot;
    plot.title = c.name + ": error of 25 points after a change";
    plot.description =
        "Relative error of the served illuminance against iterations since a change, "
        "beside that of solves started at the change.";
    plot.x = {.title = "iterations since the change", .unit = "", .scale = AxisScale::logarithmic};
    plot.y = {.title = "relative error of 25 points", .unit = "", .scale = AxisScale::logarithmic};
    plot.series = {series_of("served", 0, of_changed), series_of("new solve", 1, of_fresh)};
    for (std::size_t k = 0; k < after.size(); ++k) {
        const Served& served = changed.front()[k];
        plot.series[0].points[k].band =
            std::pair(served.stated.error_low, served.stated.error_high);
    }
    std::ofstream(folder / (c.name + ".svg")) << svg_of(plot);
    std::vector<double> settled;
    for (const Served& served : changed.front()) {
        settled.push_back(served.settled);
    }
    return {{"case", c.name},
            {"iterations", after},
            {"served", of_changed},
            {"new_solve", of_fresh},
            {"settled_of_first_seed", settled}};
}

int run(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("usage: raybundle_change_figure DIR [CASE ...]\n", stderr);
        return 2;
    }
    spdlog::set_level(spdlog::level::err);
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const EglContext context = create_egl_context();
    nlohmann::json all = nlohmann::json::array();
    for (const ChangeCase& c : change_cases()) {
        const bool wanted = argc == 2 || std::find(argv + 2, argv + argc, c.name) != argv + argc;
        if (wanted) {
            std::printf("%s\n", c.name.c_str());
            std::fflush(stdout);
            all.push_back(measure(c, folder));
        }
    }
    std::ofstream(folder / "changes.json") << all.dump(1) << '\n';
    return 0;
}

}  // namespace
}  // namespace raybundle

int main(int argc, char** argv) {
    return raybundle::run(argc, argv);
}
