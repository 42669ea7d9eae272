// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry/luminous_opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../reference/luminous_panel.h"

namespace raybundle {
namespace {

using std::numbers::pi;

/// Of a function over an opening, by its points at u in a grid.
template <class Value>
double mean_over(const LuminousOpening& opening, const Value& value) {
    constexpr int n = 200;
    double sum = 0.0;
    for (int i = 0; i < n * n; ++i) {
        sum += value(opening.at((glm::dvec2(i % n, i / n) + 0.5) / double{n}));
    }
    return sum / (n * n);
}

LuminousOpening opening(LuminousOpening::Shape shape) {
    LuminousOpening result;
    result.shape = shape;
    result.half = {0.3, 0.2};
    return result;
}

TEST(LuminousOpening, PointsLieEvenly) {
    const auto x2 = [](const glm::dvec2& p) { return p.x * p.x; };
    const auto y2 = [](const glm::dvec2& p) { return p.y * p.y; };
    const auto x = [](const glm::dvec2& p) { return p.x; };
    const LuminousOpening rectangle = opening(LuminousOpening::Shape::rectangle);
    EXPECT_NEAR(mean_over(rectangle, x), 0.0, 1e-12);
    EXPECT_NEAR(mean_over(rectangle, x2), 0.09 / 3.0, 1e-5);
    const LuminousOpening ellipse = opening(LuminousOpening::Shape::ellipse);
    EXPECT_NEAR(mean_over(ellipse, x), 0.0, 1e-12);
    EXPECT_NEAR(mean_over(ellipse, x2), 0.09 / 4.0, 1e-5);
    EXPECT_NEAR(mean_over(ellipse, y2), 0.04 / 4.0, 1e-5);
}

/// The quarters are the whole, and the places that their shadows are cast from have its moments.
TEST(LuminousOpening, QuartersAreTheWhole) {
    for (const auto shape : {LuminousOpening::Shape::rectangle, LuminousOpening::Shape::ellipse}) {
        const LuminousOpening whole = opening(shape);
        const auto value = [](const glm::dvec2& p) { return std::exp(p.x + 3.0 * p.y * p.y); };
        const double exact = mean_over(whole, value);
        double sum = 0.0;
        glm::dvec2 middle(0.0);
        glm::dvec2 squares(0.0);
        for (unsigned i = 0; i < LuminousOpening::parts; ++i) {
            const OpeningPart part = part_of(whole, i);
            sum += 0.25 * mean_over(part.opening,
                                    [&](const glm::dvec2& p) { return value(part.seen_from + p); });
            middle += part.seen_from;
            squares += 0.25 * part.seen_from * part.seen_from;
        }
        EXPECT_NEAR(sum, exact, 1e-4 * exact);
        EXPECT_LT(glm::length(middle), 1e-12);
        const double moment = shape == LuminousOpening::Shape::rectangle ? 1.0 / 3.0 : 0.25;
        EXPECT_NEAR(squares.x / (whole.half.x * whole.half.x), moment, 0.0626 * moment);
        EXPECT_NEAR(squares.y / (whole.half.y * whole.half.y), moment, 0.0626 * moment);
    }
}

/// A Lambert panel above a point: pi L C of each quarter of it (photometry: rectangle above its
/// corner), and of a disc pi L R²/(R² + h²).
TEST(LuminousOpening, QuadratureIsAsGoodAsIsAskedFor) {
    for (const double height : {0.3, 1.0, 3.0}) {
        const auto lambert = [&](const glm::dvec2& p) {  // of intensity 1 straight down
            const double square = glm::dot(p, p) + height * height;
            return height * height / (square * square);
        };
        const auto found = [&](const LuminousOpening& shape) {
            double sum = 0.0;
            for (const OpeningPoint& point : opening_points(shape, height, 1e-4)) {
                sum += point.weight * lambert(shape.at(point.u));
            }
            return sum;
        };
        const LuminousOpening rectangle = opening(LuminousOpening::Shape::rectangle);
        const double a = rectangle.half.x / height;
        const double b = rectangle.half.y / height;
        const double p = std::sqrt(1.0 + a * a);
        const double q = std::sqrt(1.0 + b * b);
        const double corner = (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * pi);
        const double exact = pi * 4.0 * corner / (4.0 * rectangle.half.x * rectangle.half.y);
        EXPECT_NEAR(found(rectangle), exact, 1e-4 * exact) << height;
        LuminousOpening disc = opening(LuminousOpening::Shape::ellipse);
        disc.half.y = disc.half.x;
        const double square = disc.half.x * disc.half.x;
        const double exact_disc = 1.0 / (square + height * height);
        EXPECT_NEAR(found(disc), exact_disc, 1e-4 * exact_disc) << height;
    }
}

/// An elongated file's length lies across C0, and a file without a size is a point.
TEST(LuminousOpening, IsThatOfTheFile) {
    const LuminousOpening panel = opening_of(panel_profile(0.3, 1.2).get());
    EXPECT_EQ(panel.shape, LuminousOpening::Shape::rectangle);
    EXPECT_NEAR(panel.half.x, 0.15, 1e-12);
    EXPECT_NEAR(panel.half.y, 0.6, 1e-12);
    EXPECT_EQ(opening_of(panel_profile(0.6, 0.0).get()).shape, LuminousOpening::Shape::ellipse);
    EXPECT_EQ(opening_of(nullptr).shape, LuminousOpening::Shape::point);
    PunctualLight light = panel_light({{1, 2, 3}, {0, -1, 0}, 0.0F}, 0.0, 0.0);
    const PlacedLight placed = place_light(light, glm::mat4(1.0F));
    EXPECT_FALSE(placed.has_opening());
    EXPECT_EQ(placed.point({0.1, 0.9}), placed.position);
}

/// 1 of a Lambert surface, m/sqrt(2m - 1) of cos^m.
TEST(LuminousOpening, SteeperDistributionsAreToldSo) {
    const auto steepness = [](int power) {
        IesProfile::Data data;
        data.horizontal = {0.0};
        for (int degrees = 0; degrees <= 90; ++degrees) {
            data.vertical.push_back(degrees);
            data.candela.push_back(
                std::pow(std::max(std::cos(glm::radians(1.0 * degrees)), 0.0), power));
        }
        return IesProfile(data).steepness();
    };
    EXPECT_NEAR(steepness(1), 1.0, 0.01);
    EXPECT_NEAR(steepness(20), 20.0 / std::sqrt(39.0), 0.02 * 20.0 / std::sqrt(39.0));
}

}  // namespace
}  // namespace raybundle
