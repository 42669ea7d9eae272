// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>

#include "report/floor_area.h"

namespace raybundle {
namespace {

/// Solid boxes with fronts outwards, an object each.
struct Building {
    Scene scene;

    Building() { scene.materials.resize(1); }
    void box(const glm::vec3& low, const glm::vec3& high) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (unsigned i = 0; i < 8; ++i) {
            Vertex vertex;
            vertex.position = {(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                               (i & 4U) != 0 ? high.z : low.z};
            scene.vertices.push_back(vertex);
            scene.bounds.add(vertex.position);
        }
        constexpr std::array<std::array<std::uint32_t, 4>, 6> faces = {
            {{0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
        for (const auto& face : faces) {
            for (const auto& [b, c] : {std::pair(1, 2), std::pair(2, 3)}) {
                Triangle triangle;
                triangle.object = static_cast<std::uint32_t>(scene.objects.size());
                triangle.vertex[0] = first + face[0];
                triangle.vertex[1] = first + face[static_cast<std::size_t>(b)];
                triangle.vertex[2] = first + face[static_cast<std::size_t>(c)];
                scene.triangles.push_back(triangle);
            }
        }
        scene.objects.emplace_back();
    }
    /// A storey 3 m high on a slab of 0.2 m: rooms of 5 x 4 m and 3 x 4 m within walls of 0.2 m, a
    /// doorway of 1 m between them, closed or not. Without the ceiling.
    void storey(float y, bool closed) {
        box({-0.2F, y - 0.2F, -0.2F}, {8.4F, y, 4.2F});
        for (const float x : {-0.2F, 8.2F}) {
            box({x, y, -0.2F}, {x + 0.2F, y + 3.0F, 4.2F});
        }
        for (const float z : {-0.2F, 4.0F}) {
            box({0, y, z}, {8.2F, y + 3.0F, z + 0.2F});
        }
        box({5, y, 0}, {5.2F, y + 3.0F, closed ? 4.0F : 3.0F});
    }
};

/// 20 m² with a table in it, whose other room of 12 m² counts where one can go there, and the
/// storey above and the land around do not.
TEST(FloorArea, IsThatOfRoomsWithLuminaires) {
    for (const bool closed : {true, false}) {
        Building building;
        building.storey(0.0F, closed);
        building.storey(3.2F, true);
        building.box({-0.2F, 6.2F, -0.2F}, {8.4F, 6.4F, 4.2F});
        building.box({-10, -0.5F, -10}, {15, -0.2F, 12});
        building.box({1, 0.7F, 1}, {3, 0.75F, 2});
        const std::array lamps = {glm::vec3(2, 2.9F, 1.5F), glm::vec3(4, 3.05F, 1)};
        EXPECT_NEAR(floor_area(building.scene, lamps), closed ? 20.0 : 32.2, 1.0);
        const std::array outside = {glm::vec3(-5, 2, -5)};
        EXPECT_EQ(floor_area(building.scene, outside), 0.0);
        EXPECT_EQ(floor_area(building.scene, {}), 0.0);
    }
}

}  // namespace
}  // namespace raybundle
