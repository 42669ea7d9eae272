// SPDX-License-Identifier: Apache-2.0
// Where rooms are open to the sky, as single rays tell.
#include "zones/sky_openings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

#include "bare_rooms.h"

namespace raybundle {
namespace {

constexpr std::size_t most = 8;

/// A room of 4 x 3 x 5 m whose wall at x = 4 m has windows of 1 x 1.2 m, 0.8 m above the floor.
Rooms room_with_windows(const std::vector<float>& at) {
    Rooms rooms;
    rooms.scene.sky_radiance = glm::vec3(100.0F);
    rooms.room({0, 0, 0}, {4, 3, 5}, true, 8);
    std::vector<Rooms::Hole> holes;
    for (const float z : at) {
        holes.push_back({z / 5.0F, (z + 1.0F) / 5.0F, 0.8F / 3.0F, 2.0F / 3.0F});
    }
    rooms.wall({4, 0, 0}, {0, 0, 5}, {0, 3, 0}, holes, 8);
    return rooms;
}

SkyOpenings openings_of(const Rooms& rooms) {
    const ExchangeRays rays = rooms.rays();
    const std::vector<ExchangeRay> traced = rays.trace();
    const ZonePartition partition = find_zones(rays, traced);
    std::vector<ExchangeRay> lost;
    std::vector<double> sent(partition.clusters, 0.0);
    for (const ExchangeRay& ray : traced) {
        sent[partition.cluster[ray.from]] += static_cast<double>(ray.area);
        if (ray.to == ExchangeRay::lost) {
            lost.push_back(ray);
        }
    }
    return find_sky_openings(rays, partition, lost, sent, most);
}

/// Each window has an opening that holds it and is hardly larger; turn: of the room, by which
/// openings are turned as well.
void expect_windows(const SkyOpenings& found, std::vector<float> windows,
                    const glm::mat3& turn = glm::mat3(1.0F)) {
    ASSERT_EQ(found.openings.size(), windows.size());
    const glm::mat3 back = glm::transpose(turn);
    float share = 0.0F;
    for (const SkyOpening& opening : found.openings) {
        share += opening.share;
        EXPECT_LT((back * opening.inward).x, -0.8F);
        glm::vec3 low(1e30F);
        glm::vec3 high(-1e30F);
        for (unsigned k = 0; k < 8; ++k) {
            glm::vec3 corner = opening.corner;
            for (unsigned axis = 0; axis < 3; ++axis) {
                corner += (k >> axis & 1U) != 0 ? opening.edges[axis] : glm::vec3(0.0F);
            }
            low = glm::min(low, back * corner);
            high = glm::max(high, back * corner);
        }
        EXPECT_LT(low.x, 4.0F);
        EXPECT_GT(high.x, 4.0F);
        EXPECT_LT(high.x - low.x, 1.0F);
        EXPECT_LT(low.y, 0.85F);
        EXPECT_GT(high.y, 1.95F);
        EXPECT_LT(high.y - low.y, 1.6F);
        EXPECT_LT(high.z - low.z, 1.4F);
        const auto window = std::find_if(windows.begin(), windows.end(), [&](float z) {
            return low.z < z + 0.05F && high.z > z + 0.95F;
        });
        ASSERT_NE(window, windows.end()) << low.z << " to " << high.z;
        windows.erase(window);
    }
    EXPECT_NEAR(share, 1.0F, 1e-5F);
}

TEST(SkyOpenings, AreTheWindowsOfARoom) {
    const SkyOpenings one = openings_of(room_with_windows({2.0F}));
    expect_windows(one, {2.0F});
    // All of the room's surfaces need them, but for the few per cent that see the sky.
    EXPECT_GT(one.odds, 0.92F);
    EXPECT_LE(one.odds, 1.0F);
    EXPECT_NEAR(one.probability(0.1F), 0.1F * one.odds / (1.0F + 0.1F * one.odds), 1e-6F);
    EXPECT_EQ(one.probability(1.0F), 0.25F) << "the rest is for what comes by other ways";
    ASSERT_FALSE(one.sheltered_areas.empty());
    const double sheltered =
        std::accumulate(one.sheltered_areas.begin(), one.sheltered_areas.end(), 0.0);
    EXPECT_NEAR(sheltered, 92.8, 4.0) << "the walls of 4 x 3 x 5 m, less the window";
    expect_windows(openings_of(room_with_windows({0.7F, 3.2F})), {0.7F, 3.2F});
}

TEST(SkyOpenings, AreAlongTheWallsOfATurnedRoom) {
    Rooms rooms = room_with_windows({0.7F, 3.2F});
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0F), 0.5F, glm::vec3(0, 1, 0));
    for (glm::vec3& position : rooms.mesh.positions) {
        position = glm::vec3(turn * glm::vec4(position, 1.0F));
    }
    expect_windows(openings_of(rooms), {0.7F, 3.2F}, glm::mat3(turn));
}

TEST(SkyOpenings, AreNoneWhereNoLightComesIn) {
    Rooms closed;
    closed.scene.sky_radiance = glm::vec3(100.0F);
    closed.room({0, 0, 0}, {4, 3, 5});
    EXPECT_TRUE(openings_of(closed).openings.empty());
    EXPECT_EQ(openings_of(closed).probability(1.0F), 0.0F);
    Rooms night = room_with_windows({2.0F});
    night.scene.sky_radiance = glm::vec3(0.0F);
    EXPECT_TRUE(openings_of(night).openings.empty());
}

}  // namespace
}  // namespace raybundle
