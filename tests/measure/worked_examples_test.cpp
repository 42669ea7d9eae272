// SPDX-License-Identifier: Apache-2.0
// The rooms of docs/examples against what is worked out there by hand: direct light exactly, light
// in all by the lumen method within its tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "measure/point_measurement.h"
#include "measure/work_plane.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

using std::numbers::pi;

constexpr double peak = 1600.0;  // cd, of panel.ies
constexpr double flux = pi * peak;
constexpr double panel_height = 2.75;
constexpr double panel_size = 0.6;
constexpr double plane_height = 0.75;
constexpr double above_plane = panel_height - plane_height;

/// What the page of an example says of its room.
struct Room {
    const char* file;
    double length, width, height;  ///< along x, z and y, m
    std::vector<double> xs, zs;    ///< of the panels

    [[nodiscard]] double area() const { return length * width; }
    [[nodiscard]] double panels() const { return static_cast<double>(xs.size() * zs.size()); }
};

Room office() {
    return {"office", 6.0, 5.0, 2.8, {1.0, 3.0, 5.0}, {1.25, 3.75}};
}

Room classroom() {
    return {"classroom", 9.0, 6.0, 3.0, {1.5, 4.5, 7.5}, {1.0, 3.0, 5.0}};
}

/// The file, measured.
class Example {
  public:
    explicit Example(const std::string& name)
        : scene_(load_gltf(RAYBUNDLE_SCENES "/examples/" + name + ".gltf")),
          mesh_(tessellate(scene_, {.patch_size = 1.0F})),  // no light is kept there
          measured_(std::make_shared<const MeasuredScene>(scene_, mesh_)) {}

    [[nodiscard]] PointMeasurement measure(std::vector<CalculationPoint> points,
                                           MeasurementSettings settings) const {
        PointMeasurement result(measured_, std::move(points), settings);
        for (std::uint64_t i = 0; i < PointMeasurement::least_rounds; ++i) {
            result.add_round();
        }
        return result;
    }
    [[nodiscard]] double direct_at(Quantity quantity, const CalculationPoint& point) const {
        return measure({point}, {quantity, true}).values()[0].value;
    }
    [[nodiscard]] double mean_over(const Room& room, const GridSize& grid, bool direct) const {
        const MeasuredArea area = plane_of(room);
        std::vector<CalculationPoint> points;
        for (const glm::dvec3& place : points_of(area, grid)) {
            points.push_back({place, {0.0, 1.0, 0.0}});
        }
        return measure(std::move(points), {Quantity::horizontal, direct}).summary().mean.value;
    }
    static MeasuredArea plane_of(const Room& room) {
        return {{0.0, plane_height, 0.0}, {room.length, 0.0, 0.0}, {0.0, 0.0, room.width}};
    }

  private:
    Scene scene_;
    PatchMesh mesh_;
    std::shared_ptr<const MeasuredScene> measured_;
};

/// Sum over the panels of I/d² times the share that a receiver takes, I = peak h/d: from their
/// offsets.
template <class Share>
double by_inverse_square(const Room& room, const glm::dvec3& point, const Share& share) {
    double sum = 0.0;
    for (const double z : room.zs) {
        for (const double x : room.xs) {
            const glm::dvec3 to = glm::dvec3(x, panel_height, z) - point;
            const double square = glm::dot(to, to);
            sum += peak * (to.y / std::sqrt(square)) / square * share(to / std::sqrt(square));
        }
    }
    return sum;
}

/// The same of panels that shine from their area: the mean over its points.
template <class Share>
double by_area(const Room& room, const glm::dvec3& point, const Share& share) {
    constexpr int n = 100;
    double sum = 0.0;
    for (int i = 0; i < n * n; ++i) {
        const glm::dvec2 aside = panel_size * ((glm::dvec2(i % n, i / n) + 0.5) / double{n} - 0.5);
        sum += by_inverse_square(room, point - glm::dvec3(aside.x, 0.0, aside.y), share);
    }
    return sum / (n * n);
}

/// Share of a panel's flux that falls on a rectangle whose corner is below it, of the sides a and b
/// at the distance of the plane.
double corner_share(double a, double b) {
    const double A = a / above_plane;
    const double B = b / above_plane;
    const double p = std::sqrt(1.0 + A * A);
    const double q = std::sqrt(1.0 + B * B);
    return (A / p * std::atan(B / p) + B / q * std::atan(A / q)) / (2.0 * pi);
}

/// Straight lines over the table's steps of a degree lie below the cosine by at most 1/8 of their
/// square; the table has six digits.
void expect_direct(double found, double exact) {
    const double step = pi / 180.0;
    EXPECT_LT(found, exact * (1.0 + 1e-5));
    EXPECT_GT(found, exact * (1.0 - step * step / 8.0 - 1e-5));
}

void expect_direct_on_plane(const Room& room, const std::vector<glm::dvec2>& places) {
    const Example example(room.file);
    for (const glm::dvec2& at : places) {
        const glm::dvec3 point(at.x, plane_height, at.y);
        expect_direct(example.direct_at(Quantity::horizontal, {point, {}}),
                      by_area(room, point, [](const glm::dvec3& w) { return w.y; }));
    }
}

TEST(WorkedExamples, DirectLightInTheOfficeIsThatOfThePanelsArea) {
    expect_direct_on_plane(office(), {{3.0, 2.5}, {1.0, 1.25}, {0.5, 0.5}});
}

/// As the page has it: 6400 (4/9.5625² + 2/5.5625²).
TEST(WorkedExamples, ThePagesFormulaIsThatOfTheTest) {
    const double middle = 6400.0 * (4.0 / (9.5625 * 9.5625) + 2.0 / (5.5625 * 5.5625));
    EXPECT_NEAR(by_inverse_square(office(), {3.0, plane_height, 2.5},
                                  [](const glm::dvec3& w) { return w.y; }),
                middle, 1e-9 * middle);
    EXPECT_NEAR(middle, 693.6, 0.05);
    // Straight below one: pi L of a rectangle's four quarters, each above its corner.
    const double luminance = peak / (panel_size * panel_size);
    const double below = pi * luminance * 4.0 * corner_share(panel_size / 2, panel_size / 2);
    EXPECT_NEAR(below, 388.4, 0.05);
}

TEST(WorkedExamples, DirectLightInTheClassroomIsThatOfThePanelsArea) {
    expect_direct_on_plane(classroom(), {{4.5, 3.0}, {3.0, 2.0}});
    const Example example("classroom");
    const glm::dvec3 board(0.05, 1.5, 3.0);
    expect_direct(
        example.direct_at(Quantity::vertical, {board, {1.0, 0.0, 0.0}}),
        by_area(classroom(), board, [](const glm::dvec3& w) { return std::max(w.x, 0.0); }));
    const glm::dvec3 seat(6.0, 1.2, 3.0);
    expect_direct(example.direct_at(Quantity::cylindrical, {seat, {}}),
                  by_area(classroom(), seat,
                          [](const glm::dvec3& w) { return std::sqrt(1.0 - w.y * w.y) / pi; }));
}

/// Of all panels' flux, what falls on the work plane: each point of a panel sees four quarters of
/// it.
double direct_share(const Room& room) {
    constexpr int n = 20;
    double sum = 0.0;
    for (const double x : room.xs) {
        for (const double z : room.zs) {
            for (int i = 0; i < n * n; ++i) {
                const double a = x + panel_size * ((i % n + 0.5) / n - 0.5);
                const double b = z + panel_size * ((i / n + 0.5) / n - 0.5);
                sum += corner_share(a, b) + corner_share(room.length - a, b) +
                       corner_share(a, room.width - b) +
                       corner_share(room.length - a, room.width - b);
            }
        }
    }
    return sum / (n * n * room.panels());
}

/// Reflectance of the opening of a cavity, A (m²), whose bottom has `bottom` and whose sides, of
/// `sides` m², have `side`.
double of_cavity(double opening, double bottom, double sides, double side) {
    const double inside = opening + sides;
    const double mean = (opening * bottom + sides * side) / inside;
    return mean * opening / (inside - mean * (inside - opening));
}

/// What comes back from the surfaces, as if it were the same everywhere (Ulbricht's sphere) between
/// the work plane and the panels: the flux after one reflection over S (1 - rho). What is above and
/// below are cavities.
double reflected(const Room& room, double share) {
    constexpr double walls = 0.5;
    const double around = 2.0 * (room.length + room.width);
    const double ceiling =
        of_cavity(room.area(), 0.7, around * (room.height - panel_height), walls);
    const double floor = of_cavity(room.area(), 0.2, around * plane_height, walls);
    const double sides = around * above_plane;
    const double all = 2.0 * room.area() + sides;
    const double mean = (room.area() * (ceiling + floor) + sides * walls) / all;
    const double once = room.panels() * flux * (share * floor + (1.0 - share) * walls);
    return once / (all * (1.0 - mean));
}

class WorkedExample : public testing::TestWithParam<Room> {};

TEST_P(WorkedExample, TheLumenMethodHolds) {
    const Room& room = GetParam();
    const Example example(room.file);
    const double share = direct_share(room);
    const double direct = room.panels() * flux * share / room.area();

    // The mean over a grid of some 0.1 m is that over the plane within 1e-3.
    constexpr std::uint32_t most_points = PointMeasurement::most_points;
    const auto columns = static_cast<std::uint32_t>(10.0 * room.length);
    const GridSize fine = {columns, most_points / columns};
    EXPECT_NEAR(example.mean_over(room, fine, true), direct, 1e-3 * direct);

    // The pages' tolerance: a tenth of what is reflected.
    const GridSize grid = en12464_grid(Example::plane_of(room));
    const double total = example.mean_over(room, grid, false);
    const double found = total - example.mean_over(room, grid, true);
    const double by_hand = reflected(room, share);
    EXPECT_NEAR(found, by_hand, 0.1 * by_hand);
    EXPECT_NEAR(total, direct + by_hand, 0.1 * by_hand);
}

INSTANTIATE_TEST_SUITE_P(Rooms, WorkedExample, testing::Values(office(), classroom()),
                         [](const auto& room) { return std::string(room.param.file); });

}  // namespace
}  // namespace raybundle
