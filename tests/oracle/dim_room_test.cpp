// SPDX-License-Identifier: Apache-2.0
// A dim room beside one that is a million times brighter is as good as beside one like itself.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hard_rooms.h"
#include "methods.h"
#include "solution/store/shooting_shares.h"

namespace raybundle::dim_room_test {
namespace {

ZoneFlux zone(double area, double emitted, double reflected) {
    ZoneFlux z;
    z.area = area;
    z.emitted = glm::dvec3(emitted);
    z.reflected = glm::dvec3(reflected);
    z.albedo = glm::dvec3(0.5);
    return z;
}

TEST(ShootingFactors, ShareHalfOfAllShootersByArea) {
    const std::vector<ZoneFlux> zones = {zone(10.0, 1e6, 1e6), zone(30.0, 1.0, 0.0),
                                         zone(60.0, 0.0, 0.0)};
    const std::vector<ZoneLevel> levels(3);
    const std::vector<float> factors = shooting_factors(zones, levels);
    const double all = 2e6 + 1.0;
    EXPECT_NEAR(static_cast<double>(factors[0]) * 2e6 / all, 0.5 * (2e6 / all + 0.1), 1e-6);
    EXPECT_NEAR(static_cast<double>(factors[1]) * 1.0 / all, 0.5 * (1.0 / all + 0.3), 1e-6);
    EXPECT_EQ(factors[2], 1.0F) << "nothing to shoot";
    const std::vector<ZoneFlux> single = {zone(10.0, 3.0, 4.0)};
    EXPECT_EQ(shooting_factors(single, std::vector<ZoneLevel>(1)).front(), 1.0F);
}

/// A terrain at night, or what is hidden below furniture, takes nothing from the room beside it.
TEST(ShootingFactors, LeaveOutWhatBelongsToNoRoom) {
    std::vector<ZoneFlux> zones = {zone(10.0, 1.0, 1.0), zone(1e6, 0.0, 1e-3)};
    zones[1].loose = true;
    const std::vector<float> factors = shooting_factors(zones, std::vector<ZoneLevel>(2));
    EXPECT_EQ(factors[0], 1.0F);
    EXPECT_EQ(factors[1], 1.0F);
}

TEST(ShootingFactors, FollowTheNewLevels) {
    const std::vector<ZoneFlux> zones = {zone(1.0, 0.0, 4.0), zone(1.0, 0.0, 4.0)};
    std::vector<ZoneLevel> levels(2);
    levels[1].scale = glm::dvec3(0.0);
    levels[1].offset = glm::dvec3(2.0);  // reflected: 1
    const std::vector<float> factors = shooting_factors(zones, levels);
    EXPECT_NEAR(factors[0], 0.5 * (1.0 + 0.5 * 5.0 / 4.0), 1e-6);
    EXPECT_NEAR(factors[1], 0.5 * (1.0 + 0.5 * 5.0 / 1.0), 1e-6);
}

/// Relative noise of the dim room's patches, from differences between runs.
double noise_beside(float ratio) {
    const KnownScene scene = bright_and_dim_room(ratio);
    const KnownPatches& dim = scene.known.front();
    OracleSettings settings;
    settings.iterations = 256;
    double sum = 0.0;
    double count = 0.0;
    std::vector<double> last;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        settings.seed = seed;
        const auto found = irradiance_by(combined(), scene.builder, settings);
        for (std::size_t i = dim.first; i < dim.last && !last.empty(); ++i) {
            const double difference = (found[i] - last[i]) / dim.irradiance;
            sum += 0.5 * difference * difference;
            count += 1.0;
        }
        last = found;
    }
    return std::sqrt(sum / count);
}

/// It has half of all shooters beside a bright room as beside one like itself, and the noise of
/// five runs is known to some 15 %. By power alone it had four times as much.
TEST(DimRoom, BesideABrightOneIsNearlyAsGoodAsAlone) {
    EXPECT_LT(noise_beside(1e6F), 1.7 * noise_beside(1.0F));
}

}  // namespace
}  // namespace raybundle::dim_room_test
