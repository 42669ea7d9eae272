// SPDX-License-Identifier: Apache-2.0
#include "research/plot/line_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "research/plot/plot_labels.h"
#include "research/plot/plot_style.h"
#include "research/plot/svg_text.h"

namespace raybundle {
namespace {

constexpr double left = 74.0;  // margins, pixels
constexpr double top = 46.0;
constexpr double bottom = 56.0;
constexpr double label_gap = 14.0;      // from the frame to the names
constexpr double label_spacing = 16.0;  // between the names
constexpr double character_width = 7.2;

/// Where values fall in the picture.
struct Frame {
    Axis x, y;
    double right = 0.0;
    double base = 0.0;  ///< lower end

    [[nodiscard]] double at_x(double value) const {
        return left + x.position(value) * (right - left);
    }
    [[nodiscard]] double at_y(double value) const {
        return base - y.position(value) * (base - top);
    }
};

bool can_show(const PlotAxis& axis, double value) {
    return std::isfinite(value) && (value > 0.0 || axis.scale == AxisScale::linear);
}

std::vector<PlotSeries> shown_series(const LinePlot& plot) {
    std::vector<PlotSeries> result;
    for (const PlotSeries& series : plot.series) {
        PlotSeries kept = series;
        std::erase_if(kept.points, [&](const PlotPoint& point) {
            return !can_show(plot.x, point.x) || !can_show(plot.y, point.y);
        });
        for (PlotPoint& point : kept.points) {
            if (point.band &&
                (!can_show(plot.y, point.band->first) || !can_show(plot.y, point.band->second))) {
                point.band.reset();
            }
        }
        if (!kept.points.empty()) {
            result.push_back(std::move(kept));
        }
    }
    return result;
}

/// Room for the longest name, counted in characters rather than bytes.
double label_width(const std::vector<PlotSeries>& series) {
    std::size_t longest = 4;
    for (const PlotSeries& s : series) {
        const auto characters = std::count_if(s.name.begin(), s.name.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
        });
        longest = std::max(longest, static_cast<std::size_t>(characters));
    }
    return std::min(character_width * static_cast<double>(longest), 260.0);
}

Frame frame_of(const LinePlot& plot, const std::vector<PlotSeries>& series) {
    std::vector<double> xs;
    std::vector<double> ys;
    for (const PlotSeries& s : series) {
        for (const PlotPoint& point : s.points) {
            xs.push_back(point.x);
            ys.push_back(point.y);
            if (point.band) {
                ys.insert(ys.end(), {point.band->first, point.band->second});
            }
        }
    }
    for (const PlotRule& rule : plot.rules) {
        ys.push_back(rule.y);
    }
    return {axis_for(xs, plot.x.scale, plot.x.unit), axis_for(ys, plot.y.scale, plot.y.unit),
            plot.width - label_gap - label_width(series) - 24.0, plot.height - bottom};
}

std::string line(const char* style, double x0, double y0, double x1, double y1) {
    return fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", style,
                       svg_number(x0), svg_number(y0), svg_number(x1), svg_number(y1));
}

std::string text(const std::string& style, double x, double y, const char* anchor,
                 const std::string& content, const std::string& more = "") {
    return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}>{}</text>\n",
                       style, svg_number(x), svg_number(y), anchor, more, xml_escaped(content));
}

std::string axes(const LinePlot& plot, const Frame& frame) {
    std::string svg;
    for (const AxisTick& tick : frame.x.ticks) {
        const double x = frame.at_x(tick.value);
        svg += line(tick.label.empty() ? "minor" : "grid", x, top, x, frame.base);
        svg += tick.label.empty() ? "" : text("tick", x, frame.base + 18.0, "middle", tick.label);
    }
    for (const AxisTick& tick : frame.y.ticks) {
        const double y = frame.at_y(tick.value);
        svg += line(tick.label.empty() ? "minor" : "grid", left, y, frame.right, y);
        svg += tick.label.empty() ? "" : text("tick", left - 8.0, y + 4.0, "end", tick.label);
    }
    svg += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                       svg_number(left), svg_number(top), svg_number(frame.right - left),
                       svg_number(frame.base - top));
    const double middle = 0.5 * (top + frame.base);
    svg += text("axis", 0.5 * (left + frame.right), frame.base + 42.0, "middle", plot.x.title);
    svg += text("axis", 18.0, middle, "middle", plot.y.title,
                fmt::format(" transform=\"rotate(-90 18 {})\"", svg_number(middle)));
    return svg;
}

std::string rule(const PlotRule& rule, const PlotAxis& axis, const Frame& frame) {
    if (!can_show(axis, rule.y)) {
        return "";
    }
    const double y = frame.at_y(rule.y);
    return line("rule", left, y, frame.right, y) +
           text("tick", left + 8.0, y - 5.0, "start", rule.name);
}

std::string place(const PlotPoint& point, const Frame& frame) {
    return svg_number(frame.at_x(point.x)) + "," + svg_number(frame.at_y(point.y));
}

/// The areas between the ends of the bands, one for each run of neighbours that have one.
std::string bands(const PlotSeries& series, const Frame& frame) {
    std::string svg;
    for (std::size_t begin = 0; begin < series.points.size();) {
        std::size_t end = begin;
        std::string upper;
        std::string lower;
        while (end < series.points.size() && series.points[end].band) {
            const PlotPoint& point = series.points[end++];
            const std::string x = svg_number(frame.at_x(point.x)) + ",";
            upper += x + svg_number(frame.at_y(point.band->second)) + " ";
            lower = x + svg_number(frame.at_y(point.band->first)) + " " + lower;
        }
        if (end > begin + 1) {
            svg += fmt::format("<polygon class=\"band f{}\" points=\"{}{}\"/>\n",
                               series.style % plot_style_count, upper, lower);
        }
        begin = std::max(end, begin + 1);
    }
    return svg;
}

/// The line through the points, in stretches that are drawn alike: one to a point that is not firm
/// is dotted.
std::string lines(const PlotSeries& series, const Frame& frame) {
    std::string svg;
    const std::vector<PlotPoint>& points = series.points;
    for (std::size_t begin = 0; begin + 1 < points.size();) {
        const auto firm = [&](std::size_t i) { return points[i].firm && points[i + 1].firm; };
        std::size_t end = begin;
        std::string places = place(points[begin], frame);
        while (end + 1 < points.size() && firm(end) == firm(begin)) {
            places += " " + place(points[++end], frame);
        }
        const char* kind = !firm(begin) ? " dotted" : series.dashed ? " dashed" : "";
        svg += fmt::format("<polyline class=\"line s{}{}\" points=\"{}\"/>\n",
                           series.style % plot_style_count, kind, places);
        begin = end;
    }
    return svg;
}

std::string markers(const PlotSeries& series, const LinePlot& plot, const Frame& frame) {
    const std::size_t style = series.style % plot_style_count;
    std::string svg;
    for (const PlotPoint& point : series.points) {
        const std::string kind =
            point.firm ? fmt::format("marker f{}", style) : fmt::format("open s{}", style);
        svg += fmt::format("<path class=\"{}\" d=\"{}\"><title>{}</title></path>\n", kind,
                           plot_marker(series.style, frame.at_x(point.x), frame.at_y(point.y)),
                           xml_escaped(series.name + ": " + readable_number(point.y) + plot.y.unit +
                                       " at " + readable_number(point.x) + plot.x.unit));
    }
    return svg;
}

/// Every line's name at its end, moved apart and tied to the line where that was needed.
std::string names(const std::vector<PlotSeries>& series, const Frame& frame) {
    std::vector<double> wanted;
    for (const PlotSeries& s : series) {
        wanted.push_back(frame.at_y(s.points.back().y));
    }
    const std::vector<double> placed = spread_labels(wanted, label_spacing, top + 4.0, frame.base);
    std::string svg;
    for (std::size_t i = 0; i < series.size(); ++i) {
        const std::string style = std::to_string(series[i].style % plot_style_count);
        const double end = frame.at_x(series[i].points.back().x) + 6.0;
        svg += line(("leader s" + style).c_str(), end, wanted[i], frame.right + label_gap - 4.0,
                    placed[i]);
        svg += text("f" + style, frame.right + label_gap, placed[i] + 4.5, "start", series[i].name);
    }
    return svg;
}

}  // namespace

std::string svg_of(const LinePlot& plot) {
    const std::vector<PlotSeries> series = shown_series(plot);
    const Frame frame = frame_of(plot, series);
    std::string svg = fmt::format(
        "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
        "width=\"{0}\" height=\"{1}\" role=\"img\">\n<title>{2}</title>\n<desc>{3}</desc>\n"
        "<style>{4}</style>\n<rect class=\"ground\" width=\"{0}\" height=\"{1}\"/>\n",
        plot.width, plot.height, xml_escaped(plot.title), xml_escaped(plot.description),
        plot_style_sheet());
    svg += text("title", left, 26.0, "start", plot.title);
    svg += axes(plot, frame);
    for (const PlotRule& r : plot.rules) {
        svg += rule(r, plot.y, frame);
    }
    for (const PlotSeries& s : series) {
        svg += bands(s, frame);
    }
    for (const PlotSeries& s : series) {
        svg += lines(s, frame) + markers(s, plot, frame);
    }
    return svg + names(series, frame) + "</svg>\n";
}

}  // namespace raybundle
