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

}  // namespace
}  // namespace raybundle
