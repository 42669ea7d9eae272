// SPDX-License-Identifier: Apache-2.0
// The painter's algorithm (ch. 4.3.1, figures 4.3 and 4.4), the negative example: it sorts whole
// patches along the direction, and so puts some pairs on the two sides of a thin wall in the wrong
// order. It exists in this test only.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bundle/low_discrepancy.h"
#include "bundle/parallel_window.h"
#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle::painter_test {
namespace {

/// Two rooms that share a wall; a lamp in the first. Patches from `dark` on are the second room's.
struct TwoRooms {
    explicit TwoRooms(float wall_thickness) {
        const auto wall = builder.add_material(glm::vec3(0.5F));
        const auto lamp = builder.add_material(glm::vec3(0.5F), glm::vec3(1.0F));
        builder.set_transform(glm::rotate(glm::mat4(1.0F), 0.7F, glm::vec3(0.3F, 0.9F, 0.2F)));
        builder.add_box({0, 0, 0}, {3, 3, 3}, true, 6, wall);
        builder.add_quad({1, 2.9F, 1}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
        dark = builder.mesh.patch_count();
        builder.add_box({3.0F + wall_thickness, 0, 0}, {6, 3, 3}, true, 7, wall);
    }
    SceneBuilder builder;
    std::size_t dark = 0;
};

using Triangle = std::array<glm::vec3, 3>;  // bundle coordinates

/// Twice the signed area of the triangle a, b, p.
float edge(const glm::vec3& a, const glm::vec3& b, const glm::vec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Calls work(pixel index) for the pixels of an n x n window whose centres a triangle covers.
template <typename Work>
void scan_convert(const Triangle& t, int n, float pixel_size, const Work& work) {
    const float area = edge(t[0], t[1], t[2]);
    const auto range = [&](float a, float b, float c) {
        return std::pair{std::max(0, static_cast<int>(std::min({a, b, c}) / pixel_size)),
                         std::min(n - 1, static_cast<int>(std::max({a, b, c}) / pixel_size))};
    };
    const auto [x0, x1] = range(t[0].x, t[1].x, t[2].x);
    const auto [y0, y1] = range(t[0].y, t[1].y, t[2].y);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const glm::vec2 p = (glm::vec2(x, y) + 0.5F) * pixel_size;
            if (edge(t[0], t[1], p) * area >= 0.0F && edge(t[1], t[2], p) * area >= 0.0F &&
                edge(t[2], t[0], p) * area >= 0.0F) {
                work(static_cast<std::size_t>(y) * static_cast<std::size_t>(n) +
                     static_cast<std::size_t>(x));
            }
        }
    }
}

/// Patches that the painter's algorithm makes exchange radiance in one direction, pixel by pixel.
std::vector<std::pair<std::size_t, std::size_t>> painter_pairs(const PatchMesh& mesh,
                                                               const ParallelWindow& window) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < mesh.patch_count(); ++i) {
        const glm::uvec3& t = mesh.triangles[mesh.side_triangle[i]];
        triangles.push_back({window.frame.to_bundle(mesh.positions[t.x]),
                             window.frame.to_bundle(mesh.positions[t.y]),
                             window.frame.to_bundle(mesh.positions[t.z])});
    }
    const auto centre = [&](std::size_t i) {
        return triangles[i][0].z + triangles[i][1].z + triangles[i][2].z;
    };
    std::vector<std::size_t> order(triangles.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return centre(a) < centre(b); });
    constexpr auto nothing = static_cast<std::size_t>(-1);
    const auto n = static_cast<std::size_t>(window.size);
    std::vector<std::size_t> image(n * n, nothing);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::size_t i : order) {
        const bool looks_far = edge(triangles[i][0], triangles[i][1], triangles[i][2]) > 0.0F;
        scan_convert(triangles[i], window.size, window.pixel_size, [&](std::size_t pixel) {
            if (!looks_far && image[pixel] != nothing) {
                pairs.emplace_back(image[pixel], i);
            }
            image[pixel] = looks_far ? i : nothing;
        });
    }
    return pairs;
}

/// Share of all exchanges that pass through the wall, over a number of directions.
double leaking_share(const TwoRooms& rooms, int directions) {
    std::size_t leaks = 0;
    std::size_t all = 0;
    for (int k = 1; k <= directions; ++k) {
        const auto index = static_cast<std::uint64_t>(k);
        const ParallelWindow window = make_parallel_window(
            160, uniform_direction(radical_inverse(2, index), radical_inverse(3, index)), 0.3F,
            glm::vec2(0.5F), rooms.builder.scene.bounds.centre(),
            glm::length(rooms.builder.scene.bounds.extent()));
        for (const auto& [a, b] : painter_pairs(rooms.builder.mesh, window)) {
            leaks += (a < rooms.dark) != (b < rooms.dark) ? 1 : 0;
            ++all;
        }
    }
    return static_cast<double>(leaks) / static_cast<double>(all);
}

/// Largest irradiance of the dark room in our solution.
float dark_irradiance(const TwoRooms& rooms, const StrategyProbabilities& probabilities) {
    SolverSettings settings;
    settings.probabilities = probabilities;
    settings.coarse = {64, 160};
    Solver solver(rooms.builder.scene, rooms.builder.mesh, settings);
    while (solver.iterations() < 128) {
        solver.step({});
    }
    const auto irradiance = solver.store().read_irradiance();
    float lit = 0.0F;
    float dark = 0.0F;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        float& largest = i < rooms.dark ? lit : dark;
        largest = std::max(largest, irradiance[i].x);
    }
    EXPECT_GT(lit, 0.1F);  // there is light that could leak
    return dark;
}

TEST(PaintersAlgorithm, LeaksThroughAThinWall) {
    EXPECT_GT(leaking_share(TwoRooms(0.001F), 16), 1e-3);
}

TEST(PaintersAlgorithm, OursKeepTheSameRoomDark) {
    const TwoRooms rooms(0.001F);
    EXPECT_EQ(dark_irradiance(rooms, {1.0F, 0.0F, 0.0F}), 0.0F);
    EXPECT_EQ(dark_irradiance(rooms, {0.0F, 1.0F, 0.0F}), 0.0F);
    EXPECT_EQ(dark_irradiance(rooms, {0.0F, 0.0F, 1.0F}), 0.0F);
    EXPECT_EQ(dark_irradiance(rooms, {0.15F, 0.15F, 0.7F}), 0.0F);
}

/// Guards the example itself: apart, the rooms are told apart by any order of depths.
TEST(PaintersAlgorithm, DoesNotLeakThroughAThickWall) {
    EXPECT_LT(leaking_share(TwoRooms(3.0F), 16), 1e-3);
}

}  // namespace
}  // namespace raybundle::painter_test
