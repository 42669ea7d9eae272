// SPDX-License-Identifier: Apache-2.0
// Irradiance by triangles: closed forms of rectangles (R. Siegel, J. Howell, "Thermal Radiation
// Heat Transfer", configuration factors of a differential element).
#include "scene/mesh/triangle_irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace raybundle {
namespace {

using std::numbers::pi;

double by_rectangle(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
                    const glm::dvec3& point, const glm::dvec3& normal) {
    return triangle_irradiance({corner, corner + u, corner + u + v}, point, normal) +
           triangle_irradiance({corner, corner + u + v, corner + v}, point, normal);
}

/// Of a parallel rectangle of a x b at distance 1, above whose corner the element is.
double parallel_factor(double a, double b) {
    const double ra = std::hypot(1.0, a);
    const double rb = std::hypot(1.0, b);
    return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2.0 * pi);
}

/// Of an upright rectangle at distance 1 that stands on the element's plane, `width` to one side
/// and `height` upwards.
double upright_factor(double width, double height) {
    const double slope = std::hypot(1.0, height);
    return (std::atan(width) - std::atan(width / slope) / slope) / (2.0 * pi);
}

TEST(TriangleIrradiance, OfParallelRectangles) {
    const glm::dvec3 point(0.3, 0.2, -0.5);
    const glm::dvec3 up(0, 1, 0);
    for (const double a : {0.01, 1.0, 30.0}) {
        for (const double b : {0.2, 5.0}) {
            const double exact = pi * parallel_factor(a, b);
            EXPECT_NEAR(by_rectangle(point + up, {a, 0, 0}, {0, 0, b}, point, up), exact,
                        1e-12 * pi);
            EXPECT_NEAR(by_rectangle(point + up, {0, 0, b}, {a, 0, 0}, point, up), exact,
                        1e-12 * pi);
        }
    }
}

TEST(TriangleIrradiance, BelowTheHorizonIsCutOff) {
    const glm::dvec3 point(0.0);
    const glm::dvec3 up(0, 0, 1);
    for (const double height : {0.1, 1.0, 8.0}) {
        const double exact = pi * upright_factor(2.0, height);
        for (const double below : {0.0, 0.3, 20.0}) {
            EXPECT_NEAR(by_rectangle({1, 0, -below}, {0, 2, 0}, {0, 0, height + below}, point, up),
                        exact, 1e-12 * pi)
                << height << " " << below;
        }
    }
    EXPECT_EQ(by_rectangle({1, 0, -2}, {0, 2, 0}, {0, 0, 1}, point, up), 0.0);
}

TEST(TriangleIrradiance, OfAHemisphereIsPi) {
    const glm::dvec3 up(0, 1, 0);
    EXPECT_NEAR(by_rectangle({-1e9, 1, -1e9}, {2e9, 0, 0}, {0, 0, 2e9}, glm::dvec3(0.0), up), pi,
                1e-8);
    // A finite triangle that all but touches.
    EXPECT_NEAR(triangle_irradiance({glm::dvec3(-1, 1e-9, -1), {2, 1e-9, 0}, {-1, 1e-9, 1}},
                                    glm::dvec3(0.0), up),
                pi, 1e-8);
}

TEST(TriangleIrradiance, WithoutAnAreaIsNone) {
    const glm::dvec3 corner(0.3, 1, 0.2);
    EXPECT_EQ(triangle_irradiance({corner, corner, corner}, glm::dvec3(0.0), {0, 1, 0}), 0.0);
}

}  // namespace
}  // namespace raybundle
