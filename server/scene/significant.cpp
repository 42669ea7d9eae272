// SPDX-License-Identifier: Apache-2.0
#include "scene/significant.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace raybundle {

std::string significant(double value, int digits) {
    constexpr double largest = 1e15;
    const double rounded = std::strtod(fmt::format("{:.{}e}", value, digits - 1).c_str(), nullptr);
    const double size = std::abs(rounded);
    return size >= std::pow(10.0, digits) && size < largest ? fmt::format("{:.0f}", rounded)
                                                            : fmt::format("{:.{}g}", value, digits);
}

}  // namespace raybundle
