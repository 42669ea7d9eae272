// SPDX-License-Identifier: Apache-2.0
#include "view/image/tone_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace raybundle {
namespace {

constexpr double mid_grey = 0.18;
constexpr double white = 6.0;
constexpr double least_luminance = 1e-4;  // cd/m², in the logarithmic mean

double shoulder(double x) {
    return x * (1.0 + x / (white * white)) / (1.0 + x);
}

/// IEC 61966-2-1.
double srgb_encoded(double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

}  // namespace

double automatic_display_factor(std::span<const glm::dvec3> radiance,
                                const std::vector<bool>& counted) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        if (counted[i]) {
            const double luminance = glm::dot(radiance[i], glm::dvec3(0.2126, 0.7152, 0.0722));
            sum += std::log(std::max(luminance, least_luminance));
            ++count;
        }
    }
    return mid_grey / (count > 0 ? std::exp(sum / static_cast<double>(count)) : 1.0);
}

std::vector<std::uint8_t> tone_mapped(std::span<const glm::dvec3> radiance, double factor) {
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * radiance.size());
    for (const glm::dvec3& value : radiance) {
        for (int c = 0; c < 3; ++c) {
            const double shown = std::clamp(shoulder(std::max(value[c], 0.0) * factor), 0.0, 1.0);
            rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0 * srgb_encoded(shown))));
        }
        rgba.push_back(255);
    }
    return rgba;
}

}  // namespace raybundle
