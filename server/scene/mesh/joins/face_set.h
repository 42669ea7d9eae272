// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

namespace raybundle {

/// Faces that share their light, and sums over them.
struct FaceSet {
    std::uint32_t largest = 0;  // face
    double largest_area = -1.0;
    double area = 0.0;
    glm::dvec3 place{0.0}, normal{0.0}, colour{0.0};   // times area
    double squared_place = 0.0, squared_colour = 0.0;  // times area
    glm::dvec3 low{1e300}, high{-1e300};
    glm::dvec3 axis{0.0};  // unit: of a cone that holds all normals
    double angle = 0.0;    // half of its opening, radians

    /// Area times squared distance from the means. length: that a full turn of the normal, and the
    /// whole of the colours, are worth, m.
    [[nodiscard]] double cost(double length) const {
        if (!(area > 0.0)) {
            return 0.0;
        }
        const double places = squared_place - glm::dot(place, place) / area;
        const double turns = area - glm::dot(normal, normal) / area;
        const double colours = squared_colour - glm::dot(colour, colour) / area;
        return std::max(places, 0.0) +
               length * length * (std::max(turns, 0.0) + std::max(colours, 0.0));
    }
    [[nodiscard]] double squared_extent() const {
        const glm::dvec3 extent = glm::max(high - low, glm::dvec3(0.0));
        return glm::dot(extent, extent);
    }
};

inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    const double sum = glm::length(a) + glm::length(b);
    return sum > 0.0 ? std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) : 0.0;
}

inline FaceSet joined(const FaceSet& a, const FaceSet& b) {
    FaceSet c = a.largest_area >= b.largest_area ? a : b;
    c.area = a.area + b.area;
    c.place = a.place + b.place;
    c.normal = a.normal + b.normal;
    c.colour = a.colour + b.colour;
    c.squared_place = a.squared_place + b.squared_place;
    c.squared_colour = a.squared_colour + b.squared_colour;
    c.low = glm::min(a.low, b.low);
    c.high = glm::max(a.high, b.high);
    const double length = glm::length(c.normal);
    c.axis = length > 0.0 ? c.normal / length : c.axis;
    const auto opening = [&c](const FaceSet& part) {
        return part.area > 0.0 ? part.angle + angle_between(c.axis, part.axis) : 0.0;
    };
    c.angle = std::max(opening(a), opening(b));
    return c;
}

}  // namespace raybundle
