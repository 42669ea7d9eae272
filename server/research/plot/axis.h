// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace raybundle {

enum class AxisScale { linear, logarithmic };

/// A place on an axis. Lines are drawn at all of them, text stands at some.
struct AxisTick {
    double value = 0.0;
    std::string label;  ///< empty: a line alone
};

/// Range of an axis with its ticks.
struct Axis {
    AxisScale scale = AxisScale::linear;
    double low = 0.0;
    double high = 1.0;
    std::vector<AxisTick> ticks;  ///< ascending, within [low, high]

    /// 0 at low, 1 at high.
    [[nodiscard]] double position(double value) const;
};

/// Axis that holds all values, its ends at round numbers or a little beyond; unit: text behind each
/// label, as " s". A logarithmic axis passes over values that are not positive, either over those
/// that are not finite; without any value left the axis goes from 0.1 to 1, or 0 to 1.
Axis axis_for(const std::vector<double>& values, AxisScale scale, const std::string& unit);

}  // namespace raybundle
