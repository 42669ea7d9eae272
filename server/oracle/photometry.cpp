// SPDX-License-Identifier: Apache-2.0
#include "oracle/photometry.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "measure/point_measurement.h"
#include "oracle/scene_builder.h"
#include "scene/light/sky_dome.h"

namespace raybundle {
namespace {

using std::numbers::pi;
using Points = std::vector<PhotometryPoint>;

constexpr std::uint64_t usual_rounds = 256;

/// Measures some points of a scene; `exact` belongs to them in their order.
Points measure(const std::string& name, const SceneBuilder& builder, Quantity quantity,
               const std::vector<CalculationPoint>& places, const std::vector<double>& exact,
               std::uint64_t rounds = usual_rounds) {
    PointMeasurement points(std::make_shared<const MeasuredScene>(builder.scene, builder.mesh),
                            places, {quantity, false, 1.0, 171});
    points.add_samples(rounds * places.size());
    const std::vector<Interval> values = points.values();
    Points result;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3& p = places[i].position;
        result.push_back(
            {fmt::format("{} ({:g} {:g} {:g})", name, p.x, p.y, p.z), exact[i], values[i], false});
    }
    return result;
}

/// Rays need a scene of some size.
SceneBuilder open_space() {
    SceneBuilder builder;
    const std::uint32_t black = builder.add_material(glm::vec3(0.0F));
    builder.add_triangle({-9, -9, -9}, {-9, -9, -8.9F}, {-8.9F, -9, -9}, black);
    builder.add_triangle({9, 9, 9}, {9, 9, 9.1F}, {9.1F, 9, 9}, black);
    return builder;
}

PunctualLight light(PunctualKind kind, const glm::vec3& position, float intensity) {
    PunctualLight result;
    result.kind = kind;
    result.position = position;
    result.axes = glm::mat3(1, 0, 0, 0, 0, -1, 0, 1, 0);  // shines down
    result.intensity = glm::vec3(intensity);
    return result;
}

Points point_source() {
    SceneBuilder builder = open_space();
    builder.scene.punctual_lights.push_back(light(PunctualKind::point, {0, 3, 0}, 800.0F));
    std::vector<CalculationPoint> places;
    std::vector<double> exact;
    for (const double x : {0.0, 1.0, 3.0}) {
        places.push_back({{x, 0, 0}, {}});
        exact.push_back(800.0 * 3.0 / std::pow(x * x + 9.0, 1.5));
    }
    return measure("5.2 point source", builder, Quantity::horizontal, places, exact, 8);
}

/// Share of the hemisphere, cosine included, of a rectangle a x b parallel to the plane at height h
/// over the point below its corner.
double parallel_share(double a, double b, double h) {
    const double ra = std::hypot(1.0, a / h);
    const double rb = std::hypot(1.0, b / h);
    return (a / h / ra * std::atan(b / h / ra) + b / h / rb * std::atan(a / h / rb)) / (2.0 * pi);
}

/// The same of one that stands: w wide from the point's foot, h high, at a distance d.
double perpendicular_share(double w, double h, double d) {
    const double r = std::hypot(d, h);
    return (std::atan(w / d) - d / r * std::atan(w / r)) / (2.0 * pi);
}

/// A luminous ceiling of 2 m x 1.5 m, 2000 cd/m².
SceneBuilder luminous_ceiling() {
    SceneBuilder builder = open_space();
    builder.add_quad({0, 3, 0}, {2, 0, 0}, {0, 0, 1.5F}, 4, 3,
                     builder.add_material(glm::vec3(0.0F), glm::vec3(2000.0F)));
    return builder;
}

Points rectangles() {
    const SceneBuilder builder = luminous_ceiling();
    Points all = measure(
        "5.3 rectangle, parallel", builder, Quantity::horizontal,
        {{{0, 0, 0}, {}}, {{0, 1.5, 0}, {}}},
        {2000.0 * pi * parallel_share(2, 1.5, 3), 2000.0 * pi * parallel_share(2, 1.5, 1.5)});
    // Facing x, a plane sees the ceiling as a rectangle that is perpendicular to it.
    for (PhotometryPoint& point :
         measure("5.6 rectangle, perpendicular", builder, Quantity::vertical,
                 {{{0, 0, 0}, {1, 0, 0}}, {{0, 1.5, 0}, {1, 0, 0}}},
                 {2000.0 * pi * perpendicular_share(1.5, 2, 3),
                  2000.0 * pi * perpendicular_share(1.5, 2, 1.5)})) {
        all.push_back(point);
    }
    return all;
}

Points obstruction() {
    SceneBuilder builder = luminous_ceiling();
    Material screen;
    screen.base_colour = glm::vec3(0.0F);
    screen.specular = 0.0F;
    screen.double_sided = true;
    // Half way up, from x = 0.5 on: what lies beyond x = 1 is hidden.
    builder.add_quad({0.5F, 1.5F, -1}, {0, 0, 4}, {4, 0, 0}, 1, 1, builder.add_material(screen));
    return measure("5.7 obstruction", builder, Quantity::horizontal, {{{0, 0, 0}, {}}},
                   {2000.0 * pi * parallel_share(1, 1.5, 3)});
}

/// Points in the middle of n x n cells of each face of a cube [0, 4]^3, facing inwards, a little
/// before it.
std::vector<CalculationPoint> on_cube(int n) {
    std::vector<CalculationPoint> places;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {0.0, 1.0}) {
            for (int i = 0; i < n * n; ++i) {
                glm::dvec3 at(0.0);
                glm::dvec3 normal(0.0);
                normal[axis] = 1.0 - 2.0 * side;
                at[axis] = 4.0 * side + 1e-4 * normal[axis];
                const int row = i / n;
                at[(axis + 1) % 3] = 4.0 * (i - n * row + 0.5) / n;
                at[(axis + 2) % 3] = 4.0 * (row + 0.5) / n;
                places.push_back({at, normal});
            }
        }
    }
    return places;
}

/// Mean over the walls of a cube with a light of 1000 lm in its middle.
Interval cube_mean(float albedo, std::uint64_t rounds) {
    SceneBuilder builder;
    builder.add_box({0, 0, 0}, {4, 4, 4}, true, 4, builder.add_material(glm::vec3(albedo)));
    builder.scene.punctual_lights.push_back(
        light(PunctualKind::point, {2, 2, 2}, static_cast<float>(250.0 / pi)));
    const std::vector<CalculationPoint> places = on_cube(24);
    PointMeasurement points(std::make_shared<const MeasuredScene>(builder.scene, builder.mesh),
                            places, {Quantity::normal, false, 1.0, 171});
    points.add_samples(rounds * places.size());
    return points.summary().mean;
}

Points cubes() {
    constexpr double surface = 96.0;
    Points all = {{"5.4 flux of 1000 lm on black walls, lm", 1000.0, cube_mean(0.0F, 8), false}};
    Interval& flux = all[0].measured;
    flux = {surface * flux.value, surface * flux.low, surface * flux.high};
    const double direct = 1000.0 / surface;
    for (const double albedo : {0.3, 0.5, 0.8}) {
        const Interval mean = cube_mean(static_cast<float>(albedo), 8);
        all.push_back({fmt::format("5.8 inter-reflection, albedo {:g}", albedo),
                       direct * albedo / (1.0 - albedo),
                       {mean.value - direct, mean.low - direct, mean.high - direct},
                       false});
    }
    return all;
}

/// A slab of two faces passes (1 - r)/(1 + r), r of each face by Fresnel, unpolarised.
Points glass() {
    SceneBuilder builder = open_space();
    Material pane;
    pane.metallic = 0.0F;
    pane.roughness = 0.0F;
    pane.transmission = 1.0F;
    pane.double_sided = true;
    builder.add_quad({-8, 2, -8}, {0, 0, 16}, {16, 0, 0}, 1, 1, builder.add_material(pane));
    Points all;
    for (const double degrees : {0.0, 30.0, 45.0}) {
        const double angle = degrees * pi / 180.0;
        const double inside = std::asin(std::sin(angle) / 1.5);
        const double c = std::cos(angle);
        const double t = std::cos(inside);
        const double s = std::pow((c - 1.5 * t) / (c + 1.5 * t), 2.0);
        const double p = std::pow((1.5 * c - t) / (1.5 * c + t), 2.0);
        const double passed = 0.5 * ((1.0 - s) / (1.0 + s) + (1.0 - p) / (1.0 + p));
        PunctualLight sun = light(PunctualKind::directional, {}, 10'000.0F);
        const auto sine = static_cast<float>(std::sin(angle));
        const auto cosine = static_cast<float>(c);
        sun.axes = glm::mat3(cosine, -sine, 0, 0, 0, -1, sine, cosine, 0);
        builder.scene.punctual_lights = {sun};
        for (PhotometryPoint& point :
             measure(fmt::format("5.5 clear glass, {:g} degrees", degrees), builder,
                     Quantity::horizontal, {{{0, 1, 0}, {}}}, {10'000.0 * c * passed}, 8)) {
            all.push_back(point);
        }
    }
    return all;
}

/// Luminance over direction, cd/m².
using Luminance = std::function<double(const glm::dvec3&)>;

/// Illuminance of a plane that faces up by what a rectangle lets in of a sky: a sum over pieces.
double through(const glm::dvec3& from, const glm::dvec3& corner, const glm::dvec3& u,
               const glm::dvec3& v, const Luminance& sky) {
    constexpr int n = 300;
    const glm::dvec3 area = glm::cross(u, v) / (double{n} * n);
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 to = corner + (i + 0.5) / n * u + (j + 0.5) / n * v - from;
            const double distance = glm::length(to);
            const glm::dvec3 w = to / distance;
            sum += sky(w) * w.y * std::abs(glm::dot(area, w)) / (distance * distance);
        }
    }
    return sum;
}

/// A black room [0, 4] x [0, 3] x [0, 4] with an opening in its roof, or in the wall x = 0.
SceneBuilder black_room(bool roof) {
    SceneBuilder b;
    const std::uint32_t m = b.add_material(glm::vec3(0.0F));
    const auto face = [&](const glm::vec3& c, const glm::vec3& u, const glm::vec3& v) {
        b.add_quad(c, u, v, 1, 1, m);
    };
    face({0, 0, 0}, {0, 0, 4}, {4, 0, 0});
    face({4, 0, 0}, {0, 0, 4}, {0, 3, 0});
    face({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    face({0, 0, 4}, {0, 3, 0}, {4, 0, 0});
    if (roof) {  // [1, 3] x [1, 3] is open
        face({0, 0, 0}, {0, 3, 0}, {0, 0, 4});
        face({0, 3, 0}, {1, 0, 0}, {0, 0, 4});
        face({3, 3, 0}, {1, 0, 0}, {0, 0, 4});
        face({1, 3, 0}, {2, 0, 0}, {0, 0, 1});
        face({1, 3, 3}, {2, 0, 0}, {0, 0, 1});
    } else {  // y in [1, 2], z in [1, 3]
        face({0, 3, 0}, {4, 0, 0}, {0, 0, 4});
        face({0, 0, 0}, {0, 1, 0}, {0, 0, 4});
        face({0, 2, 0}, {0, 1, 0}, {0, 0, 4});
        face({0, 1, 0}, {0, 1, 0}, {0, 0, 1});
        face({0, 1, 3}, {0, 1, 0}, {0, 0, 1});
    }
    return b;
}

Points opening(const std::string& sky_name, bool roof, const Luminance& sky,
               const std::function<void(Scene&)>& give_sky) {
    SceneBuilder room = black_room(roof);
    give_sky(room.scene);
    std::vector<CalculationPoint> places;
    std::vector<double> exact;
    for (const double x : {1.0, 2.0, 3.0}) {
        const glm::dvec3 at(x, 0.75, 2.0);
        places.push_back({at, {}});
        exact.push_back(roof ? through(at, {1, 3, 1}, {2, 0, 0}, {0, 0, 2}, sky)
                             : through(at, {0, 1, 1}, {0, 1, 0}, {0, 0, 2}, sky));
    }
    return measure(fmt::format("{} opening, {} sky", roof ? "5.9 roof" : "5.11 facade", sky_name),
                   room, Quantity::horizontal, places, exact, 4096);
}

Points openings() {
    Points all;
    const auto add = [&](const Points& more) { all.insert(all.end(), more.begin(), more.end()); };
    for (const bool roof : {true, false}) {
        add(opening(
            "uniform", roof, [](const glm::dvec3&) { return 3000.0; },
            [](Scene& scene) { scene.sky_radiance = glm::vec3(3000.0F); }));
        for (const int type : {CieSky::traditional_overcast, CieSky::standard_clear}) {
            SkyDomeSettings settings;
            settings.sky.type = type;
            settings.zenith_luminance = 3000.0;
            const auto dome = std::make_shared<const SkyDome>(settings);
            add(opening(
                type == CieSky::standard_clear ? "clear" : "overcast", roof,
                [dome](const glm::dvec3& w) { return dome->radiance(w).y; },
                [dome](Scene& scene) { set_environment(dome, scene); }));
        }
    }
    return all;
}

}  // namespace

std::vector<PhotometryPoint> run_photometry() {
    constexpr double half_intervals = 1.6;
    constexpr double least = 0.005;
    Points all;
    for (const auto& run : {point_source, rectangles, cubes, glass, obstruction, openings}) {
        for (PhotometryPoint& point : run()) {
            const double half = point.measured.high - point.measured.value;
            const double bound = std::max(half_intervals * half, least * point.exact);
            point.passed = std::abs(point.measured.value - point.exact) <= bound;
            all.push_back(point);
        }
    }
    return all;
}

}  // namespace raybundle
