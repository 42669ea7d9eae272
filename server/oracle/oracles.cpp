// SPDX-License-Identifier: Apache-2.0
#include "oracle/oracles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <numbers>
#include <optional>

#include "oracle/glossy_oracles.h"
#include "oracle/oracle_solve.h"

namespace raybundle {

namespace {

using std::numbers::pi;

constexpr float furnace_emission = 100.0F;
constexpr float disc_receiver = 0.05F;  // half its side over the height of the disc

SceneBuilder furnace_room(float albedo) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto m = b.add_material(glm::vec3(albedo), glm::vec3(furnace_emission));
    constexpr std::uint32_t n = 4;
    // An L-shaped room: floor and ceiling in two rectangles, six walls.
    const auto wall = [&](glm::vec2 from, glm::vec2 to) {
        b.add_quad({from.x, 0, from.y}, {to.x - from.x, 0, to.y - from.y}, {0, 3, 0}, n, n, m);
    };
    for (const auto& [corner, size] : {std::pair{glm::vec2(0, 0), glm::vec2(5, 2)},
                                       std::pair{glm::vec2(0, 2), glm::vec2(2, 2)}}) {
        b.add_quad({corner.x, 0, corner.y}, {0, 0, size.y}, {size.x, 0, 0}, n, n, m);
        b.add_quad({corner.x, 3, corner.y}, {size.x, 0, 0}, {0, 0, size.y}, n, n, m);
    }
    const glm::vec2 outline[] = {{0, 0}, {5, 0}, {5, 2}, {2, 2}, {2, 4}, {0, 4}};
    for (int i = 0; i < 6; ++i) {
        wall(outline[i], outline[(i + 1) % 6]);
    }
    return b;
}

std::vector<double> furnace_ratios(float albedo, const OracleSettings& settings, double& mean) {
    SceneBuilder b = furnace_room(albedo);
    b.join(settings.joined);
    const auto irradiance = solve(b, settings).store().read_irradiance();
    const double exact =
        pi * static_cast<double>(furnace_emission) / (1.0 - static_cast<double>(albedo));
    mean = mean_irradiance(b, irradiance) / exact;
    std::vector<double> ratios;
    ratios.reserve(irradiance.size());
    for (const glm::vec4& e : irradiance) {
        ratios.push_back(static_cast<double>(e.x) / exact);
    }
    return ratios;
}

}  // namespace

double furnace_mean(float albedo, const OracleSettings& settings) {
    double mean = 0.0;
    furnace_ratios(albedo, settings, mean);
    return mean;
}

double furnace_worst(float albedo, const OracleSettings& settings) {
    double mean = 0.0;
    double worst = 0.0;
    for (const double ratio : furnace_ratios(albedo, settings, mean)) {
        worst = std::max(worst, std::abs(ratio - 1.0));
    }
    return worst;
}

double enclosure_indirect(float albedo, const OracleSettings& settings) {
    constexpr double flux = 10'000.0;
    constexpr double surface = 6.0 * 16.0;
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto wall = b.add_material(glm::vec3(albedo));
    const auto radiance = static_cast<float>(flux / pi);  // of 1 m²
    const auto lamp = b.add_material(glm::vec3(albedo), glm::vec3(radiance));
    b.add_box({0, 0, 0}, {4, 4, 4}, true, 4, wall);
    // One cell of the ceiling is the lamp: S stays 96 m².
    for (std::size_t i = 0; i < b.mesh.triangles.size(); ++i) {
        const glm::vec3 centre = b.cell_centre(i);
        if (centre.y > 3.99F && centre.x > 1.0F && centre.x < 2.0F && centre.z > 1.0F &&
            centre.z < 2.0F) {
            b.set_triangle_material(i, lamp);
        }
    }
    b.join(settings.joined);
    const auto irradiance = solve(b, settings).store().read_irradiance();
    return mean_irradiance(b, irradiance) - flux / surface;
}

CubeFormFactors cube_form_factors(const OracleSettings& settings) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
    b.add_box({0, 0, 0}, {1, 1, 1}, true, 4, black);
    const std::size_t face = b.mesh.triangles.size() / 6;  // faces: x0, x1, y0, y1, z0, z1
    for (std::size_t i = 4 * face; i < 5 * face; ++i) {
        b.set_triangle_material(i, lamp);
    }
    b.join(settings.joined);
    const auto irradiance = solve(b, settings).store().read_irradiance();
    return {mean_irradiance(b, irradiance, 5 * face, 6 * face) / pi,
            mean_irradiance(b, irradiance, 0, 4 * face) / pi};
}

double squares_form_factor(float distance, const OracleSettings& settings) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 8, 8, lamp);  // faces up
    const std::size_t receiver = b.mesh.triangles.size();
    b.add_quad({0, distance, 0}, {1, 0, 0}, {0, 0, 1}, 8, 8, black);  // faces down
    const auto irradiance = solve(b, settings).store().read_irradiance();
    return mean_irradiance(b, irradiance, receiver, b.mesh.side_count()) / pi;
}

double exact_disc_illuminance(double radius, double height, double flux) {
    constexpr int n = 32;
    const double side = 2.0 * static_cast<double>(disc_receiver) * height;
    const double a = radius * radius;
    const double h = height * height;
    double sum = 0.0;
    for (int i = 0; i < n * n; ++i) {
        const int row = i / n;
        const double x = ((i - row * n + 0.5) / n - 0.5) * side;
        const double z = ((row + 0.5) / n - 0.5) * side;
        const double r = x * x + z * z;
        sum += 0.5 * (1.0 - (h + r - a) / std::sqrt(std::pow(h + r + a, 2.0) - 4.0 * a * r));
    }
    return flux / (pi * a) * sum / (n * n);  // pi L times the form factor
}

double disc_illuminance(float radius, float height, float flux, const OracleSettings& settings) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto area = static_cast<float>(pi) * radius * radius;
    const auto lamp =
        b.add_material(glm::vec3(0.0F), glm::vec3(flux / (static_cast<float>(pi) * area)));
    constexpr int sides = 64;
    // A regular polygon of the disc's area.
    const float step = glm::two_pi<float>() / sides;
    const float corner =
        radius * std::sqrt(static_cast<float>(2.0 * pi / (sides * std::sin(2.0 * pi / sides))));
    const auto rim = [&](int i) {
        const float angle = step * static_cast<float>(i);
        return glm::vec3(corner * std::cos(angle), height, corner * std::sin(angle));
    };
    for (int i = 0; i < sides; ++i) {
        b.add_triangle({0, height, 0}, rim(i), rim(i + 1), lamp);
    }
    const std::size_t receiver = b.mesh.triangles.size();
    const float s = disc_receiver * height;
    b.add_quad({-s, 0, -s}, {0, 0, 2 * s}, {2 * s, 0, 0}, 1, 1, black);
    const auto irradiance = solve(b, settings).store().read_irradiance();
    return mean_irradiance(b, irradiance, receiver, b.mesh.side_count());
}

double dark_room_irradiance(float wall_thickness, const OracleSettings& settings) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.8F));
    const auto lamp = b.add_material(glm::vec3(0.8F), glm::vec3(1000.0F));
    b.set_transform(odd_rotation());
    b.add_box({0, 0, 0}, {3, 3, 3}, true, 6, wall);
    b.add_quad({1, 2.9F, 1}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    const std::size_t lit = b.mesh.triangles.size();
    b.add_box({3.0F + wall_thickness, 0, 0}, {6, 3, 3}, true, 7, wall);
    const auto irradiance = solve(b, settings).store().read_irradiance();
    double largest = 0.0;
    for (std::size_t i = lit; i < irradiance.size(); ++i) {
        largest = std::max(largest, static_cast<double>(irradiance[i].x));
    }
    return largest;
}

double black_room_irradiance(const OracleSettings& settings) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {3, 3, 3}, true, 4, b.add_material(glm::vec3(0.8F)));
    double largest = 0.0;
    for (const glm::vec4& e : solve(b, settings).store().read_irradiance()) {
        largest = std::max(largest, static_cast<double>(std::abs(e.x)));
    }
    return largest;
}

std::uint64_t differing_bits(const OracleSettings& settings) {
    const SceneBuilder b = furnace_room(0.7F);
    const auto first = solve(b, settings).store().read_irradiance();
    const auto second = solve(b, settings).store().read_irradiance();
    std::uint64_t differing = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        for (int c = 0; c < 4; ++c) {
            const bool same = std::bit_cast<std::uint32_t>(first[i][c]) ==
                              std::bit_cast<std::uint32_t>(second[i][c]);
            differing += same ? 0 : 1;
        }
    }
    return differing;
}

namespace {

/// bound: relative to the expected value, absolute where that is 0.
Oracle make_oracle(const std::string& name, double expected, double bound,
                   const std::function<double()>& measure) {
    return {name, [=] {
                OracleResult r;
                r.expected = expected;
                r.measured = measure();
                r.bound = expected == 0.0 ? bound : bound * std::abs(expected);
                r.passed = std::abs(r.measured - r.expected) <= r.bound;
                return r;
            }};
}

/// Both form factors of one solve, which runs when the first of them is measured.
std::array<Oracle, 2> cube_oracles(const std::string& strategies, double bound,
                                   const OracleSettings& settings) {
    const auto solved = std::make_shared<std::optional<CubeFormFactors>>();
    const auto factors = [=] {
        if (!*solved) {
            *solved = cube_form_factors(settings);
        }
        return **solved;
    };
    return {make_oracle("cube form factor, opposite" + strategies, 0.199825, bound,
                        [=] { return factors().opposite; }),
            make_oracle("cube form factor, adjacent" + strategies, 0.200044, bound,
                        [=] { return factors().adjacent; })};
}

}  // namespace

std::vector<Oracle> all_oracles() {
    OracleSettings usual;
    usual.iterations = 1024;
    OracleSettings long_run;
    long_run.iterations = 2560;
    OracleSettings perspective =
        usual;  // the bounds of direct light ask for the least noisy strategy
    perspective.iterations = 1536;
    perspective.probabilities = {0.0F, 0.0F, 1.0F};
    OracleSettings small_target = perspective;  // the receiver covers few pixels
    small_target.resolution = {512, 400};
    small_target.iterations = 768;
    OracleSettings parallel = usual;
    parallel.probabilities = {1.0F, 0.0F, 0.0F};
    OracleSettings planes = usual;
    planes.probabilities = {0.0F, 1.0F, 0.0F};
    // A plane finds few pairs, of much weight: the form factors are within 1 % after so many, and
    // with an albedo the noise of the iterate would still be felt.
    planes.iterations = 4096;
    OracleSettings three = usual;
    three.probabilities = {0.15F, 0.15F, 0.7F};
    three.iterations = 2048;
    // Joined by eight, sets lie on one wall of a cube; by five, they go round the corners of rooms.
    OracleSettings joined = long_run;
    joined.joined = 5;
    OracleSettings joined_three = three;
    joined_three.joined = 5;
    OracleSettings joined_flat = perspective;
    joined_flat.joined = 8;
    OracleSettings joined_pairs = usual;
    joined_pairs.joined = 2;
    OracleSettings brief;
    brief.iterations = 256;
    OracleSettings brief_three = three;
    brief_three.iterations = brief.iterations;
    std::vector<Oracle> oracles = {
        make_oracle("furnace, albedo 0.5", 1.0, 0.005,
                    [=] { return furnace_mean(0.5F, long_run); }),
        make_oracle("furnace, albedo 0.9", 1.0, 0.005,
                    [=] { return furnace_mean(0.9F, long_run); }),
        make_oracle("furnace, albedo 0.99", 1.0, 0.02, [=] { return furnace_mean(0.99F, usual); }),
        make_oracle("furnace, albedo 0.5, parallel", 1.0, 0.005,
                    [=] { return furnace_mean(0.5F, parallel); }),
        make_oracle("furnace, albedo 0, planes", 1.0, 0.005,
                    [=] { return furnace_mean(0.0F, planes); }),
        make_oracle("furnace, albedo 0.5, three strategies", 1.0, 0.005,
                    [=] { return furnace_mean(0.5F, three); }),
        make_oracle("enclosure, albedo 0.8, three strategies", 416.667, 0.005,
                    [=] { return enclosure_indirect(0.8F, three); }),
        make_oracle("unit squares at 0.1", 0.826995, 0.005,
                    [=] { return squares_form_factor(0.1F, perspective); }),
        make_oracle("disc source above", exact_disc_illuminance(0.1, 2.0, 1000.0), 0.005,
                    [=] { return disc_illuminance(0.1F, 2.0F, 1000.0F, small_target); }),
        make_oracle("furnace, glossy, albedo 0.5", 1.0, 0.02,
                    [=] { return glossy_furnace_mean(0.3F, 0.5F, usual); }),
        make_oracle("furnace, albedo 0.9, joined triangles", 1.0, 0.005,
                    [=] { return furnace_mean(0.9F, joined); }),
        make_oracle("furnace, albedo 0.5, joined triangles, three strategies", 1.0, 0.005,
                    [=] { return furnace_mean(0.5F, joined_three); }),
        make_oracle("enclosure, albedo 0.8, joined triangles", 416.667, 0.005,
                    [=] { return enclosure_indirect(0.8F, joined); }),
        make_oracle("furnace, glossy, albedo 0.5, joined triangles", 1.0, 0.02,
                    [=] { return glossy_furnace_mean(0.3F, 0.5F, joined_pairs); }),
        make_oracle("black room", 0.0, 0.0, [=] { return black_room_irradiance(brief); }),
        make_oracle("dark room behind a wall of 0 mm", 0.0, 0.0,
                    [=] { return dark_room_irradiance(0.0F, brief); }),
        make_oracle("dark room behind a wall of 1 mm", 0.0, 0.0,
                    [=] { return dark_room_irradiance(0.001F, brief); }),
        make_oracle("dark room behind a wall of 0 mm, three strategies", 0.0, 0.0,
                    [=] { return dark_room_irradiance(0.0F, brief_three); }),
        make_oracle("same seed, same bits", 0.0, 0.0,
                    [=] { return static_cast<double>(differing_bits(brief)); }),
    };
    for (const auto& [albedo, indirect] :
         {std::pair{0.5F, 104.167}, std::pair{0.8F, 416.667}, std::pair{0.9F, 937.5},
          std::pair{0.95F, 1979.17}, std::pair{0.999F, 104062.5}}) {
        oracles.push_back(make_oracle(fmt::format("enclosure, albedo {:.3g}", albedo), indirect,
                                      0.005,
                                      [=, a = albedo] { return enclosure_indirect(a, long_run); }));
    }
    for (const auto& pair :
         {cube_oracles("", 0.002, perspective), cube_oracles(", planes", 0.01, planes),
          cube_oracles(", joined triangles", 0.002, joined_flat),
          cube_oracles(", three strategies", 0.002, three)}) {
        oracles.insert(oracles.end(), pair.begin(), pair.end());
    }
    return oracles;
}

}  // namespace raybundle
