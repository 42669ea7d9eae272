// SPDX-License-Identifier: Apache-2.0
#include "report/contours.h"

#include <array>
#include <cmath>

namespace raybundle {

std::vector<ContourPiece> contour(std::span<const double> values, std::size_t columns,
                                  std::size_t rows, double level) {
    std::vector<ContourPiece> pieces;
    const auto value = [&](std::size_t column, std::size_t row) {
        return values[row * columns + column];
    };
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const std::array<glm::dvec2, 4> corner = {
                glm::dvec2(column, row), glm::dvec2(column + 1, row),
                glm::dvec2(column + 1, row + 1), glm::dvec2(column, row + 1)};
            const std::array<double, 4> at = {value(column, row), value(column + 1, row),
                                              value(column + 1, row + 1), value(column, row + 1)};
            std::array<glm::dvec2, 4> crossing;
            std::size_t count = 0;
            bool known = true;
            for (std::size_t k = 0; k < 4; ++k) {
                const double a = at[k];
                const double b = at[(k + 1) % 4];
                known = known && std::isfinite(a);
                if ((a >= level) != (b >= level)) {
                    crossing[count++] =
                        glm::mix(corner[k], corner[(k + 1) % 4], glm::dvec2((level - a) / (b - a)));
                }
            }
            if (!known) {
                continue;
            }
            // Of a saddle, the middle decides which corners belong together.
            const double middle = 0.25 * (at[0] + at[1] + at[2] + at[3]);
            const bool joined = (middle >= level) == (at[0] >= level);
            const std::size_t first = count == 4 && !joined ? 1 : 0;
            for (std::size_t k = 0; k + 1 < count; k += 2) {
                pieces.push_back({crossing[first + k], crossing[(first + k + 1) % count]});
            }
        }
    }
    return pieces;
}

std::vector<double> round_levels(double least, double largest) {
    std::vector<double> levels;
    const double range = largest - least;
    if (!(range > 0.0) || !std::isfinite(range) || range < 1e-9 * std::abs(largest)) {
        return levels;
    }
    constexpr double wanted = 6.0;
    const double power = std::pow(10.0, std::floor(std::log10(range / wanted)));
    const double share = range / wanted / power;
    const double step = power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
    for (double level = std::ceil(least / step) * step; level <= largest && levels.size() < 20;
         level += step) {
        levels.push_back(level);
    }
    return levels;
}

}  // namespace raybundle
