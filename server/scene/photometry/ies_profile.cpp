// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry/ies_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace raybundle {
namespace {

/// Where a value lies among ascending ones: the index below it and the share of the way to the
/// next. False outside of them.
struct Interval {
    std::size_t below = 0;
    double share = 0.0;
};

bool find_interval(const std::vector<double>& values, double x, Interval& interval) {
    constexpr double rounding = 1e-9;
    if (values.size() == 1) {
        return true;
    }
    if (x < values.front() - rounding || x > values.back() + rounding) {
        return false;
    }
    const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, x);
    interval.below = static_cast<std::size_t>(above - values.begin()) - 1;
    const double low = values[interval.below];
    const double high = values[interval.below + 1];
    interval.share = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return true;
}

}  // namespace

double IesProfile::Opening::projected_area(const glm::dvec3& direction) const {
    const double across_x = std::abs(direction.x) * heights[direction.x > 0.0 ? 0 : 2];
    const double across_y = std::abs(direction.y) * heights[direction.y > 0.0 ? 1 : 3];
    const double plate = std::abs(direction.z) * length * width;
    if (round) {  // the same box about it, of which a cylinder hides a part
        constexpr double quarter = glm::pi<double>() / 4.0;
        const double sine = std::hypot(direction.x, direction.y);
        const double height =
            sine > 0.0 ? (across_x * std::abs(direction.x) + across_y * std::abs(direction.y)) /
                             (sine * sine)
                       : 0.0;
        return quarter * plate + height * sine * std::max(length, width);
    }
    return plate + across_x * width + across_y * length;
}

IesProfile::IesProfile(Data data) : data_(std::move(data)) {
    integrate();
}

/// Horizontal angle among those of the file, by the symmetry that they imply.
double IesProfile::folded(double horizontal) const {
    const std::vector<double>& angles = data_.horizontal;
    if (data_.type != Type::c) {
        return angles.front() >= 0.0 ? std::abs(horizontal) : horizontal;
    }
    if (angles.front() >= 90.0) {  // LM-63-1995: 90 to 270, symmetric about that plane
        return horizontal >= 90.0 && horizontal <= 270.0 ? horizontal
                                                         : std::fmod(540.0 - horizontal, 360.0);
    }
    const double last = angles.back();
    const double half = horizontal > 180.0 ? 360.0 - horizontal : horizontal;
    if (last <= 90.0) {
        return half > 90.0 ? 180.0 - half : half;
    }
    return last <= 180.0 ? half : horizontal;
}

double IesProfile::at(double vertical, double horizontal) const {
    Interval v;
    Interval h;
    if (data_.type != Type::c && data_.vertical.front() >= 0.0) {
        vertical = std::abs(vertical);
    }
    if (!find_interval(data_.vertical, vertical, v) ||
        !find_interval(data_.horizontal, folded(horizontal), h)) {
        return 0.0;
    }
    const std::size_t rows = data_.vertical.size();
    const auto value = [&](std::size_t column, std::size_t row) {
        return data_.candela[std::min(column, data_.horizontal.size() - 1) * rows +
                             std::min(row, rows - 1)];
    };
    const auto along = [&](std::size_t column) {
        return std::lerp(value(column, v.below), value(column, v.below + 1), v.share);
    };
    return std::lerp(along(h.below), along(h.below + 1), h.share);
}

double IesProfile::candela(const glm::dvec3& direction) const {
    const glm::dvec3 d = glm::clamp(direction, -1.0, 1.0);
    switch (data_.type) {
        case Type::c: {
            const double turn = glm::degrees(std::atan2(d.y, d.x));
            return at(glm::degrees(std::acos(-d.z)), turn < 0.0 ? turn + 360.0 : turn);
        }
        case Type::b:  // the polar axis is x
            return at(glm::degrees(std::atan2(d.y, -d.z)), glm::degrees(std::asin(d.x)));
        case Type::a:  // the polar axis is y
            return at(glm::degrees(std::asin(d.y)), glm::degrees(std::atan2(d.x, -d.z)));
    }
    return 0.0;
}

/// Midpoint rule over degrees from pole to pole and 2.5 degrees round it, where most tables have
/// their angles: within 1e-4.
void IesProfile::integrate() {
    constexpr int rows = 180;
    constexpr int columns = 144;
    const double step = glm::pi<double>() / rows;
    const double turn = glm::two_pi<double>() / columns;
    std::vector<double> above(columns, 0.0);
    double sum = 0.0;
    double squares = 0.0;
    double slopes = 0.0;
    // Squares of slopes; beside a zero the table ends, or goes on by less than a step.
    const auto slope = [](double a, double b, double width) {
        return a > 0.0 && b > 0.0 ? (a - b) * (a - b) / (width * width) : 0.0;
    };
    for (int row = 0; row < rows; ++row) {
        const double theta = (row + 0.5) * step;
        const double sine = std::sin(theta);
        std::vector<double> ring(columns);
        for (int column = 0; column < columns; ++column) {
            const double phi = turn * (column + 0.5);
            ring[static_cast<std::size_t>(column)] =
                candela({sine * std::cos(phi), sine * std::sin(phi), -std::cos(theta)});
        }
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const double next = ring[(i + 1) % ring.size()];
            sum += sine * ring[i];
            squares += sine * ring[i] * ring[i];
            slopes += sine * (slope(ring[i], above[i], step) + slope(ring[i], next, turn * sine));
        }
        above = ring;
    }
    flux_ = sum * step * turn;
    // Of a Lambert surface the slopes' squares, sin², have the mean 2 cos².
    steepness_ = squares > 0.0 ? std::max(std::sqrt(0.5 * slopes / squares), 1.0) : 1.0;
}

}  // namespace raybundle
