// SPDX-License-Identifier: Apache-2.0
#include "reference/measures/structural_similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace raybundle {
namespace {

constexpr int radius = 5;
constexpr double deviation = 1.5;
constexpr double white = 255.0;
constexpr double c1 = (0.01 * white) * (0.01 * white);
constexpr double c2 = (0.03 * white) * (0.03 * white);

std::vector<double> luma_of(std::span<const std::uint8_t> rgba) {
    std::vector<double> luma(rgba.size() / 4);
    for (std::size_t i = 0; i < luma.size(); ++i) {
        luma[i] = 0.299 * rgba[4 * i] + 0.587 * rgba[4 * i + 1] + 0.114 * rgba[4 * i + 2];
    }
    return luma;
}

/// Place of a pixel's weight, by its way from the window's middle.
std::size_t index_of(int way) {
    const int index = way + radius;
    return static_cast<std::size_t>(index);
}

std::array<double, 2 * radius + 1> window() {
    std::array<double, 2 * radius + 1> weights{};
    for (int k = -radius; k <= radius; ++k) {
        weights[index_of(k)] = std::exp(-0.5 * k * k / (deviation * deviation));
    }
    return weights;
}

/// Weighted moments of both pictures in the window round a pixel.
struct Moments {
    double weight = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;

    void add(double w, double a, double b) {
        weight += w;
        x += w * a;
        y += w * b;
        xx += w * a * a;
        yy += w * b * b;
        xy += w * a * b;
    }
    [[nodiscard]] double similarity() const {
        const double mean_x = x / weight;
        const double mean_y = y / weight;
        const double var_x = std::max(xx / weight - mean_x * mean_x, 0.0);
        const double var_y = std::max(yy / weight - mean_y * mean_y, 0.0);
        const double covariance = xy / weight - mean_x * mean_y;
        return (2.0 * mean_x * mean_y + c1) * (2.0 * covariance + c2) /
               ((mean_x * mean_x + mean_y * mean_y + c1) * (var_x + var_y + c2));
    }
};

}  // namespace

double structural_similarity(std::span<const std::uint8_t> image,
                             std::span<const std::uint8_t> reference,
                             const std::vector<bool>& counted, glm::uvec2 size) {
    const std::size_t pixels = std::size_t{size.x} * size.y;
    if (image.size() != 4 * pixels || reference.size() != 4 * pixels || counted.size() != pixels) {
        throw std::invalid_argument("pictures of different sizes");
    }
    const std::vector<double> x = luma_of(image);
    const std::vector<double> y = luma_of(reference);
    const auto weights = window();
    const auto width = static_cast<int>(size.x);
    const auto height = static_cast<int>(size.y);
    double sum = 0.0;
    std::size_t count = 0;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            if (!counted[static_cast<std::size_t>(row) * size.x + static_cast<unsigned>(column)]) {
                continue;
            }
            Moments moments;
            for (int j = std::max(row - radius, 0); j <= std::min(row + radius, height - 1); ++j) {
                for (int i = std::max(column - radius, 0);
                     i <= std::min(column + radius, width - 1); ++i) {
                    const std::size_t at =
                        static_cast<std::size_t>(j) * size.x + static_cast<unsigned>(i);
                    moments.add(weights[index_of(i - column)] * weights[index_of(j - row)], x[at],
                                y[at]);
                }
            }
            sum += moments.similarity();
            ++count;
        }
    }
    if (count == 0) {
        throw std::invalid_argument("no pixel is left to measure");
    }
    return sum / static_cast<double>(count);
}

}  // namespace raybundle
