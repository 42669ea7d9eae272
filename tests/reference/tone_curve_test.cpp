// SPDX-License-Identifier: Apache-2.0
#include "view/image/tone_curve.h"

#include <gtest/gtest.h>

namespace raybundle {
namespace {

TEST(ToneCurve, ExposureIsThatOfTheLogarithmicMean) {
    const std::vector<glm::dvec3> picture = {glm::dvec3(10.0), glm::dvec3(1000.0), glm::dvec3(7.0)};
    EXPECT_NEAR(automatic_display_factor(picture, {true, true, false}), 0.18 / 100.0, 1e-12);
    EXPECT_NEAR(automatic_display_factor(picture, {false, false, false}), 0.18, 1e-12);
}

TEST(ToneCurve, GivesSrgbBytes) {
    const std::vector<glm::dvec3> picture = {{0.0, 0.18, 6.0}, {-1.0, 1e9, 1.0}};
    const std::vector<std::uint8_t> rgba = tone_mapped(picture, 1.0);
    // shoulder(0.18) = 0.1533, sRGB 0.4289; shoulder(6) = 1; shoulder(1) = 0.5139, sRGB 0.7447.
    const std::vector<std::uint8_t> expected = {0, 109, 255, 255, 0, 255, 190, 255};
    EXPECT_EQ(rgba, expected);
}

}  // namespace
}  // namespace raybundle
