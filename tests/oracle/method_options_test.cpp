// SPDX-License-Identifier: Apache-2.0
// Shares of the bundle strategies, and Russian roulette, as the command line says them.
#include "options/method_options.h"

#include <gtest/gtest.h>

#include "transport/strategy_mix.h"

namespace raybundle::method_options_test {
namespace {

TEST(MethodOptions, SharesAreThreeNumbersWhoseSumIsOne) {
    const auto shares = parse_shares("--shares", "0.15,0.15,0.7");
    ASSERT_TRUE(shares);
    EXPECT_FLOAT_EQ(shares->layered, 0.15F);
    EXPECT_FLOAT_EQ(shares->plane, 0.15F);
    EXPECT_FLOAT_EQ(shares->perspective, 0.7F);
    EXPECT_FALSE(parse_shares("--shares", ""));
    const auto rounded = parse_shares("--shares", "0.333,0.333,0.333");
    ASSERT_TRUE(rounded);
    EXPECT_FLOAT_EQ(rounded->layered + rounded->plane + rounded->perspective, 1.0F);
    for (const char* wrong : {"1", "1,0", "0.5,0.5,0.5", "1.5,-0.5,0", "nan,0,1", "0.5,,0.5",
                              "0.5,0,0.5,0", "0.5,0,0.5x", "0,0,0", "1e30,0,0"}) {
        EXPECT_THROW(parse_shares("--shares", wrong), UsageError) << wrong;
    }
}

TEST(MethodOptions, OptionsGoWithTheirMethods) {
    const auto check = [](const char* method, const char* shares, const char* roulette) {
        RenderOptions render;
        render.method = method;
        render.shares = shares;
        render.roulette = roulette;
        check_method_options(render, parse_method(method));
    };
    EXPECT_NO_THROW(check("combined", "0.3,0,0.7", ""));
    EXPECT_THROW(check("perspective", "0.3,0,0.7", ""), UsageError);
    EXPECT_THROW(check("path", "0.3,0,0.7", ""), UsageError);
    for (const char* roulette : {"optimum", "albedo", "throughput"}) {
        EXPECT_NO_THROW(check("path", "", roulette));
        EXPECT_NO_THROW(check("path-reuse", "", roulette));
        EXPECT_THROW(check("combined", "", roulette), UsageError);
        EXPECT_THROW(check("metropolis", "", roulette), UsageError);
    }
    EXPECT_THROW(check("path", "", "sometimes"), UsageError);
}

/// `--method perspective` once showed a room below a sky a quarter as bright as it is, and said
/// nothing.
TEST(MethodOptions, BundlesThatMissTheSkySaySo) {
    Scene below_sky;
    below_sky.sky_radiance = glm::vec3(1000.0F);
    EXPECT_FALSE(light_missed(below_sky, {0.0F, 0.0F, 1.0F}).empty());
    EXPECT_TRUE(light_missed(below_sky, {0.3F, 0.0F, 0.7F}).empty());
    EXPECT_TRUE(light_missed(below_sky, {0.0F, 1.0F, 0.0F}).empty());
    EXPECT_TRUE(light_missed(Scene{}, {0.0F, 0.0F, 1.0F}).empty());
}

}  // namespace
}  // namespace raybundle::method_options_test
