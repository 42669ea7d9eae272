// SPDX-License-Identifier: Apache-2.0
#include "research/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "research/photon_tracer.h"
#include "rooms.h"

namespace raybundle {
namespace {

using std::numbers::pi;

/// Photons in the unit cube, normals up or down.
std::vector<Photon> random_photons(int count) {
    RandomStream random(1, 0);
    std::vector<Photon> photons(static_cast<std::size_t>(count));
    for (Photon& photon : photons) {
        const glm::dvec2 at = random.next_pair();
        photon.position = {at.x, random.next(), at.y};
        photon.normal = {0.0F, random.next() < 0.7 ? 1.0F : -1.0F, 0.0F};
        photon.from = photon.normal;
        photon.power = glm::vec3(glm::dvec3(random.next()));
    }
    return photons;
}

/// The estimate by looking at every photon.
double brute_force(const std::vector<Photon>& photons, const SurfacePoint& point,
                   std::size_t nearest, double radius) {
    std::vector<std::pair<double, double>> found;  // squared distance, power
    for (const Photon& photon : photons) {
        const glm::dvec3 offset = glm::dvec3(photon.position) - point.position;
        const double square = glm::dot(offset, offset);
        if (square < radius * radius && photon.normal.y > 0.0F) {
            found.emplace_back(square, photon.power.g);
        }
    }
    std::sort(found.begin(), found.end());
    const bool full = found.size() >= nearest;
    double sum = 0.0;
    for (std::size_t i = 0; i < (full ? nearest - 1 : found.size()); ++i) {
        sum += found[i].second;
    }
    return sum / pi / (pi * (full ? found[nearest - 1].first : radius * radius));
}

/// Surfaces of albedo 1 reflect 1/pi of the density; more photons than wanted, fewer, and none.
TEST(PhotonMap, FindsTheNearestPhotonsThatFaceTheSameWay) {
    const std::vector<Photon> photons = random_photons(5000);
    const PhotonMap map(photons);
    RandomStream random(2, 0);
    for (int i = 0; i < 300; ++i) {
        SurfacePoint point;
        const glm::dvec2 at = random.next_pair();
        point.position = {at.x, random.next(), at.y};
        point.normal = {0.0, 1.0, 0.0};
        const Scattering white = Scattering::white(point);
        for (const double radius : {0.3, 0.12, 0.01}) {
            const double exact = brute_force(photons, point, 40, radius);
            EXPECT_NEAR(map.reflected(point, white, 40, radius).g, exact, 1e-4 * exact) << radius;
        }
    }
    EXPECT_EQ(PhotonMap().reflected({}, Scattering::white({}), 40, 0.3), glm::dvec3(0.0));
}

/// In the middle of a wall of a furnace, away from edges, the estimate of the radiance has no bias.
/// 5.5 standard errors of 40 maps: passed by chance once in 400 000.
TEST(PhotonTracer, FurnaceHasItsRadianceAwayFromEdges) {
    constexpr double albedo = 0.6;
    const SceneBuilder room = furnace_room(static_cast<float>(albedo), 100.0F);
    const RayScene scene(room.scene, room.mesh);
    const LightSampling lights(scene);
    // The floor's point (1, 0, 1): at least 1 m from every wall.
    const auto below =
        scene.trace(scene.from_world(glm::vec3(odd_rotation() * glm::vec4(1.0F, 0.5F, 1.0F, 1.0F))),
                    glm::dvec3(odd_rotation() * glm::vec4(0.0F, -1.0F, 0.0F, 0.0F)));
    ASSERT_TRUE(below.has_value());
    const Scattering scattering(scene, *below, NormalKind::geometric, below->normal);
    PhotonSettings settings;
    settings.emitted = 1U << 14U;
    constexpr int maps = 40;
    double photons = 0.0;
    double mean = 0.0;
    double squares = 0.0;
    for (int i = 0; i < maps; ++i) {
        const PhotonMaps traced =
            trace_photons(scene, lights, settings, 5, static_cast<std::uint64_t>(i));
        EXPECT_EQ(traced.caustic.size(), 0U);
        const double value = traced.global.reflected(*below, scattering, 32, 0.05).g;
        mean += value / maps;
        squares += value * value / maps;
        photons += static_cast<double>(traced.global.size()) / maps;
    }
    const double error = std::sqrt((squares - mean * mean) / (maps - 1));
    const double exact = albedo * 100.0 / (1.0 - albedo);
    EXPECT_NEAR(mean, exact, 5.5 * error);
    EXPECT_LT(error, 0.05 * exact);
    // Every particle meets 1/(1 - albedo) walls in the mean.
    EXPECT_NEAR(photons / settings.emitted, 1.0 / (1.0 - albedo), 0.01 / (1.0 - albedo));
}

}  // namespace
}  // namespace raybundle
