// SPDX-License-Identifier: Apache-2.0
#include "scene/medium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raybundle {
namespace {

/// Contrast that a black thing at the visibility keeps, as a natural logarithm: 2 %, Koschmieder's.
const double log_contrast = std::log(50.0);

/// Two unit vectors across a third.
void find_axes_across(const glm::dvec3& z, glm::dvec3& x, glm::dvec3& y) {
    const glm::dvec3 helper = std::abs(z.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    x = glm::normalize(glm::cross(helper, z));
    y = glm::cross(z, x);
}

}  // namespace

double Medium::extinction_of(double visibility) {
    return log_contrast / visibility;
}

double Medium::visibility() const {
    return log_contrast / extinction;
}

double Medium::left_after(double metres) const {
    return std::exp(-extinction * metres);
}

double phase_of(double anisotropy, double cosine) {
    const double g = anisotropy;
    const double square = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (4.0 * std::numbers::pi * square * std::sqrt(square));
}

glm::dvec3 scattered_direction(double anisotropy, const glm::dvec3& along, const glm::dvec2& u) {
    constexpr double isotropic = 1e-4;
    const double g = anisotropy;
    double cosine = 1.0 - 2.0 * u.x;
    if (std::abs(g) > isotropic) {
        const double part = (1.0 - g * g) / (1.0 - g + 2.0 * g * u.x);
        cosine = std::clamp((1.0 + g * g - part * part) / (2.0 * g), -1.0, 1.0);
    }
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    glm::dvec3 x;
    glm::dvec3 y;
    find_axes_across(along, x, y);
    const double turn = 2.0 * std::numbers::pi * u.y;
    return glm::normalize(sine * (std::cos(turn) * x + std::sin(turn) * y) + cosine * along);
}

WayInBox way_in_box(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& origin,
                    const glm::dvec3& direction, double end) {
    WayInBox way{0.0, end};
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (origin[axis] < low[axis] || origin[axis] > high[axis]) {
                return {};
            }
            continue;
        }
        const double a = (low[axis] - origin[axis]) / direction[axis];
        const double b = (high[axis] - origin[axis]) / direction[axis];
        way.begin = std::max(way.begin, std::min(a, b));
        way.end = std::min(way.end, std::max(a, b));
    }
    return way.length() > 0.0 ? way : WayInBox{};
}

std::string problem_of(const Medium& medium) {
    const double visibility = medium.visibility();
    if (!(visibility >= Medium::least_visibility && visibility <= Medium::most_visibility)) {
        return fmt::format("visibility: must be a number from {} to {}", Medium::least_visibility,
                           Medium::most_visibility);
    }
    for (int c = 0; c < 3; ++c) {
        if (!(medium.albedo[c] >= 0.0F && medium.albedo[c] <= 1.0F)) {
            return "albedo: must be from 0 to 1";
        }
    }
    if (!(std::abs(medium.anisotropy) <= Medium::most_anisotropy)) {
        return fmt::format("anisotropy: must be a number from -{} to {}", Medium::most_anisotropy,
                           Medium::most_anisotropy);
    }
    return {};
}

}  // namespace raybundle
