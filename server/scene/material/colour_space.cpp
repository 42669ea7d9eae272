// SPDX-License-Identifier: Apache-2.0
#include "scene/material/colour_space.h"

#include <cmath>

namespace raybundle {
namespace {

/// ITU-R BT.709: red, green, blue, and D65.
constexpr std::array<double, 8> rec709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};

/// Of luminance 1.
glm::dvec3 xyz_of(double x, double y) {
    return {x / y, 1.0, (1.0 - x - y) / y};
}

/// Columns: the primaries in XYZ, as bright as they are in white.
std::optional<glm::dmat3> xyz_from_rgb(const std::array<double, 8>& xy) {
    for (std::size_t i = 1; i < xy.size(); i += 2) {
        if (!std::isfinite(xy[i - 1]) || !std::isfinite(xy[i]) || xy[i] == 0.0) {
            return std::nullopt;
        }
    }
    glm::dmat3 primaries;
    for (int c = 0; c < 3; ++c) {
        const std::size_t i = 2 * static_cast<std::size_t>(c);
        primaries[c] = xyz_of(xy[i], xy[i + 1]);
    }
    constexpr double flat = 1e-6;  // primaries on one line
    if (!(std::abs(glm::determinant(primaries)) > flat)) {
        return std::nullopt;
    }
    const glm::dvec3 bright = glm::inverse(primaries) * xyz_of(xy[6], xy[7]);
    for (int c = 0; c < 3; ++c) {
        primaries[c] *= bright[c];
    }
    return primaries;
}

}  // namespace

glm::dmat3 rec709_from_xyz() {
    return glm::inverse(*xyz_from_rgb(rec709));
}

std::optional<glm::dmat3> rec709_from_primaries(const std::array<double, 8>& xy) {
    const auto xyz = xyz_from_rgb(xy);
    if (!xyz) {
        return std::nullopt;
    }
    // Bradford's cone responses, as ICC profiles use them.
    const glm::dmat3 cones = glm::transpose(
        glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dvec3 gain = (cones * xyz_of(rec709[6], rec709[7])) / (cones * xyz_of(xy[6], xy[7]));
    const glm::dmat3 scale(glm::dvec3(gain.x, 0, 0), glm::dvec3(0, gain.y, 0),
                           glm::dvec3(0, 0, gain.z));
    return rec709_from_xyz() * glm::inverse(cones) * scale * cones * *xyz;
}

}  // namespace raybundle
