// SPDX-License-Identifier: Apache-2.0
#include "measure/receiver.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "reference/sampling/directions.h"

namespace raybundle {
namespace {

using std::numbers::inv_pi;
using std::numbers::pi;

constexpr std::array quantity_names = {
    "HORIZONTAL",      "VERTICAL",        "NORMAL", "CYLINDRICAL",
    "SEMICYLINDRICAL", "DAYLIGHT_FACTOR", "UGR",    "DGP"};

const glm::dvec3 up(0.0, 1.0, 0.0);

glm::dvec3 axis_of(Quantity quantity, const glm::dvec3& direction) {
    switch (quantity) {
        case Quantity::vertical:
        case Quantity::semicylindrical:
            return glm::normalize(glm::dvec3(direction.x, 0.0, direction.z));
        case Quantity::normal:
            return glm::normalize(direction);
        default:
            return up;
    }
}

/// A number in (-1, 1) with density sqrt(1 - x^2): one coordinate of a point of the unit disc.
double semicircle(const glm::dvec2& u) {
    return std::sqrt(u.x) * std::cos(2.0 * pi * u.y);
}

double sine_from_vertical(const glm::dvec3& direction) {
    return std::sqrt(std::max(1.0 - direction.y * direction.y, 0.0));
}

}  // namespace

std::optional<Quantity> quantity_named(const std::string& name) {
    std::string wanted = name;
    std::transform(wanted.begin(), wanted.end(), wanted.begin(), [](unsigned char c) {
        return c == '-' ? '_' : static_cast<char>(std::toupper(c));
    });
    for (std::size_t i = 0; i < quantity_names.size(); ++i) {
        if (wanted == quantity_names[i]) {
            return static_cast<Quantity>(i);
        }
    }
    return std::nullopt;
}

const char* name_of(Quantity quantity) {
    return quantity_names[static_cast<std::size_t>(quantity)];
}

const char* unit_of(Quantity quantity) {
    return is_glare(quantity) ? "" : quantity == Quantity::daylight_factor ? "%" : "lx";
}

Receiver::Receiver(Quantity quantity, const glm::dvec3& direction)
    : shape_(quantity == Quantity::cylindrical       ? Shape::cylinder
             : quantity == Quantity::semicylindrical ? Shape::half_cylinder
                                                     : Shape::plane),
      axis_(axis_of(quantity, direction)) {}

double Receiver::weight(const glm::dvec3& direction) const {
    switch (shape_) {
        case Shape::cylinder:
            return inv_pi * sine_from_vertical(direction);
        case Shape::half_cylinder:  // sin(theta) cos(alpha) is the cosine to the axis
            return inv_pi *
                   std::max(sine_from_vertical(direction) + glm::dot(direction, axis_), 0.0);
        case Shape::plane:
            break;
    }
    return std::max(glm::dot(direction, axis_), 0.0);
}

/// Of cylinders the height has the density 2/pi sqrt(1 - y^2); about the half cylinder the azimuth
/// has (1 + cos(alpha))/(2 pi), so that sin(alpha/2) is distributed like the height.
glm::dvec3 Receiver::sample(Sampler& sampler) const {
    const glm::dvec2 u = sampler.next_pair();
    if (shape_ == Shape::plane) {
        return Frame(axis_).to_world(cosine_hemisphere(u));
    }
    const glm::dvec2 v = sampler.next_pair();
    const double height = semicircle(u);
    const double sine = std::sqrt(std::max(1.0 - height * height, 0.0));
    if (shape_ == Shape::cylinder) {
        const double azimuth = 2.0 * pi * v.x;
        return {sine * std::cos(azimuth), height, sine * std::sin(azimuth)};
    }
    const double azimuth = 2.0 * std::asin(std::clamp(semicircle(v), -1.0, 1.0));
    const glm::dvec3 aside = glm::cross(axis_, up);
    return sine * (std::cos(azimuth) * axis_ + std::sin(azimuth) * aside) + height * up;
}

}  // namespace raybundle
