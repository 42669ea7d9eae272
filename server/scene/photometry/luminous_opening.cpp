// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry/luminous_opening.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raybundle {
namespace {

/// In [0, 1]: nodes as u.x. The roots of Legendre's polynomial by Newton's method.
std::vector<OpeningPoint> gauss_legendre(int n) {
    std::vector<OpeningPoint> points;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double slope = 1.0;
        for (int step = 0; step < 8; ++step) {
            double before = 1.0;
            double value = x;
            for (int k = 1; k < n; ++k) {
                const double next = ((2 * k + 1) * x * value - k * before) / (k + 1);
                before = value;
                value = next;
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        points.push_back({{0.5 * (1.0 + x), 0.0}, 1.0 / ((1.0 - x * x) * slope * slope)});
    }
    return points;
}

/// Points along a side: ratio is that of the reach to the distance.
int order_for(double ratio, double tolerance) {
    constexpr int fewest = 4;
    constexpr int most = 16;
    double rest = 1.0 / 3.0;  // of x^2n: (2^n n!^2)^2 / ((2n + 1) (2n)!^2), n = 1
    double power = ratio * ratio;
    int n = 1;
    // Once for each side: of the worst direction.
    const auto bound = [&] {
        return 2.0 * rest * (2 * n + 1) * (2 * n + 2) * (2 * n + 3) / 6.0 * power;
    };
    while (n < fewest || (n < most && bound() > tolerance)) {
        ++n;
        const double half = n / (2.0 * n - 1.0);  // 2 n²/((2n - 1) 2n)
        rest *= half * half * (2 * n - 1) / (2 * n + 1);
        power *= ratio * ratio;
    }
    return n;
}

}  // namespace

glm::dvec2 LuminousOpening::at(const glm::dvec2& u) const {
    constexpr double quarter_turn = 0.5 * std::numbers::pi;
    switch (shape) {
        case Shape::point:
            break;
        case Shape::rectangle:
            return middle + half * (2.0 * u - 1.0);
        case Shape::ellipse:
        case Shape::quarter: {
            const double angle = (shape == Shape::quarter ? 1.0 : 4.0) * quarter_turn * u.y;
            return middle + half * std::sqrt(u.x) * glm::dvec2(std::cos(angle), std::sin(angle));
        }
    }
    return middle;
}

double LuminousOpening::largest_half() const {
    return std::max(std::abs(half.x), std::abs(half.y));
}

LuminousOpening opening_of(const IesProfile* profile) {
    LuminousOpening opening;
    if (profile == nullptr) {
        return opening;
    }
    const IesProfile::Opening& stated = profile->data().opening;
    if (stated.length > 0.0 || stated.width > 0.0) {
        opening.shape =
            stated.round ? LuminousOpening::Shape::ellipse : LuminousOpening::Shape::rectangle;
        opening.half = 0.5 * glm::dvec2(stated.length, stated.width);
        opening.steepness = profile->steepness();
    }
    return opening;
}

std::vector<OpeningPoint> opening_points(const LuminousOpening& opening, double distance,
                                         double tolerance) {
    const int n = order_for(opening.reach() / std::max(distance, 1e-9), tolerance);
    std::vector<OpeningPoint> along = gauss_legendre(n);
    std::vector<OpeningPoint> across = along;
    if (opening.shape == LuminousOpening::Shape::ellipse) {
        across.clear();
        for (int i = 0; i < 2 * n; ++i) {
            across.push_back({{(i + 0.5) / (2 * n), 0.0}, 0.5 / n});
        }
    }
    std::vector<OpeningPoint> points;
    for (const OpeningPoint& x : along) {
        for (const OpeningPoint& y : across) {
            points.push_back({{x.u.x, y.u.x}, x.weight * y.weight});
        }
    }
    return points;
}

OpeningPart part_of(const LuminousOpening& whole, unsigned part) {
    OpeningPart result{whole.middle, whole};
    if (whole.shape == LuminousOpening::Shape::point) {
        return result;
    }
    const glm::dvec2 side((part & 1U) != 0 ? 1.0 : -1.0, (part & 2U) != 0 ? 1.0 : -1.0);
    // Of a square of side 2: four points, one a quarter, at four places along either side.
    const glm::dvec2 place =
        side.x == side.y ? glm::dvec2(0.25, 0.75) * side : glm::dvec2(0.75, 0.25) * side;
    if (whole.shape == LuminousOpening::Shape::rectangle) {
        result.seen_from += whole.half * place;
        result.opening.half = 0.5 * whole.half;
        result.opening.middle += 0.5 * whole.half * side;
    } else {
        // The square with the second moments of a disc of radius 1 has half sides of sqrt(3)/2.
        result.seen_from += 0.5 * std::sqrt(3.0) * whole.half * place;
        result.opening.shape = LuminousOpening::Shape::quarter;
        result.opening.half = whole.half * side;
    }
    result.opening.middle -= result.seen_from;
    return result;
}

}  // namespace raybundle
