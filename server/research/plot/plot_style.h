// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace raybundle {

/// Colours and markers that lines can have before they repeat.
constexpr std::size_t plot_style_count = 8;

/// Style sheet of all plots: classes of the parts, a colour for each style, and dark variants where
/// the reader prefers them. The hues are those of Okabe and Ito 2008, "Color Universal Design",
/// darkened or lightened until each has a contrast of 3:1 to the ground (WCAG 2.1, 1.4.11).
std::string plot_style_sheet();

/// Outline of a style's marker about a point, pixels.
std::string plot_marker(std::size_t style, double x, double y);

}  // namespace raybundle
