// SPDX-License-Identifier: Apache-2.0
#include "hard_rooms.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numbers>
#include <random>

#include "oracle/oracle_solve.h"

namespace raybundle {
namespace {

using std::numbers::pi;

void add_plate(SceneBuilder& b, float from, float to, float height, bool up, std::uint32_t material,
               std::uint32_t cells) {
    const glm::vec3 x(to - from, 0.0F, 0.0F);
    const glm::vec3 z(0.0F, 0.0F, to - from);
    b.add_quad({from, height, from}, up ? z : x, up ? x : z, cells, cells, material);
}

/// The rim of a plate of 100 m round its middle of 60 m.
void add_rim(SceneBuilder& b, float height, bool up, std::uint32_t material) {
    const auto strip = [&](glm::vec2 corner, glm::vec2 size, std::uint32_t nx, std::uint32_t nz) {
        const glm::vec3 x(size.x, 0.0F, 0.0F);
        const glm::vec3 z(0.0F, 0.0F, size.y);
        const glm::vec3 at(corner.x, height, corner.y);
        b.add_quad(at, up ? z : x, up ? x : z, up ? nz : nx, up ? nx : nz, material);
    };
    strip({-50, -50}, {100, 20}, 20, 4);
    strip({-50, 30}, {100, 20}, 20, 4);
    strip({-50, -30}, {20, 60}, 4, 12);
    strip({30, -30}, {20, 60}, 4, 12);
}

/// Form factor from a point with its unit normal to a polygon that lies in front of it
/// (Lambert 1760, "Photometria"; Baum et al. 1989).
double polygon_form_factor(const glm::dvec3& point, const glm::dvec3& normal,
                           const std::vector<glm::dvec3>& polygon) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::normalize(polygon[i] - point);
        const glm::dvec3 b = glm::normalize(polygon[(i + 1) % polygon.size()] - point);
        const glm::dvec3 axis = glm::cross(a, b);
        const double sine = glm::length(axis);
        sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(axis, normal) / std::max(sine, 1e-300);
    }
    return std::abs(sum) / (2.0 * pi);
}

/// Mean over a triangle by the centroids of 4^levels equal parts.
template <typename Function>
double triangle_mean(const std::array<glm::dvec3, 3>& t, int levels, const Function& f) {
    if (levels == 0) {
        return f((t[0] + t[1] + t[2]) / 3.0);
    }
    const glm::dvec3 ab = 0.5 * (t[0] + t[1]);
    const glm::dvec3 bc = 0.5 * (t[1] + t[2]);
    const glm::dvec3 ca = 0.5 * (t[2] + t[0]);
    return 0.25 * (triangle_mean({t[0], ab, ca}, levels - 1, f) +
                   triangle_mean({ab, t[1], bc}, levels - 1, f) +
                   triangle_mean({ca, bc, t[2]}, levels - 1, f) +
                   triangle_mean({ab, bc, ca}, levels - 1, f));
}

}  // namespace

KnownScene parallel_plates() {
    constexpr std::array<double, 2> emission = {100.0, 20.0};
    constexpr std::array<double, 2> albedo = {0.5, 0.8};
    KnownScene scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    std::array<std::uint32_t, 2> materials{};
    std::array<double, 2> radiosity{};  // lm/m²
    for (std::size_t i = 0; i < 2; ++i) {
        materials[i] = b.add_material(glm::vec3(static_cast<float>(albedo[i])),
                                      glm::vec3(static_cast<float>(emission[i])));
        radiosity[i] =
            pi * (emission[i] + albedo[i] * emission[1 - i]) / (1.0 - albedo[0] * albedo[1]);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t first = b.mesh.patch_count();
        add_plate(b, -30, 30, static_cast<float>(i), i == 0, materials[i], 12);
        scene.known.push_back({first, b.mesh.patch_count(), radiosity[1 - i]});
    }
    add_rim(b, 0.0F, true, materials[0]);
    add_rim(b, 1.0F, false, materials[1]);
    return scene;
}

KnownScene unit_squares(double distance) {
    // Howell, catalogue of configuration factors, C-11, for width and depth 1.
    const double x2 = 1.0 + 1.0 / (distance * distance);
    const double x = 1.0 / distance;
    const double root = std::sqrt(x2);
    const double factor = 2.0 / (pi * x * x) *
                          (0.5 * std::log(x2 * x2 / (1.0 + 2.0 * x * x)) +
                           2.0 * x * root * std::atan(x / root) - 2.0 * x * std::atan(x));
    KnownScene scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    add_plate(b, 0, 1, 0, true, b.add_material(glm::vec3(0.0F), glm::vec3(1.0F)), 8);
    const std::size_t first = b.mesh.patch_count();
    add_plate(b, 0, 1, static_cast<float>(distance), false, b.add_material(glm::vec3(0.0F)), 8);
    scene.known.push_back({first, b.mesh.patch_count(), pi * factor});
    return scene;
}

namespace {

constexpr float furnace_emission = 100.0F;

void know_furnace(KnownScene& scene, float albedo) {
    const double exact =
        pi * static_cast<double>(furnace_emission) / (1.0 - static_cast<double>(albedo));
    scene.known.push_back({0, scene.builder.mesh.patch_count(), exact});
}

/// Splits a triangle into n x n.
void add_split_triangle(SceneBuilder& b, const std::array<glm::vec3, 3>& t, int n,
                        std::uint32_t material) {
    const glm::vec3 u = (t[1] - t[0]) / static_cast<float>(n);
    const glm::vec3 v = (t[2] - t[0]) / static_cast<float>(n);
    const auto at = [&](int i, int j) {
        return t[0] + u * static_cast<float>(i) + v * static_cast<float>(j);
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n - i; ++j) {
            b.add_triangle(at(i, j), at(i + 1, j), at(i, j + 1), material);
            if (i + j + 1 < n) {
                b.add_triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), material);
            }
        }
    }
}

}  // namespace

KnownScene tetrahedron_furnace(float albedo) {
    KnownScene scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    const auto m = b.add_material(glm::vec3(albedo), glm::vec3(furnace_emission));
    const std::array<glm::vec3, 4> p = {glm::vec3(1, 1, 1), glm::vec3(1, -1, -1),
                                        glm::vec3(-1, 1, -1), glm::vec3(-1, -1, 1)};
    for (const auto& [i, j, k] :
         {std::array{0, 1, 2}, std::array{0, 2, 3}, std::array{0, 3, 1}, std::array{1, 3, 2}}) {
        const auto index = [](int n) { return static_cast<std::size_t>(n); };
        std::array<glm::vec3, 3> t = {p[index(i)], p[index(j)], p[index(k)]};
        if (glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), t[0]) > 0.0F) {
            std::swap(t[1], t[2]);  // fronts inwards
        }
        add_split_triangle(b, t, 6, m);
    }
    know_furnace(scene, albedo);
    return scene;
}

KnownScene sphere_furnace(float albedo) {
    constexpr int rings = 12;
    KnownScene scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    const auto m = b.add_material(glm::vec3(albedo), glm::vec3(furnace_emission));
    const auto point = [](int i, int j) {
        const double theta = pi * i / rings;
        const double phi = pi * j / rings;
        return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                         std::sin(theta) * std::sin(phi));
    };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < 2 * rings; ++j) {
            if (i > 0) {
                b.add_triangle(point(i, j), point(i + 1, j), point(i, j + 1), m);
            }
            if (i + 1 < rings) {
                b.add_triangle(point(i, j + 1), point(i + 1, j), point(i + 1, j + 1), m);
            }
        }
    }
    know_furnace(scene, albedo);
    return scene;
}

KnownScene bright_and_dim_room(float ratio) {
    constexpr float dim = 1.0F;  // cd/m²
    constexpr float albedo = 0.5F;
    KnownScene scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    const auto wall = b.add_material(glm::vec3(albedo));
    const auto bright_lamp = b.add_material(glm::vec3(albedo), glm::vec3(ratio * dim));
    const auto dim_lamp = b.add_material(glm::vec3(albedo), glm::vec3(dim));
    b.add_box({0, 0, 0}, {4, 4, 4}, true, 4, wall);
    const std::size_t second = b.mesh.patch_count();
    b.add_box({4.1F, 0, 0}, {8.1F, 4, 4}, true, 4, wall);
    for (std::size_t i = 0; i < b.mesh.patch_count(); ++i) {
        const glm::vec3 c = b.cell_centre(i) - glm::vec3(i < second ? 0.0F : 4.1F, 0, 0);
        if (c.y > 3.99F && c.x > 1.0F && c.x < 2.0F && c.z > 1.0F && c.z < 2.0F) {
            b.set_triangle_material(i, i < second ? bright_lamp : dim_lamp);
        }
    }
    const double exact = pi * static_cast<double>(dim) / (96.0 * 0.5);  // of 1 m²
    scene.known.push_back({second, b.mesh.patch_count(), exact});
    return scene;
}

KnownScene corner() {
    constexpr std::uint32_t n = 8;
    KnownScene scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    // The wall x = 0 emits, the floor y = 0 is black.
    b.add_quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, n, n,
               b.add_material(glm::vec3(0.0F), glm::vec3(1.0F)));
    const std::size_t floor = b.mesh.patch_count();
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, n, n, b.add_material(glm::vec3(0.0F)));
    const std::vector<glm::dvec3> wall = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
    const glm::dmat4 back = glm::inverse(glm::dmat4(odd_rotation()));
    for (std::size_t i = floor; i < b.mesh.patch_count(); ++i) {
        if (b.cell_centre(i).x > 1.0F / n) {
            continue;
        }
        std::array<glm::dvec3, 3> t{};
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 p(b.mesh.positions[b.mesh.triangles[i][k]]);
            t[static_cast<std::size_t>(k)] = glm::dvec3(back * glm::dvec4(p, 1.0));
        }
        const double factor = triangle_mean(t, 7, [&](const glm::dvec3& p) {
            return polygon_form_factor({p.x, 0.0, p.z}, {0, 1, 0}, wall);
        });
        scene.known.push_back({i, i + 1, pi * factor});
    }
    return scene;
}

KnownScene hall_with_small_patches() {
    constexpr std::uint32_t cells = 200;
    KnownScene scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    const auto walls = b.add_material(glm::vec3(0.0F), glm::vec3(furnace_emission));
    b.add_box({0, 0, 0}, {4, 4, 100}, true, 8, walls);
    const auto black = b.add_material(glm::vec3(0.0F));
    const std::size_t first = b.mesh.patch_count();
    b.add_quad({1.9F, 0.1F, 50}, {0, 0, 0.2F}, {0.2F, 0, 0}, cells, cells, black);
    scene.known.push_back(
        {first, b.mesh.patch_count(), pi * static_cast<double>(furnace_emission)});
    return scene;
}

KnownScene room_with_slivers() {
    KnownScene scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    const auto walls = b.add_material(glm::vec3(0.0F), glm::vec3(furnace_emission));
    b.add_box({0, 0, 0}, {4, 4, 4}, true, 8, walls);
    const auto black = b.add_material(glm::vec3(0.0F));
    const std::size_t first = b.mesh.patch_count();
    std::mt19937 random(1);
    std::uniform_real_distribution<float> across(1.1F, 2.9F);
    for (int i = 0; i < 200; ++i) {
        const float angle = 2.0F * glm::pi<float>() * 0.618F * static_cast<float>(i);
        const glm::vec3 along(std::cos(angle), 0, std::sin(angle));
        const glm::vec3 width = 3e-4F * glm::vec3(along.z, 0, -along.x);
        const float x = across(random);
        const glm::vec3 corner(x, 1.5F + 1e-3F * static_cast<float>(i), across(random));
        b.add_triangle(corner, corner + along, corner + width, black);
    }
    scene.known.push_back(
        {first, b.mesh.patch_count(), pi * static_cast<double>(furnace_emission)});
    return scene;
}

StripedWall striped_wall(float thickness, std::uint32_t strips) {
    StripedWall scene;
    SceneBuilder& b = scene.builder;
    b.set_transform(odd_rotation());
    constexpr float w = 4.0F;
    b.add_box({0, 0, 0}, glm::vec3(w), true, 5,
              b.add_material(glm::vec3(0.0F), glm::vec3(furnace_emission)));
    scene.first_dark = b.mesh.patch_count();
    const auto black = b.add_material(glm::vec3(0.0F));
    const float x = w + thickness;
    b.add_quad({x, 0, 0}, {0, 0, w}, {w, 0, 0}, 5, 5, black);
    b.add_quad({x, w, 0}, {w, 0, 0}, {0, 0, w}, 5, 5, black);
    b.add_quad({x, 0, 0}, {w, 0, 0}, {0, w, 0}, 5, 5, black);
    b.add_quad({x, 0, w}, {0, w, 0}, {w, 0, 0}, 5, 5, black);
    b.add_quad({x + w, 0, 0}, {0, 0, w}, {0, w, 0}, 5, 5, black);
    for (std::uint32_t i = 0; i < strips; ++i) {
        const float z = w * static_cast<float>(i) / static_cast<float>(strips);
        const float next = w * static_cast<float>(i + 1) / static_cast<float>(strips);
        b.add_quad({x, 0, z}, {0, w, 0}, {0, 0, next - z}, 1, 1, black);
    }
    return scene;
}

}  // namespace raybundle
