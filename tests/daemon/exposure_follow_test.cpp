// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/exposure_follow.h"

#include <gtest/gtest.h>

namespace raybundle {
namespace {

TEST(ExposureFollow, TakesAsLongHoweverManyFramesThereAre) {
    EXPECT_NEAR(exposure_follow(0.05), 0.15F, 1e-6F);
    EXPECT_NEAR(exposure_follow(0.001), 0.15F, 1e-6F) << "never stands still";
    // Ten frames in a second come as far as two, and as twenty.
    const float often = 1.0F - std::pow(1.0F - exposure_follow(0.05), 20.0F);
    const float seldom = 1.0F - std::pow(1.0F - exposure_follow(0.5), 2.0F);
    EXPECT_NEAR(often, seldom, 1e-5F);
    EXPECT_GT(exposure_follow(2.0), 0.99F) << "a slow server's next picture is right";
}

/// A page that comes back says at once how it wants to see, when its own picture has just begun:
/// that frame is no white one.
TEST(ShownExposure, OfAPictureThatHasJustBegunIsTheLastOne) {
    ShownExposure shown;
    EXPECT_EQ(shown.next(-5.5F, 0.1), -5.5F);
    shown.set(0.0F);
    EXPECT_EQ(shown.next(std::nullopt, 0.1), -5.5F);
    EXPECT_FALSE(shown.ev());
    EXPECT_EQ(shown.next(-7.0F, 0.01), -7.0F) << "what was set is there at once";
    shown.set(1.0F);
    EXPECT_EQ(shown.next(std::nullopt, 0.1), -6.0F);
    EXPECT_EQ(shown.last(), -6.0F);
}

TEST(ShownExposure, FollowsOnceItIsShown) {
    ShownExposure shown;
    EXPECT_EQ(shown.next(std::nullopt, 0.1), 0.0F);
    EXPECT_EQ(shown.next(-4.0F, 0.01), -4.0F);
    EXPECT_NEAR(shown.next(-5.0F, 0.05), -4.15F, 1e-5F);
}

}  // namespace
}  // namespace raybundle
