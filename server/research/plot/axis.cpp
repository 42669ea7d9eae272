// SPDX-License-Identifier: Apache-2.0
#include "research/plot/axis.h"

#include <algorithm>
#include <cmath>

#include "research/plot/svg_text.h"

namespace raybundle {
namespace {

/// Of a decade that carry a label while there are few decades.
constexpr double round_mantissas[] = {1.0, 2.0, 5.0};
constexpr double labelled_decades = 3.3;  // with more of them only powers of ten have labels
constexpr double nearly = 1e-9;           // relative room for rounding at an axis' ends
constexpr double overhang = 1.03;         // factor by which values may pass a round end

double power_of_ten(double exponent) {
    return std::pow(10.0, exponent);
}

/// Largest 1, 2 or 5 times a power of ten that is not above the value.
double round_below(double value) {
    const double decade = std::floor(std::log10(value));
    double best = power_of_ten(decade - 1.0) * 5.0;
    for (const double mantissa : round_mantissas) {
        const double candidate = mantissa * power_of_ten(decade);
        if (candidate <= value * (1.0 + nearly)) {
            best = candidate;
        }
    }
    return best;
}

double round_above(double value) {
    const double decade = std::floor(std::log10(value));
    for (const double mantissa : round_mantissas) {
        const double candidate = mantissa * power_of_ten(decade);
        if (candidate >= value * (1.0 - nearly)) {
            return candidate;
        }
    }
    return power_of_ten(decade + 1.0);
}

bool is_labelled(int mantissa, double decades) {
    if (decades > labelled_decades) {
        return mantissa == 1;
    }
    return mantissa == 1 || mantissa == 2 || mantissa == 5 ||
           (decades < 0.75 && (mantissa == 3 || mantissa == 7));
}

void add_logarithmic_ticks(Axis& axis, const std::string& unit) {
    const double decades = std::log10(axis.high / axis.low);
    const auto first = static_cast<int>(std::floor(std::log10(axis.low) + nearly));
    const auto last = static_cast<int>(std::floor(std::log10(axis.high) + nearly));
    for (int exponent = first; exponent <= last; ++exponent) {
        for (int mantissa = 1; mantissa <= 9; ++mantissa) {
            const double value = mantissa * power_of_ten(exponent);
            if (value < axis.low * (1.0 - nearly) || value > axis.high * (1.0 + nearly)) {
                continue;
            }
            const bool labelled = is_labelled(mantissa, decades);
            axis.ticks.push_back({value, labelled ? readable_number(value) + unit : ""});
        }
    }
}

void add_linear_ticks(Axis& axis, double step, const std::string& unit) {
    const auto count = static_cast<int>(std::lround((axis.high - axis.low) / step));
    for (int i = 0; i <= count; ++i) {
        const double value = axis.low + i * step;
        const double shown = std::abs(value) < nearly * step ? 0.0 : value;
        axis.ticks.push_back({shown, readable_number(shown) + unit});
    }
}

Axis logarithmic_axis(double low, double high, const std::string& unit) {
    Axis axis{AxisScale::logarithmic,
              std::min(round_below(low * overhang), low),
              std::max(round_above(high / overhang), high),
              {}};
    if (!(axis.high > axis.low * overhang)) {
        axis.low /= 2.0;
        axis.high *= 2.0;
    }
    add_logarithmic_ticks(axis, unit);
    return axis;
}

Axis linear_axis(double low, double high, const std::string& unit) {
    if (!(high > low)) {
        low -= 0.5;
        high += 0.5;
    }
    const double step = round_above((high - low) / 6.0);
    Axis axis{AxisScale::linear,
              std::floor(low / step + nearly) * step,
              std::ceil(high / step - nearly) * step,
              {}};
    add_linear_ticks(axis, step, unit);
    return axis;
}

}  // namespace

double Axis::position(double value) const {
    if (scale == AxisScale::logarithmic) {
        return std::log(value / low) / std::log(high / low);
    }
    return (value - low) / (high - low);
}

Axis axis_for(const std::vector<double>& values, AxisScale scale, const std::string& unit) {
    const bool logarithmic = scale == AxisScale::logarithmic;
    std::vector<double> kept;
    std::copy_if(values.begin(), values.end(), std::back_inserter(kept), [&](double value) {
        return std::isfinite(value) && (value > 0.0 || !logarithmic);
    });
    if (kept.empty()) {
        kept = {logarithmic ? 0.1 : 0.0, 1.0};
    }
    const auto [low, high] = std::minmax_element(kept.begin(), kept.end());
    return logarithmic ? logarithmic_axis(*low, *high, unit) : linear_axis(*low, *high, unit);
}

}  // namespace raybundle
