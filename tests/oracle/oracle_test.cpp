// SPDX-License-Identifier: Apache-2.0
#include "oracle/oracles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "hard_rooms.h"
#include "methods.h"

namespace raybundle::oracle_test {
namespace {

class ClosedForm : public testing::TestWithParam<Oracle> {};

TEST_P(ClosedForm, HoldsWithinItsBound) {
    const OracleResult result = GetParam().run();
    EXPECT_NEAR(result.measured, result.expected, result.bound);
    EXPECT_TRUE(result.passed);
}

std::string test_name(const testing::TestParamInfo<Oracle>& info) {
    std::string name;
    for (const char c : info.param.name) {
        name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    return name;
}

INSTANTIATE_TEST_SUITE_P(Selftest, ClosedForm, testing::ValuesIn(all_oracles()), test_name);

/// An oracle must be able to fail: densities wrong by 2 % leave the bound of 0.5 %.
TEST(ClosedFormSensitivity, DensityWrongByTwoPercentIsCaught) {
    OracleSettings settings;
    settings.iterations = 2048;
    settings.density_error = 1.02F;
    EXPECT_LT(furnace_mean(0.5F, settings), 1.0 - 0.005);
}

TEST(HeavyClosedFormSensitivity, DensityTooSmallByTwoPercentIsCaught) {
    OracleSettings settings;
    settings.iterations = 2048;
    settings.density_error = 0.98F;
    EXPECT_GT(furnace_mean(0.5F, settings), 1.0 + 0.005);
}

/// The same for bundles split by a plane, alone and among all strategies.
TEST(HeavyClosedFormSensitivity, DensityWrongByTwoPercentIsCaughtWithPlanes) {
    for (const StrategyProbabilities& p :
         {StrategyProbabilities{0.0F, 1.0F, 0.0F}, StrategyProbabilities{0.15F, 0.15F, 0.7F}}) {
        OracleSettings settings;
        settings.probabilities = p;
        const bool alone = p.plane == 1.0F;
        const float albedo = alone ? 0.0F : 0.5F;  // as in the oracles that catch it
        settings.iterations = alone ? 6144 : 3072;
        settings.density_error = 1.02F;
        EXPECT_LT(furnace_mean(albedo, settings), 1.0 - 0.005);
        settings.density_error = 0.98F;
        EXPECT_GT(furnace_mean(albedo, settings), 1.0 + 0.005);
    }
}

struct ThinWallCase {
    StrategyProbabilities probabilities;
    float thickness;  // m
};

class ThinWall : public testing::TestWithParam<ThinWallCase> {};

TEST_P(ThinWall, KeepsTheDarkRoomExactlyDark) {
    OracleSettings settings;
    settings.iterations = 256;
    settings.resolution = {128, 200};
    settings.probabilities = GetParam().probabilities;
    EXPECT_EQ(dark_room_irradiance(GetParam().thickness, settings), 0.0);
}

constexpr StrategyProbabilities only_parallel{1.0F, 0.0F, 0.0F};
constexpr StrategyProbabilities only_planes{0.0F, 1.0F, 0.0F};
constexpr StrategyProbabilities only_perspective{0.0F, 0.0F, 1.0F};
constexpr StrategyProbabilities all_three{0.15F, 0.15F, 0.7F};
INSTANTIATE_TEST_SUITE_P(
    Strategies, ThinWall,
    testing::Values(ThinWallCase{only_parallel, 0.0F}, ThinWallCase{only_parallel, 1e-6F},
                    ThinWallCase{only_parallel, 1e-3F}, ThinWallCase{only_parallel, 0.1F},
                    ThinWallCase{only_planes, 0.0F}, ThinWallCase{only_planes, 1e-6F},
                    ThinWallCase{only_planes, 1e-3F}, ThinWallCase{only_planes, 0.1F},
                    ThinWallCase{all_three, 0.0F}, ThinWallCase{all_three, 1e-6F},
                    ThinWallCase{all_three, 1e-3F}, ThinWallCase{all_three, 0.1F},
                    ThinWallCase{only_perspective, 0.0F}, ThinWallCase{only_perspective, 1e-6F},
                    ThinWallCase{only_perspective, 1e-3F}, ThinWallCase{only_perspective, 0.1F}));

/// Slivers that the rasteriser turns over face the lit room behind the wall.
TEST(ThinWallOfSlivers, KeepsTheDarkRoomExactlyDark) {
    const StripedWall wall = striped_wall(0.0F, 1500);
    for (const Method& method : {layered(), plane(), perspective()}) {
        OracleSettings settings;
        settings.iterations = 128;
        const auto found = irradiance_by(method, wall.builder, settings);
        EXPECT_GT(found[0], 0.0) << "no light that could leak";
        EXPECT_TRUE(std::all_of(found.begin() + static_cast<std::ptrdiff_t>(wall.first_dark),
                                found.end(), [](double e) { return e == 0.0; }))
            << method.name;
    }
}

TEST(Determinism, AnotherSeedGivesOtherBits) {
    // Guards the comparison itself: it must be able to see a difference.
    OracleSettings settings;
    settings.iterations = 64;
    EXPECT_EQ(differing_bits(settings), 0U);
    OracleSettings other = settings;
    other.seed = settings.seed + 1;
    EXPECT_NE(furnace_mean(0.5F, settings), furnace_mean(0.5F, other));
}

}  // namespace
}  // namespace raybundle::oracle_test
