// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "research/accuracy/accuracy_report.h"

namespace raybundle {
namespace {

constexpr double percent = 100.0;

enum class Abscissa { seconds, iterations };

PlotPoint plot_point(const CurvePoint& point, Abscissa abscissa) {
    PlotPoint result{
        abscissa == Abscissa::seconds ? point.seconds : static_cast<double>(point.iterations),
        percent * point.relative_rmse, std::nullopt, point.resolved};
    if (point.interval) {
        result.band = {percent * point.interval->first, percent * point.interval->second};
    }
    return result;
}

PlotSeries series_of(const ErrorCurve& curve, std::size_t style, Abscissa abscissa) {
    PlotSeries series{curve.name, {}, style >= 8, style};
    for (const CurvePoint& point : curve.points) {
        series.points.push_back(plot_point(point, abscissa));
    }
    return series;
}

LinePlot empty_plot(const std::string& title, Abscissa abscissa) {
    LinePlot plot;
    plot.title = title;
    plot.x.title = abscissa == Abscissa::seconds ? "solving time" : "iterations (ray bundles)";
    plot.x.unit = abscissa == Abscissa::seconds ? " s" : "";
    plot.y = {"error against the reference (relRMSE)", " %", AxisScale::logarithmic};
    return plot;
}

/// The largest noise of the references that the plot's curves were measured against.
void add_noise(LinePlot& plot, const AccuracyReport& report) {
    double noise = 0.0;
    for (const ReferenceReport& reference : report.references) {
        noise = std::max(noise, reference.noise ? reference.noise->relative_rmse : 0.0);
    }
    if (noise > 0.0) {
        plot.rules.push_back({percent * noise, "noise of the reference itself, subtracted"});
    }
}

std::string description_of(const LinePlot& plot) {
    std::string text = plot.y.title + " over " + plot.x.title + ".";
    for (const PlotSeries& series : plot.series) {
        if (!series.points.empty()) {
            const PlotPoint& last = series.points.back();
            text += fmt::format(" {}: {:.2g}{} at {:.3g}{}.", series.name, last.y, plot.y.unit,
                                last.x, plot.x.unit);
        }
    }
    return text;
}

NamedPlot comparison(const AccuracyReport& report, Abscissa abscissa) {
    LinePlot plot = empty_plot(
        fmt::format("{}, {}×{}: error over {}", report.scene, report.size.x, report.size.y,
                    abscissa == Abscissa::seconds ? "time" : "iterations"),
        abscissa);
    const bool bundles = std::any_of(report.curves.begin(), report.curves.end(),
                                     [](const ErrorCurve& c) { return c.by_bundles; });
    std::size_t style = 0;
    for (const ErrorCurve& curve : report.curves) {
        if (!curve.knob.empty()) {
            continue;
        }
        // What a CPU method calls an iteration is something else.
        if (abscissa == Abscissa::seconds || !bundles || curve.by_bundles) {
            plot.series.push_back(series_of(curve, style, abscissa));
        }
        ++style;
    }
    add_noise(plot, report);
    plot.description = description_of(plot);
    return {abscissa == Abscissa::seconds ? "error_over_time.svg" : "error_over_iterations.svg",
            plot};
}

/// What a method says about its own error, beside what was measured.
NamedPlot estimate_plot(const ErrorCurve& curve, std::size_t style) {
    LinePlot plot = empty_plot(curve.name + ": its own estimate", Abscissa::seconds);
    plot.width = 520;
    plot.height = 340;
    PlotSeries measured = series_of(curve, style, Abscissa::seconds);
    measured.name = "measured";
    for (PlotPoint& point : measured.points) {
        point.band.reset();
    }
    PlotSeries estimated{"estimated", {}, true, 6};
    for (const CurvePoint& point : curve.points) {
        if (point.estimated_low > 0.0) {
            estimated.points.push_back(
                {point.seconds, percent * point.estimated_error,
                 std::pair{percent * point.estimated_low, percent * point.estimated_high}, true});
        }
    }
    plot.series = {measured, estimated};
    plot.y.title = "relRMSE";
    plot.description = description_of(plot);
    return {"estimate_" + curve.name + ".svg", plot};
}

NamedPlot knob_plot(const AccuracyReport& report, const std::string& knob) {
    LinePlot plot =
        empty_plot(fmt::format("{}, {}×{}: {}", report.scene, report.size.x, report.size.y, knob),
                   Abscissa::seconds);
    std::size_t style = 0;
    for (const ErrorCurve& curve : report.curves) {
        if (curve.knob == knob) {
            plot.series.push_back(series_of(curve, style++, Abscissa::seconds));
        }
    }
    add_noise(plot, report);
    plot.description = description_of(plot);
    std::string file = "knob_" + knob + ".svg";
    std::replace(file.begin(), file.end(), ' ', '_');
    return {file, plot};
}

bool has_estimate(const ErrorCurve& curve) {
    return std::any_of(curve.points.begin(), curve.points.end(),
                       [](const CurvePoint& point) { return point.estimated_low > 0.0; });
}

}  // namespace

std::vector<NamedPlot> accuracy_plots(const AccuracyReport& report) {
    std::vector<NamedPlot> plots = {comparison(report, Abscissa::seconds),
                                    comparison(report, Abscissa::iterations)};
    std::size_t style = 0;
    std::vector<std::string> knobs;
    for (const ErrorCurve& curve : report.curves) {
        if (curve.knob.empty()) {
            if (has_estimate(curve)) {
                plots.push_back(estimate_plot(curve, style));
            }
            ++style;
        } else if (std::find(knobs.begin(), knobs.end(), curve.knob) == knobs.end()) {
            knobs.push_back(curve.knob);
        }
    }
    for (const std::string& knob : knobs) {
        plots.push_back(knob_plot(report, knob));
    }
    return plots;
}

}  // namespace raybundle
