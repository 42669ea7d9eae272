// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/error_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "stream/image_encoder.h"

namespace raybundle {
namespace {

constexpr double luminance_floor = 1e-3;  // of the mean, as in compare_images()
constexpr std::uint8_t unmeasured = 128;

/// Diverging map "RdBu" (Brewer, ColorBrewer 2.0), from too dark to too bright; safe for the
/// colour-blind.
constexpr std::array<std::array<double, 3>, 7> colours = {{{33, 102, 172},
                                                           {103, 169, 207},
                                                           {209, 229, 240},
                                                           {247, 247, 247},
                                                           {253, 219, 199},
                                                           {239, 138, 98},
                                                           {178, 24, 43}}};

double luminance_of(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// t: -1 to 1.
void append_colour(std::vector<std::uint8_t>& rgba, double t) {
    const double at = (std::clamp(t, -1.0, 1.0) + 1.0) / 2.0 * double{colours.size() - 1};
    const auto lower = std::min(static_cast<std::size_t>(at), colours.size() - 2);
    const double share = at - static_cast<double>(lower);
    for (std::size_t c = 0; c < 3; ++c) {
        rgba.push_back(static_cast<std::uint8_t>(
            std::lround((1.0 - share) * colours[lower][c] + share * colours[lower + 1][c])));
    }
    rgba.push_back(255);
}

}  // namespace

std::vector<std::uint8_t> error_map(std::span<const glm::dvec3> image,
                                    std::span<const glm::dvec3> reference,
                                    const std::vector<bool>& measured, double scale) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        if (measured[i]) {
            sum += luminance_of(reference[i]);
            ++count;
        }
    }
    const double least = std::max(
        luminance_floor * sum / static_cast<double>(std::max<std::size_t>(count, 1)), 1e-30);
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * reference.size());
    for (std::size_t i = 0; i < reference.size(); ++i) {
        if (!measured[i]) {
            rgba.insert(rgba.end(), {unmeasured, unmeasured, unmeasured, 255});
            continue;
        }
        const double right = luminance_of(reference[i]);
        append_colour(rgba, (luminance_of(image[i]) - right) / std::max(right, least) / scale);
    }
    return rgba;
}

double error_map_scale(double p95) {
    for (const double scale : {0.02, 0.05, 0.1, 0.2, 0.5}) {
        if (p95 <= scale) {
            return scale;
        }
    }
    return 1.0;
}

std::string error_map_gradient() {
    std::string css = "linear-gradient(to right";
    for (const auto& c : colours) {
        css += fmt::format(", rgb({} {} {})", c[0], c[1], c[2]);
    }
    return css + ")";
}

std::string png_of(std::span<const std::uint8_t> rgba, glm::uvec2 size) {
    const std::vector<std::uint8_t> png =
        encode_png({rgba, static_cast<int>(size.x), static_cast<int>(size.y), false});
    return {png.begin(), png.end()};
}

}  // namespace raybundle
