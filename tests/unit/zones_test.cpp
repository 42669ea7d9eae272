// SPDX-License-Identifier: Apache-2.0
// Zones of a scene, and their levels by energy conservation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>
#include <vector>

#include "bare_rooms.h"
#include "zones/exchange_rays.h"
#include "zones/first_reflection.h"
#include "zones/kept_light.h"
#include "zones/zone_levels.h"
#include "zones/zone_partition.h"

namespace raybundle {
namespace {

TEST(ExchangeRays, StayInAClosedRoom) {
    Rooms rooms;
    rooms.room({0, 0, 0}, {4, 3, 5});
    const ExchangeRays rays = rooms.rays();
    const std::vector<ExchangeRay> traced = rays.trace();
    double area = 0.0;
    for (const ExchangeRay& ray : traced) {
        ASSERT_NE(ray.to, ExchangeRay::lost);
        area += static_cast<double>(ray.area);
    }
    EXPECT_NEAR(area, 94.0, 0.1);  // what all rays stand for
}

/// Form factors of the unit cube (Howell, C-11): 0.199825 of opposite faces.
TEST(ExchangeRays, FollowTheFormFactorsOfACube) {
    Rooms rooms;
    rooms.room({0, 0, 0}, {1, 1, 1});
    const ExchangeRays rays = rooms.rays();
    double between = 0.0;
    double all = 0.0;
    for (const ExchangeRay& ray : rays.trace()) {
        const glm::vec3& from = rays.normals()[ray.from];
        all += static_cast<double>(ray.area);
        between +=
            glm::dot(from, rays.normals()[ray.to]) < -0.5F ? static_cast<double>(ray.area) : 0.0;
    }
    // 8192 rays: three standard deviations are 0.013.
    EXPECT_NEAR(between / all, 0.199825, 0.013);
}

/// Walls without thickness, back to back: whatever a ray meets first, it is the side that faces it.
TEST(ExchangeRays, DoNotGoThroughWallsWithoutThickness) {
    Rooms rooms;
    rooms.room({0, 0, 0}, {3, 3, 3});
    const std::size_t first = rooms.mesh.patch_count();
    rooms.room({3, 0, 0}, {6, 3, 3}, false, 7);
    for (const ExchangeRay& ray : rooms.rays().trace()) {
        ASSERT_NE(ray.to, ExchangeRay::lost);
        EXPECT_EQ(ray.from < first, ray.to < first);
    }
}

/// A lamp a little below a ceiling, in a shade that lets nothing out: what is near each other, and
/// faces the same way, may see nothing in common.
TEST(Zones, TellTheInsideOfAClosedShadeFromTheRoom) {
    Rooms rooms;
    const auto shade = [&rooms](float margin) {
        const glm::vec3 low = glm::vec3(1.3F, 3.6F, 1.3F) - margin;
        const glm::vec3 high = glm::vec3(2.7F, 3.98F, 2.7F) + glm::min(margin, 0.01F);
        return std::pair(low, high);
    };
    const std::size_t first_inside = rooms.mesh.patch_count();
    rooms.room(shade(0.0F).first, shade(0.0F).second, false, 5);
    rooms.quad({1.5F, 3.9F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 4);  // the lamp
    const std::size_t first_outside = rooms.mesh.patch_count();
    rooms.room({0, 0, 0}, {4, 4, 4}, false, 14);
    rooms.room({10, 0, 0}, {14, 4, 4}, false, 14);
    const auto [low, high] = shade(0.05F);
    const glm::vec3 e = high - low;
    rooms.quad(low, {e.x, 0, 0}, {0, 0, e.z}, 6);  // the shade from below, and from its sides
    rooms.quad(low, {0, e.y, 0}, {e.x, 0, 0}, 6);
    rooms.quad(low, {0, 0, e.z}, {0, e.y, 0}, 6);
    rooms.quad(low + glm::vec3(0, 0, e.z), {e.x, 0, 0}, {0, e.y, 0}, 6);
    rooms.quad(low + glm::vec3(e.x, 0, 0), {0, e.y, 0}, {0, 0, e.z}, 6);
    const ExchangeRays rays = rooms.rays();
    const ZonePartition zones = find_zones(rays, rays.trace());
    const unsigned room = zones.zone[first_outside];
    for (std::size_t patch = first_inside; patch < first_outside; ++patch) {
        EXPECT_NE(zones.zone[patch], room) << patch;
    }
}

TEST(Zones, AreTheRoomsOfABuilding) {
    Rooms rooms;
    std::vector<std::size_t> first;
    for (int i = 0; i < 5; ++i) {
        first.push_back(rooms.mesh.patch_count());
        rooms.room({3.2F * static_cast<float>(i), 0, 0}, {3.2F * static_cast<float>(i) + 3, 3, 4});
    }
    const ExchangeRays rays = rooms.rays();
    const ZonePartition zones = find_zones(rays, rays.trace());
    EXPECT_EQ(zones.count, 5U);
    for (std::size_t i = 0; i < first.size(); ++i) {
        const std::size_t end = i + 1 < first.size() ? first[i + 1] : rooms.mesh.patch_count();
        for (std::size_t patch = first[i]; patch < end; ++patch) {
            EXPECT_EQ(zones.zone[patch], zones.zone[first[i]]) << i;
        }
    }
}

/// Four patches have one ray between them: those without any belong to the rooms that they are in,
/// not to what lies outside.
TEST(Zones, HoldPatchesWithoutRays) {
    Rooms rooms;
    std::vector<std::size_t> first;
    for (int i = 0; i < 16; ++i) {
        first.push_back(rooms.mesh.patch_count());
        const float x = 3.2F * static_cast<float>(i % 4);
        const float z = 4.2F * static_cast<float>(i / 4);
        rooms.room({x, 0, z}, {x + 3, 3, z + 4}, false, 37);
    }
    first.push_back(rooms.mesh.patch_count());
    const ExchangeRays rays = rooms.rays();
    const std::vector<ExchangeRay> traced = rays.trace();
    ASSERT_GT(rooms.mesh.patch_count(), 4 * traced.size() / 2);
    const ZonePartition zones = find_zones(rays, traced);
    EXPECT_FALSE(zones.loose.has_value());
    std::vector<std::size_t> room_of(zones.count, first.size());
    std::size_t strays = 0;
    for (std::size_t room = 0; room + 1 < first.size(); ++room) {
        for (std::size_t patch = first[room]; patch < first[room + 1]; ++patch) {
            std::size_t& owner = room_of[zones.zone[patch]];
            owner = owner == first.size() ? room : owner;
            strays += owner != room ? 1U : 0U;
        }
    }
    EXPECT_LT(strays, rooms.mesh.patch_count() / 1000);
}

/// A patch whose only ray goes out through a door belongs to its room all the same.
TEST(Zones, HoldPatchesWhoseFewRaysAreLost) {
    Rooms rooms;
    for (int i = 0; i < 16; ++i) {
        const float x = 8.0F * static_cast<float>(i % 4);
        const float z = 8.0F * static_cast<float>(i / 4);
        rooms.room({x, 0, z}, {x + 3, 3, z + 4}, true, 37);
    }
    const ExchangeRays rays = rooms.rays();
    const std::vector<ExchangeRay> traced = rays.trace();
    const auto lost = std::count_if(traced.begin(), traced.end(), [](const ExchangeRay& ray) {
        return ray.to == ExchangeRay::lost;
    });
    ASSERT_GT(static_cast<double>(lost), 0.02 * static_cast<double>(traced.size()));
    const ZonePartition zones = find_zones(rays, traced);
    const auto loose = zones.loose ? std::count(zones.zone.begin(), zones.zone.end(), *zones.loose)
                                   : std::ptrdiff_t{0};
    EXPECT_LT(static_cast<double>(loose), 0.01 * static_cast<double>(rooms.mesh.patch_count()));
}

/// X = (emitted + rho X) in a closed zone: the level is exact, whatever the iterate was.
TEST(ZoneLevels, OfAClosedRoomAreThoseOfEnergyConservation) {
    ZoneLevels levels(1);
    std::vector<ZoneFlux> zones(1);
    zones[0] = {.incident = glm::dvec3(10.0),
                .reflected = glm::dvec3(7.0),
                .emitted = glm::dvec3(3.0),
                .albedo = glm::dvec3(0.7),
                .area = 5.0};
    const std::vector<ZoneExchange> exchange = {{.from = 0,
                                                 .to = 0,
                                                 .reflected = glm::dvec3(7.0),
                                                 .emitted = glm::dvec3(3.0),
                                                 .squares = 0.1,
                                                 .rays = 1000.0}};
    const std::vector<ZoneSky> sky(1);
    const std::vector<ZoneLevel> found = levels.solve(zones, exchange, sky);
    EXPECT_NEAR(levels.incident()[0].g, 3.0 / (1.0 - 0.7), 1e-9);
    EXPECT_NEAR(found[0].scale.g * 10.0, 10.0, 1e-9);
    zones[0].incident = glm::dvec3(0.0);
    zones[0].reflected = glm::dvec3(0.0);
    const std::vector<ZoneLevel> fresh = ZoneLevels(1).solve(zones, exchange, sky);
    EXPECT_NEAR(fresh[0].offset.g * zones[0].area, 10.0, 1e-9);  // spread evenly where none is yet
}

/// A dark closed room beside a lit one stays exactly dark.
TEST(ZoneLevels, BringNothingWhereNothingEnters) {
    ZoneLevels levels(2);
    std::vector<ZoneFlux> zones(2);
    for (ZoneFlux& zone : zones) {
        zone.albedo = glm::dvec3(0.7);
        zone.area = 10.0;
    }
    zones[0].emitted = glm::dvec3(3.0);
    const std::vector<ZoneExchange> exchange = {
        {.from = 0, .to = 0, .emitted = glm::dvec3(3.0), .squares = 0.1, .rays = 1000.0},
        {.from = 1, .to = 1, .rays = 1000.0}};
    levels.solve(zones, exchange, std::vector<ZoneSky>(2));
    EXPECT_GT(levels.incident()[0].g, 9.0);
    EXPECT_EQ(levels.incident()[1], glm::dvec3(0.0));
}

/// What has been kept is ten times too bright: it is brought to what enters the zone, and is worth
/// next to nothing. What is right keeps its weight.
/// E[x / (x + 1)] of chi² with one degree of freedom is 1 - sqrt(pi/2) exp(1/2) erfc(sqrt(1/2)).
TEST(KeptLight, NoiseOfSamplesFollowsFromWhatMostPatchesDifferBy) {
    EXPECT_NEAR(variance_of_samples(0.34432, 0.16), 0.16, 1e-4);
    EXPECT_NEAR(variance_of_samples(1e-3, 0.16), 1e-3 * 0.16, 2e-5);  // the mean itself where small
    double chance = 0.0;
    constexpr int steps = 20000;  // of the distribution of a normal variable, variance 0.5
    for (int i = 0; i < steps; ++i) {
        const double z = 12.0 * (i + 0.5) / steps - 6.0;
        const double q = 0.5 * z * z;
        chance +=
            12.0 / steps * std::exp(-0.5 * z * z) / std::sqrt(2.0 * 3.14159265) * q / (q + 0.16);
    }
    EXPECT_NEAR(variance_of_samples(chance, 0.16), 0.5, 1e-3);
}

TEST(KeptLight, IsBelievedAsFarAsTheLevelsBearItOut) {
    ZoneLevels levels(1);
    std::vector<ZoneFlux> zones(1);
    zones[0] = {.incident = glm::dvec3(10.0),
                .reflected = glm::dvec3(7.0),
                .emitted = glm::dvec3(3.0),
                .albedo = glm::dvec3(0.7),
                .area = 5.0};
    const std::vector<ZoneExchange> exchange = {{.from = 0,
                                                 .to = 0,
                                                 .reflected = glm::dvec3(7.0),
                                                 .emitted = glm::dvec3(3.0),
                                                 .squares = 0.1,
                                                 .rays = 1000.0}};
    levels.solve(zones, exchange, std::vector<ZoneSky>(1));
    KeptLight right;
    const std::vector<ZoneMeans> near = {{.kept = glm::dvec3(10.05), .since = {}, .area = 5.0}};
    EXPECT_GT(right.judge(near, levels)[0].limit, 1000.0);
    EXPECT_EQ(right.doubt(), 0.0);
    KeptLight wrong;
    const std::vector<ZoneMeans> far = {{.kept = glm::dvec3(100.0), .since = {}, .area = 5.0}};
    const KeptLevel level = wrong.judge(far, levels)[0];
    EXPECT_NEAR(level.scale.g, 0.1, 0.01);
    EXPECT_LT(level.limit, 0.01);
    EXPECT_EQ(wrong.doubt(), 1.0);  // nothing is known of the new light yet
}

/// Each patch is a cell of its own, in one zone.
ZonePartition single_patches(std::uint32_t count) {
    ZonePartition partition;
    partition.count = 1;
    partition.zone.assign(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        partition.cluster.push_back(i);
    }
    partition.clusters = count;
    return partition;
}

/// Two plates of 1 m² with one ray from each to the other: all that one sends arrives at the other.
/// The first one emits e. Of light that has been reflected once or more the second one gets
/// e (r0 r1 + (r0 r1)² + ...), the first one r1 e (1 + r0 r1 + ...).
TEST(FirstReflection, OfTwoPlatesIsAGeometricSeries) {
    const std::vector<ExchangeRay> rays = {{0, 1, 1.0F, {}}, {1, 0, 1.0F, {}}};
    const std::vector<float> areas = {1.0F, 1.0F};
    const std::vector<double> density = {1.0, 1.0};
    const std::vector<glm::vec4> emitted = {glm::vec4(2.0F), glm::vec4(0.0F)};
    // It ends where one more reflection changes all light by 1e-3. The terms shrink by either
    // albedo in turn, so that the rest is not quite a geometric series.
    constexpr float series_ends = 5e-3F;
    for (const float albedo : {0.2F, 0.7F, 0.99F}) {
        const std::vector<glm::vec3> colour = {glm::vec3(albedo), glm::vec3(0.5F * albedo)};
        const FirstReflection reflection(single_patches(2), rays, colour, areas, density);
        EXPECT_TRUE(reflection.matters());
        const std::vector<glm::vec4> light = reflection.irradiance(emitted, 1.0);
        const float both = 0.5F * albedo * albedo;
        const float of_first = 2.0F * 0.5F * albedo / (1.0F - both);
        const float of_second = 2.0F * both / (1.0F - both);
        EXPECT_NEAR(light[0].g, of_first, series_ends * of_first);
        EXPECT_NEAR(light[1].g, of_second, series_ends * of_second);
    }
}

/// Irradiance of the first of two plates of 1 m² that emit 1 and have one ray to each other, of
/// this area.
float of_two_plates(float albedo, float ray_area) {
    const std::vector<ExchangeRay> rays = {{0, 1, ray_area, {}}, {1, 0, ray_area, {}}};
    const FirstReflection reflection(
        single_patches(2), rays, std::vector<glm::vec3>(2, glm::vec3(albedo)),
        std::vector<float>(2, 1.0F), std::vector<double>(2, 1.0 / static_cast<double>(ray_area)));
    const std::vector<glm::vec4> light =
        reflection.irradiance(std::vector<glm::vec4>(2, glm::vec4(1.0F)), 1.0);
    EXPECT_FLOAT_EQ(light[1].g, light[0].g);
    return light[0].g;
}

/// The slowest mode of a furnace of albedo 0.99 is far from its end after the reflections that are
/// followed.
TEST(FirstReflection, WhatIsLeftOfTheSeriesIsAddedUp) {
    EXPECT_NEAR(of_two_plates(0.99F, 1.0F), 99.0F, 0.1F);
}

/// Few rays may tell of more light than a surface has room for. Here they have three times its
/// area, and what both plates sent each other would double with each reflection.
TEST(FirstReflection, IsBoundedWhereFewRaysSayTooMuch) {
    EXPECT_NEAR(of_two_plates(0.8F, 3.0F), 4.0F, 0.02F);
}

/// What belongs to no zone gets its light, too.
TEST(FirstReflection, ReachesWhatBelongsToNoZone) {
    ZonePartition partition = single_patches(3);
    partition.count = 2;
    partition.zone = {0, 0, 1};
    partition.loose = 1;
    const std::vector<ExchangeRay> rays = {{0, 1, 1.0F, {}}, {1, 2, 1.0F, {}}};
    const FirstReflection reflection(partition, rays, std::vector<glm::vec3>(3, glm::vec3(0.5F)),
                                     std::vector<float>(3, 1.0F), std::vector<double>(3, 1.0));
    std::vector<glm::vec4> emitted(3, glm::vec4(0.0F));
    emitted[0] = glm::vec4(1.0F);
    EXPECT_GT(reflection.irradiance(emitted, 1.0)[2].g, 0.0F);
}

/// A black surface is lit by what it sees, and what sees black surfaces or the sky alone gets none.
TEST(FirstReflection, ReachesWhatSeesSurfacesThatReflect) {
    const std::vector<ExchangeRay> rays = {{0, 1, 1.0F, {}},
                                           {1, 2, 1.0F, {}},
                                           {3, 2, 1.0F, {}},
                                           {4, ExchangeRay::lost, 1.0F, glm::vec3(5.0F)}};
    const std::vector<glm::vec3> colour = {glm::vec3(0.5F), glm::vec3(0.5F), glm::vec3(0.0F),
                                           glm::vec3(0.5F), glm::vec3(0.5F)};
    const std::vector<float> areas(5, 1.0F);
    const FirstReflection reflection(single_patches(5), rays, colour, areas,
                                     std::vector<double>(5, 1.0));
    std::vector<glm::vec4> emitted(5, glm::vec4(0.0F));
    emitted[0] = glm::vec4(1.0F);
    const std::vector<glm::vec4> light = reflection.irradiance(emitted, 1.0);
    EXPECT_GT(light[2].g, 0.0F) << "black, but lit by what it sees";
    EXPECT_EQ(light[3].g, 0.0F) << "sees a black surface";
    EXPECT_EQ(light[4].g, 0.0F) << "sees the sky";
}

/// Of the sky's light, which is in cd/m² and comes from all of a hemisphere, too.
TEST(FirstReflection, IsOfTheSkysLightToo) {
    const std::vector<ExchangeRay> rays = {{0, ExchangeRay::lost, 1.0F, glm::vec3(10.0F)},
                                           {1, 0, 1.0F, {}}};
    const std::vector<float> areas(2, 1.0F);
    const std::vector<glm::vec3> colour = {glm::vec3(0.5F), glm::vec3(0.0F)};
    const FirstReflection reflection(single_patches(2), rays, colour, areas,
                                     std::vector<double>{0.0, 1.0});
    const std::vector<glm::vec4> light =
        reflection.irradiance(std::vector<glm::vec4>(2, glm::vec4(0.0F)), 5.0);
    EXPECT_FLOAT_EQ(light[1].g, 0.5F * glm::pi<float>() * 10.0F / 5.0F);
}

/// Zones do not mix where a cluster reaches into two of them, as behind a thin wall.
TEST(FirstReflection, AClusterThatReachesIntoTwoZonesIsDivided) {
    ZonePartition partition = single_patches(3);
    partition.count = 2;
    partition.zone = {0, 0, 1};
    partition.cluster = {0, 1, 1};
    partition.clusters = 2;
    const std::vector<ExchangeRay> rays = {{0, 1, 1.0F, {}}, {1, 0, 1.0F, {}}};
    const std::vector<float> areas(3, 1.0F);
    const FirstReflection reflection(partition, rays, std::vector<glm::vec3>(3, glm::vec3(0.5F)),
                                     areas, std::vector<double>(3, 1.0));
    std::vector<glm::vec4> emitted(3, glm::vec4(0.0F));
    emitted[0] = glm::vec4(1.0F);
    const std::vector<glm::vec4> light = reflection.irradiance(emitted, 1.0);
    EXPECT_GT(light[1].g, 0.0F);
    EXPECT_EQ(light[2].g, 0.0F);
}

/// A floor below a black screen lacks nothing, and its samples weigh as if there were no
/// completion.
TEST(FirstReflection, DoesNotMatterWhereWhatReflectsSeesBlackSurfaces) {
    const std::vector<ExchangeRay> rays = {{0, 1, 1.0F, {}}, {0, ExchangeRay::lost, 1.0F, {}}};
    const std::vector<glm::vec3> colour = {glm::vec3(0.5F), glm::vec3(0.0F)};
    EXPECT_FALSE(FirstReflection(single_patches(2), rays, colour, std::vector<float>(2, 1.0F),
                                 std::vector<double>(2, 1.0))
                     .matters());
    EXPECT_FALSE(FirstReflection().matters());
}

TEST(FirstReflection, IsNothingWhereNoRaysAreKnown) {
    EXPECT_EQ(FirstReflection().irradiance(std::vector<glm::vec4>(1, glm::vec4(1.0F)), 1.0).at(0),
              glm::vec4(0.0F));
}

}  // namespace
}  // namespace raybundle
