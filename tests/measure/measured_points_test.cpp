// SPDX-License-Identifier: Apache-2.0
// Calculation points in the air against closed forms. Bounds of random results are 4.5 standard
// errors, passed by chance once in 150 000; each test also bounds the standard error.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lit_room.h"
#include "luminous_panel.h"
#include "measure/daylight_scene.h"
#include "measure/point_measurement.h"
#include "measure/requirement.h"
#include "measure/work_plane.h"
#include "measure/zone_area.h"
#include "rooms.h"

namespace raybundle {
namespace {

using std::numbers::pi;

constexpr Quantity all_quantities[] = {Quantity::horizontal,      Quantity::vertical,
                                       Quantity::normal,          Quantity::cylindrical,
                                       Quantity::semicylindrical, Quantity::daylight_factor};

/// Something that is in nobody's way.
void add_speck(SceneBuilder& builder, const glm::vec3& at) {
    builder.add_triangle(at, at + glm::vec3(1e-3F, 0, 0), at + glm::vec3(0, 0, 1e-3F),
                         builder.add_material(glm::vec3(0.0F)));
}

/// Sets the bounds that rays need of a scene without a file.
SceneBuilder& sized(SceneBuilder& builder) {
    add_speck(builder, {-10, -10, -10});
    add_speck(builder, {10, 10, 10});
    return builder;
}

struct Measured {
    double value = 0.0;
    double error = 0.0;  ///< standard error
};

Measured measure_at(const SceneBuilder& builder, Quantity quantity, const glm::dvec3& position,
                    const glm::dvec3& direction, int rounds, bool direct = false) {
    const auto scene = std::make_shared<const MeasuredScene>(builder.scene, builder.mesh);
    PointMeasurement points(scene, {{position, direction}}, {quantity, direct, 1.0, 7});
    for (int i = 0; i < rounds; ++i) {
        points.add_round();
    }
    const Interval found = points.values()[0];
    return {found.value,
            (found.high - found.value) / student_quantile(0.975, PointMeasurement::batches - 1)};
}

void expect_exact(const Measured& found, double exact, double relative_error) {
    EXPECT_NEAR(found.value, exact, sigmas * found.error + 1e-6 * exact);
    EXPECT_LT(found.error, relative_error * exact);
}

/// A sphere of luminance L: pi L whatever the receiver. Every sample is exact.
TEST(MeasuredPoints, UniformSphereGivesPiTimesItsLuminance) {
    SceneBuilder builder;
    sized(builder).scene.sky_radiance = glm::vec3(120.0F);
    for (const Quantity quantity : all_quantities) {
        const Measured found = measure_at(builder, quantity, {0.3, 0.7, -0.2}, {1, 2, 3}, 1);
        EXPECT_NEAR(found.value, pi * 120.0, 1e-4) << name_of(quantity);
    }
}

/// A point source of 500 cd: I cos/d^2, I sin/(pi d^2), I (1 + cos alpha) sin/(pi d^2); exact.
TEST(MeasuredPoints, PointSourceFollowsTheInverseSquare) {
    SceneBuilder builder;
    add_punctual_light(sized(builder), glm::mat4(1.0F), PunctualKind::point, {1, 3, 2}, {0, -1, 0},
                       glm::vec3(500.0F));
    const glm::dvec3 to(1.0, 2.25, 2.0);  // from (0, 0.75, 0)
    const double square = glm::dot(to, to);
    const glm::dvec3 w = glm::normalize(to);
    const double sine = std::sqrt(1.0 - w.y * w.y);
    const glm::dvec3 n = glm::normalize(glm::dvec3(1, 1, 0));
    const double exact[] = {w.y, w.x, glm::dot(w, n), sine / pi, (sine + w.x) / pi, w.y};
    const glm::dvec3 directions[] = {{0, 0, 0}, {1, 0.4, 0}, n, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    for (std::size_t i = 0; i < std::size(all_quantities); ++i) {
        const Measured found =
            measure_at(builder, all_quantities[i], {0, 0.75, 0}, directions[i], 1);
        EXPECT_NEAR(found.value, 500.0 * exact[i] / square, 1e-4) << name_of(all_quantities[i]);
    }
}

/// A square of 2 m at height h over the point below its corner: CIE 171:2006, 5.3 and 5.6.
SceneBuilder luminous_ceiling() {
    SceneBuilder builder;
    const std::uint32_t lamp = builder.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    sized(builder).add_quad({0, 3, 0}, {2, 0, 0}, {0, 0, 1.5F}, 6, 4, lamp);
    return builder;
}

TEST(MeasuredPoints, RectangleLightsAParallelPlane) {
    const double a = 2.0 / 2.25;
    const double b = 1.5 / 2.25;
    const double ra = std::sqrt(1.0 + a * a);
    const double rb = std::sqrt(1.0 + b * b);
    const double share = (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2.0 * pi);
    expect_exact(measure_at(luminous_ceiling(), Quantity::horizontal, {0, 0.75, 0}, {}, 400),
                 pi * 1000.0 * share, 0.001);
}

/// Facing the far edge: w along the line of intersection 1.5, d = 2.25, h = 2.
TEST(MeasuredPoints, RectangleLightsAPerpendicularPlane) {
    const double r = std::hypot(2.25, 2.0);
    const double share = (std::atan(1.5 / 2.25) - 2.25 / r * std::atan(1.5 / r)) / (2.0 * pi);
    expect_exact(measure_at(luminous_ceiling(), Quantity::vertical, {0, 0.75, 0}, {1, 0, 0}, 400),
                 pi * 1000.0 * share, 0.002);
}

/// Sum over small pieces of the rectangle: (1/pi) int L (1 + c cos alpha) sin cos_s/d^2 dA.
double rectangle_on_cylinder(double half) {
    constexpr int n = 400;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 to(2.0 * (i + 0.5) / n, 2.25, 1.5 * (j + 0.5) / n);
            const double square = glm::dot(to, to);
            const glm::dvec3 w = to / std::sqrt(square);
            const double sine = std::sqrt(1.0 - w.y * w.y);
            sum += (sine + half * w.x) * w.y / square;
        }
    }
    return 1000.0 / pi * sum * 3.0 / (double{n} * n);
}

TEST(MeasuredPoints, RectangleLightsCylinders) {
    expect_exact(measure_at(luminous_ceiling(), Quantity::cylindrical, {0, 0.75, 0}, {}, 400),
                 rectangle_on_cylinder(0.0), 0.002);
    expect_exact(
        measure_at(luminous_ceiling(), Quantity::semicylindrical, {0, 0.75, 0}, {1, 0, 0}, 400),
        rectangle_on_cylinder(1.0), 0.002);
}

/// A panel of 0.6 m x 0.6 m with a EULUMDAT file: the sum over its area, without noise.
TEST(MeasuredPoints, PanelIsAnArea) {
    for (const double height : {0.3, 1.0, 3.0}) {
        SceneBuilder builder;
        sized(builder).scene.punctual_lights.push_back(panel_light(
            {{0.1F, 0.75F + static_cast<float>(height), 0}, {0, -1, 0}, 30.0F}, 0.6, 0.6));
        const glm::dvec3 point(0.0, 0.75, 0.0);
        const double exact =
            panel_illuminance(builder.scene.punctual_lights[0], 0.6, 0.6, point, {0.0, 1.0, 0.0});
        const Measured found = measure_at(builder, Quantity::horizontal, point, {}, 1);
        EXPECT_NEAR(found.value, exact, 1.5e-3 * exact) << height;  // 1e-3 is the table's
        EXPECT_LT(found.error, 1e-6 * exact);
    }
}

/// The edge of a screen half way up: a Fibonacci lattice knows the share that is seen.
TEST(MeasuredPoints, ScreenHidesAPartOfAPanel) {
    SceneBuilder builder;
    const auto black = sized(builder).add_material(glm::vec3(0.0F));
    builder.add_quad({-4, 1.75F, -4}, {0, 0, 8}, {4, 0, 0}, 1, 1, black);
    builder.scene.punctual_lights.push_back(
        panel_light({{0, 2.75F, 0}, {0, -1, 0}, 10.0F}, 0.6, 0.6));
    for (const double x : {-0.2, -0.05, 0.0, 0.1, 0.25}) {
        const glm::dvec3 point(x, 0.75, 0.1);
        const auto illuminance = [&](const auto& sees) {
            return panel_illuminance(builder.scene.punctual_lights[0], 0.6, 0.6, point,
                                     {0.0, 1.0, 0.0}, 400, sees);
        };
        const double free = illuminance([](const glm::dvec3&) { return true; });
        const double exact =
            illuminance([&](const glm::dvec3& place) { return 0.5 * (place.x + x) > 0.0; });
        const Measured found = measure_at(builder, Quantity::horizontal, point, {}, 1, true);
        EXPECT_NEAR(found.value, exact, 5e-3 * free) << x;
    }
}

/// A black screen hides half of the rectangle: the difference of two of them.
TEST(MeasuredPoints, AScreenHidesWhatLiesBehindIt) {
    SceneBuilder builder = luminous_ceiling();
    Material black;
    black.base_colour = glm::vec3(0.0F);
    black.double_sided = true;
    // Half way up, from x = 0.5 on: rays to x > 1 pass it.
    builder.add_quad({0.5F, 1.875F, -1}, {0, 0, 4}, {4, 0, 0}, 1, 1, builder.add_material(black));
    const double a = 1.0 / 2.25;
    const double b = 1.5 / 2.25;
    const double ra = std::sqrt(1.0 + a * a);
    const double rb = std::sqrt(1.0 + b * b);
    const double share = (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2.0 * pi);
    expect_exact(measure_at(builder, Quantity::horizontal, {0, 0.75, 0}, {}, 400),
                 pi * 1000.0 * share, 0.003);
}

/// Every direction brings Le/(1 - albedo), be it by many reflections.
TEST(MeasuredPoints, FurnaceIsTheSameForEveryReceiver) {
    const SceneBuilder room = furnace_room(0.7F, 100.0F);
    const glm::dvec3 inside = odd_rotation() * glm::vec4(0.6F, 0.4F, 0.5F, 1.0F);
    for (const Quantity quantity : all_quantities) {
        expect_exact(measure_at(room, quantity, inside, {1, 2, 3}, 1000), pi * 100.0 / 0.3, 0.004);
    }
}

TEST(MeasuredPoints, DirectLightLeavesReflectionsOut) {
    const SceneBuilder room = furnace_room(0.7F, 100.0F);
    const glm::dvec3 inside = odd_rotation() * glm::vec4(0.6F, 0.4F, 0.5F, 1.0F);
    expect_exact(measure_at(room, Quantity::cylindrical, inside, {}, 2000, true), pi * 100.0,
                 0.002);
}

/// Without anything in the way the daylight factor is 100 %, lamps and suns or not; the ground
/// lights cylinders from below: Ez = (2 Lz/3)(pi/4 + 2/3) + pi L_ground/2.
TEST(MeasuredPoints, OpenOvercastSkyHasADaylightFactorOfHundred) {
    SceneBuilder builder = luminous_ceiling();
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::directional, {}, {0, -1, 0},
                       glm::vec3(50'000.0F));
    leave_overcast_sky(builder.scene, builder.mesh);
    const glm::dvec3 above(0.0, 5.0, 0.0);
    const auto scene = std::make_shared<const MeasuredScene>(builder.scene, builder.mesh);
    PointMeasurement points(scene, {{above, {}}},
                            {Quantity::daylight_factor, false, 100.0 / overcast_illuminance, 3});
    for (int i = 0; i < 200; ++i) {
        points.add_round();
    }
    EXPECT_NEAR(points.values()[0].value, 100.0, 0.1);
    EXPECT_LT(points.values()[0].low, points.values()[0].value);
    const double zenith = overcast_illuminance * 9.0 / (7.0 * pi);
    const double ground = 0.2 * overcast_illuminance / pi;
    SceneBuilder open;
    sized(open);
    leave_overcast_sky(open.scene, open.mesh);
    expect_exact(measure_at(open, Quantity::cylindrical, above, {}, 200),
                 2.0 * zenith / 3.0 * (pi / 4.0 + 2.0 / 3.0) + pi * ground / 2.0, 0.002);
}

/// Sunlight through a window pane: the share that a slab of two faces passes, also after it has
/// been reflected by the floor.
TEST(MeasuredPoints, PunctualLightComesThroughPanes) {
    SceneBuilder builder;
    sized(builder);
    Material glass;
    glass.base_colour = glm::vec3(1.0F);
    glass.metallic = 0.0F;
    glass.roughness = 0.0F;
    glass.transmission = 1.0F;
    glass.double_sided = true;
    builder.add_quad({-4, 2, -4}, {0, 0, 8}, {8, 0, 0}, 2, 2, builder.add_material(glass));
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::directional, {}, {0, -1, 0},
                       glm::vec3(1000.0F));
    const double r = 0.04;  // of one face, index 1.5
    const double share = (1.0 - r) / (1.0 + r);
    const Measured found = measure_at(builder, Quantity::horizontal, {0, 1, 0}, {}, 1);
    EXPECT_NEAR(found.value, 1000.0 * share, 0.01);
    EXPECT_NEAR(measure_at(builder, Quantity::horizontal, {0, 3, 0}, {}, 1).value, 1000.0, 0.01);
}

TEST(MeasuredPoints, APointInASolidIsNotMeasured) {
    SceneBuilder builder = enclosure(0.5F);
    builder.set_transform(odd_rotation());
    builder.add_box({1, 1, 1}, {2, 2, 2}, false, 2, builder.add_material(glm::vec3(0.5F)));
    const auto scene = std::make_shared<const MeasuredScene>(builder.scene, builder.mesh);
    const auto at = [](const glm::vec3& p) {
        return CalculationPoint{glm::dvec3(odd_rotation() * glm::vec4(p, 1.0F)), {}};
    };
    PointMeasurement points(scene, {at({1.5F, 1.5F, 1.5F}), at({0.5F, 0.5F, 0.5F})}, {});
    EXPECT_TRUE(points.inside(0));
    EXPECT_FALSE(points.inside(1));
    EXPECT_EQ(points.measured(), 1U);
    points.add_round();
    EXPECT_EQ(points.values()[0].value, 0.0);
    EXPECT_GT(points.summary().minimum.value, 0.0);
    EXPECT_EQ(points.summary().uniformity.value, 1.0);
}

/// A lamp 2 m above a floor: on the floor, within a board of 20 mm, and just below the floor.
TEST(MeasuredPoints, APointOnASurfaceHasTheLightOfItsFront) {
    SceneBuilder builder;
    const std::uint32_t black = builder.add_material(glm::vec3(0.0F));
    sized(builder).add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, 4, 4, black);
    builder.add_box({1.5F, 0.7F, -0.5F}, {2.5F, 0.72F, 0.5F}, false, 1, black);
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::point, {0, 2, 0}, {0, -1, 0},
                       glm::vec3(500.0F));
    const auto exact = [](double x, double y) {
        const double h = 2.0 - y;
        return 500.0 * h / std::pow(x * x + h * h, 1.5);
    };
    for (const double below : {0.0, 1e-6, 5e-4, -5e-4}) {
        const auto measured = [&](Quantity quantity, double x, double y) {
            return measure_at(builder, quantity, {x, y - below, 0.3}, {0, 1, 0}, 1).value;
        };
        SCOPED_TRACE(below);
        const double lux = exact(std::hypot(0.5, 0.3), 0.0);
        EXPECT_NEAR(measured(Quantity::horizontal, 0.5, 0.0), lux, 2e-3 * lux);
        EXPECT_NEAR(measured(Quantity::normal, 0.5, 0.0), lux, 2e-3 * lux);
        EXPECT_GT(measured(Quantity::cylindrical, 0.5, 0.0), 1.0);
        const double board = exact(std::hypot(2.0, 0.3), 0.72);
        EXPECT_NEAR(measured(Quantity::horizontal, 2.0, 0.72), board, 2e-3 * board);
    }
    // What is under the board stays there, and what is well below the floor, too.
    EXPECT_EQ(measure_at(builder, Quantity::horizontal, {2, 0.69, 0}, {}, 1).value, 0.0);
    EXPECT_EQ(measure_at(builder, Quantity::horizontal, {0.5, -0.01, 0}, {}, 1).value, 0.0);
}

/// The same seed gives the same bits, in whatever slices.
TEST(MeasuredPoints, SlicesDoNotMatter) {
    const SceneBuilder room = enclosure(0.5F);
    const auto scene = std::make_shared<const MeasuredScene>(room.scene, room.mesh);
    std::vector<CalculationPoint> places;
    for (int i = 0; i < 7; ++i) {
        places.push_back({{0.1 * i, 0.2, 0.1}, {}});
    }
    PointMeasurement whole(scene, places, {});
    PointMeasurement sliced(scene, places, {});
    for (int i = 0; i < 3; ++i) {
        whole.add_round();
    }
    for (int i = 0; i < 21; i += 3) {
        sliced.add_samples(3);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(whole.values()[i].value, sliced.values()[i].value);
        EXPECT_EQ(whole.values()[i].high, sliced.values()[i].high);
    }
}

/// EN 12464-1, annex: 5 m x 5 m have a spacing of at most 0.62 m, long corridors that of their
/// width.
TEST(WorkPlane, GridsFollowTheStandard) {
    EXPECT_NEAR(en12464_spacing(10.0, 8.0), 1.0, 1e-12);
    EXPECT_NEAR(en12464_spacing(1.0, 1.0), 0.2, 1e-12);
    EXPECT_NEAR(en12464_spacing(20.0, 2.0), 0.2 * std::pow(5.0, std::log10(2.0)), 1e-12);
    EXPECT_EQ(en12464_spacing(5000.0, 5000.0), 10.0);
    const MeasuredArea area{{1, 0.75, 1}, {10, 0, 0}, {0, 0, 8}};
    const GridSize grid = en12464_grid(area);
    EXPECT_EQ(grid.columns, 10U);
    EXPECT_EQ(grid.rows, 8U);
    const std::vector<glm::dvec3> points = points_of(area, grid);
    ASSERT_EQ(points.size(), 80U);
    EXPECT_NEAR(points[0].x, 1.5, 1e-12);
    EXPECT_NEAR(points[11].z, 2.5, 1e-12);
}

TEST(ZoneArea, KeepsMarginsAndStripsAroundPolygons) {
    // An L of 4 m x 4 m without a corner of 2 m x 2 m.
    const std::vector<glm::dvec3> l_shape = {{0, 1, 0}, {4, 1, 0}, {4, 1, 2},
                                             {2, 1, 2}, {2, 1, 4}, {0, 1, 4}};
    EXPECT_EQ(outline_problem(l_shape), "");
    const ZoneGrid whole = lay_grid({l_shape, 0.0, 0.0}, {8, 8}, 4096);
    EXPECT_EQ(whole.points.size(), 48U);
    const ZoneGrid inner = lay_grid({l_shape, 0.5, 0.0}, {30, 30}, 4096);
    for (const glm::dvec3& p : inner.points) {
        EXPECT_TRUE(p.x > 0.499 && p.z > 0.499 && p.x < 3.501 && p.z < 3.501);
        const bool beyond = p.x > 1.501 && p.z > 1.501;  // but round the corner that sticks in
        EXPECT_TRUE(!beyond || (p.x < 2 && p.z < 2 && std::hypot(p.x - 2, p.z - 2) > 0.499));
        EXPECT_EQ(p.y, 1.0);
    }
    EXPECT_NEAR(static_cast<double>(inner.points.size()), 900.0 * 5.0 / 9.0, 20.0);
    const ZoneGrid strip = lay_grid({l_shape, 0.0, 0.5}, {}, 4096);
    EXPECT_GT(strip.spacing, 0.0);
    EXPECT_FALSE(strip.points.empty());
    for (const glm::dvec3& p : strip.points) {
        const bool in = p.x > 0 && p.z > 0 && p.x < 4 && p.z < 4 && !(p.x > 2 && p.z > 2);
        EXPECT_FALSE(in);
        EXPECT_TRUE(p.x > -0.5 && p.z > -0.5 && p.x < 4.5 && p.z < 4.5);
    }
    EXPECT_TRUE(lay_grid({l_shape, 0.0, 0.0}, {100, 100}, 4096).points.empty());
}

TEST(ZoneArea, OutlinesThatCrossThemselvesHaveAReason) {
    EXPECT_NE(outline_problem({{0, 0, 0}, {1, 0, 0}}).find("three corners"), std::string::npos);
    EXPECT_NE(outline_problem({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).find("no area"),
              std::string::npos);
    // A bow tie whose halves have the same area, and one with a small second half.
    EXPECT_EQ(outline_problem({{0, 1, 0}, {2, 1, 2}, {2, 1, 0}, {0, 1, 2}}),
              "crosses itself: the edge from corner 1 to 2 meets that from corner 3 to 4");
    EXPECT_NE(outline_problem({{0, 1, 0}, {4, 1, 0}, {4, 1, 3}, {3, 1, -1}, {0, 1, 3}}), "");
    // The way back goes through a corner of the way there, on its edge.
    EXPECT_NE(outline_problem({{0, 1, 0}, {4, 1, 0}, {4, 1, 2}, {2, 1, 0}, {2, 1, -2}, {0, 1, -2}}),
              "");
    // One that touches itself encloses what it seems to: a corner on an edge, a corner twice, a
    // first corner that comes again at the end.
    EXPECT_EQ(outline_problem({{0, 1, 0}, {4, 1, 0}, {4, 1, 4}, {2, 1, 0}, {0, 1, 4}}), "");
    EXPECT_EQ(outline_problem({{0, 1, 0}, {2, 1, 2}, {4, 1, 0}, {4, 1, 4}, {2, 1, 2}, {0, 1, 4}}),
              "");
    EXPECT_EQ(outline_problem({{0, 1, 0}, {4, 1, 0}, {4, 1, 4}, {0, 1, 0}}), "");
}

/// Each lamp by its own factor; the sky as it is.
TEST(MeasuredPoints, MaintainedLightFollowsEachLamp) {
    SceneBuilder builder;
    sized(builder).scene.sky_radiance = glm::vec3(10.0F);
    for (const auto& [x, factor] : {std::pair(-1.0F, 0.5F), std::pair(1.0F, 0.9F)}) {
        add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::point, {x, 2, 0}, {0, -1, 0},
                           glm::vec3(100.0F));
        builder.scene.punctual_lights.back().control.maintenance_factor = factor;
    }
    const double one = measure_at(builder, Quantity::horizontal, {0, 0, 0}, {}, 1).value;
    maintain_lamps(builder.scene, builder.mesh);
    const double kept = measure_at(builder, Quantity::horizontal, {0, 0, 0}, {}, 1).value;
    const double daylight = pi * 10.0;
    EXPECT_NEAR(kept - daylight, 0.7 * (one - daylight), 1e-4);
}

TEST(Requirement, IsUnknownWhereTheIntervalHoldsTheLimit) {
    MeasurementSummary found;
    found.mean = {500.0, 490.0, 510.0};
    found.uniformity = {0.7, 0.65, 0.75};
    const auto verdict = [&](double mean, double uniformity) {
        return verdict_of(check({mean, uniformity, {}}, Quantity::horizontal, found, {}));
    };
    EXPECT_EQ(verdict(490.0, 0.6), Verdict::met);
    EXPECT_EQ(verdict(500.0, 0.6), Verdict::unknown);
    EXPECT_EQ(verdict(520.0, 0.6), Verdict::missed);
    EXPECT_EQ(verdict(500.0, 0.8), Verdict::missed);
    EXPECT_EQ(verdict_of(check({500.0, {}, {}}, Quantity::horizontal, std::nullopt, {})),
              Verdict::unknown);
    GlareRating seat;
    seat.state = GlareRating::State::rated;
    seat.value = {18.0, 17.5, 18.5};
    std::vector<GlareRating> seats = {seat};
    const auto glare = [&] {
        return verdict_of(check({{}, {}, 19.0}, Quantity::ugr, std::nullopt, seats));
    };
    EXPECT_EQ(glare(), Verdict::met);
    seats.push_back({});
    EXPECT_EQ(glare(), Verdict::unknown);  // outside of the method
    seats.back().state = GlareRating::State::no_source;
    EXPECT_EQ(glare(), Verdict::met);
    seats.back().state = GlareRating::State::rated;
    seats.back().value = {20.0, 19.5, 20.5};
    EXPECT_EQ(glare(), Verdict::missed);
}

/// Tabulated quantiles (Student 1908; any table).
TEST(StudentQuantile, IsThatOfTheTables) {
    EXPECT_NEAR(student_quantile(0.975, 15), 2.131450, 1e-5);
    EXPECT_NEAR(student_quantile(0.975, 1), 12.706205, 1e-4);
    EXPECT_NEAR(student_quantile(0.95, 10), 1.812461, 1e-5);
    EXPECT_NEAR(student_quantile(0.995, 4), 4.604095, 1e-5);
}

}  // namespace
}  // namespace raybundle
