// SPDX-License-Identifier: Apache-2.0
#include "research/plot/plot_style.h"

#include <array>

#include <fmt/core.h>

#include "research/plot/svg_text.h"

namespace raybundle {
namespace {

struct Colour {
    const char* light;  ///< on a light ground
    const char* dark;
};

constexpr std::array<Colour, plot_style_count> colours = {{
    {"#0072b2", "#4fb3f0"},  // blue
    {"#d55e00", "#ff8a3d"},  // vermilion
    {"#00875f", "#2fc997"},  // bluish green
    {"#b0508f", "#e391c4"},  // reddish purple
    {"#9a6a00", "#e6ab2e"},  // orange
    {"#5b4bb5", "#a99cf5"},  // violet
    {"#555555", "#bdbdbd"},  // grey
    {"#1f8a9c", "#63cfdf"},  // cyan
}};

constexpr const char* parts = R"css(
.plot { --ground: #ffffff; --ink: #1f2328; --faint: #5f666e; --grid: #e6e8eb; --frame: #9aa1a9; }
.plot text { font: 13px system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; fill: var(--ink); }
.plot .title { font-size: 15px; font-weight: 600; }
.plot .tick { fill: var(--faint); font-size: 12px; }
.plot .ground { fill: var(--ground); }
.plot .grid { stroke: var(--grid); stroke-width: 1; }
.plot .minor { stroke: var(--grid); stroke-width: 0.5; }
.plot .frame { stroke: var(--frame); stroke-width: 1; fill: none; }
.plot .rule { stroke: var(--faint); stroke-width: 1; stroke-dasharray: 2 4; }
.plot .leader { stroke-width: 0.75; opacity: 0.6; }
.plot .line { fill: none; stroke-width: 2; stroke-linejoin: round; }
.plot .dashed { stroke-dasharray: 7 4; }
.plot .dotted { stroke-width: 1.5; stroke-dasharray: 1.5 3.5; }
.plot .open { fill: var(--ground); stroke-width: 1.5; }
.plot .band { stroke: none; opacity: 0.16; }
.plot .marker { stroke: var(--ground); stroke-width: 1; }
)css";

constexpr const char* dark_parts =
    ".plot { --ground: #16191d; --ink: #e6e9ec; --faint: #a2a9b1; --grid: #2b3036; "
    "--frame: #5c636b; }\n";

std::string rules_of(std::size_t style, const char* colour) {
    return fmt::format(
        ".plot .s{0} {{ stroke: {1}; }} .plot .f{0} {{ fill: {1}; }} .plot text.f{0} {{ fill: {1}; "
        "}}\n",
        style, colour);
}

}  // namespace

std::string plot_style_sheet() {
    std::string light = parts;
    std::string dark = dark_parts;
    for (std::size_t style = 0; style < colours.size(); ++style) {
        light += rules_of(style, colours[style].light);
        dark += rules_of(style, colours[style].dark);
    }
    return light + "@media (prefers-color-scheme: dark) {\n" + dark + "}\n";
}

std::string plot_marker(std::size_t style, double x, double y) {
    constexpr double r = 4.2;
    const auto corner = [&](double dx, double dy) {
        return svg_number(x + dx) + "," + svg_number(y + dy);
    };
    switch (style % 5) {
        case 0:  // a circle of two arcs
            return fmt::format("M{0} a{2},{2} 0 1 0 {3},0 a{2},{2} 0 1 0 {4},0 Z", corner(-r, 0.0),
                               0, r, 2.0 * r, -2.0 * r);
        case 1:
            return "M" + corner(-3.7, -3.7) + " L" + corner(3.7, -3.7) + " " + corner(3.7, 3.7) +
                   " " + corner(-3.7, 3.7) + " Z";
        case 2:
            return "M" + corner(0.0, -5.0) + " L" + corner(4.7, 3.6) + " " + corner(-4.7, 3.6) +
                   " Z";
        case 3:
            return "M" + corner(0.0, -5.2) + " L" + corner(5.2, 0.0) + " " + corner(0.0, 5.2) +
                   " " + corner(-5.2, 0.0) + " Z";
        default:
            return "M" + corner(0.0, 5.0) + " L" + corner(4.7, -3.6) + " " + corner(-4.7, -3.6) +
                   " Z";
    }
}

}  // namespace raybundle
