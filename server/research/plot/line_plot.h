// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "research/plot/axis.h"

namespace raybundle {

struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    std::optional<std::pair<double, double>> band;  ///< lower and upper end at this x
    bool firm = true;  ///< else with an open marker, the line to it dotted
};

/// One line with its name at its end.
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;  ///< ascending in x
    bool dashed = false;
    std::size_t style = 0;  ///< colour and marker, the same number for the same thing in all plots
};

/// A horizontal line across the plot, with a name.
struct PlotRule {
    double y = 0.0;
    std::string name;
};

struct PlotAxis {
    std::string title;
    std::string unit;  ///< behind each number, as " s"
    AxisScale scale = AxisScale::logarithmic;
};

struct LinePlot {
    std::string title;
    std::string description;  ///< for those who cannot see it
    PlotAxis x, y;
    std::vector<PlotSeries> series;
    std::vector<PlotRule> rules;
    int width = 760;  ///< pixels
    int height = 460;
};

/// The plot as an SVG document that stands for itself: readable on light and dark pages, lines told
/// apart by colour, marker and a name at their ends. Points that an axis cannot show (not finite,
/// or not positive on a logarithmic one) are passed over.
std::string svg_of(const LinePlot& plot);

}  // namespace raybundle
