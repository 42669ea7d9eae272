// SPDX-License-Identifier: Apache-2.0
#include "reference/measures/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace raybundle {
namespace {

using Picture = std::vector<glm::dvec3>;

TEST(ImageMetrics, AreWhatTheirDefinitionsSay) {
    const Picture reference = {{1, 1, 1}, {2, 2, 2}, {0, 0, 0}, {5, 4, 3}};
    const Picture image = {{1.1, 1, 1}, {2, 1.8, 2}, {0.1, 0.1, 0.1}, {5, 4, 3}};
    const ImageMetrics m = compare_images(image, reference, std::vector<bool>(4, true));
    EXPECT_EQ(m.pixels, 4U);
    EXPECT_NEAR(m.relative_rmse, std::sqrt((0.01 + 0.04 + 0.03) / (3 + 12 + 50)), 1e-12);
    const double mean = 21.0 / 12.0;
    const auto term = [mean](double difference, double r) {
        return std::pow(difference / mean / (r / mean + 0.01), 2);
    };
    EXPECT_NEAR(m.mrse, (term(0.1, 1) + term(0.2, 2) + 3 * term(0.1, 0)) / 12.0, 1e-12);
    // Luminance errors: 0.02126, 0.07152, 0.1 / (1e-3 mean luminance), 0.
    EXPECT_NEAR(m.median, 0.02126, 1e-9);
    const double lum = 5 * 0.2126 + 4 * 0.7152 + 3 * 0.0722;
    EXPECT_NEAR(m.p95, 0.1 / (1e-3 * (3.0 + lum) / 4.0), 1e-6);
}

TEST(ImageMetrics, LeaveOutWhatIsNotMeasured) {
    const Picture reference = {{1, 1, 1}, {2, 2, 2}};
    const Picture image = {{1, 1, 1}, {9, 9, 9}};
    const ImageMetrics m = compare_images(image, reference, {true, false});
    EXPECT_EQ(m.relative_rmse, 0.0);
    EXPECT_EQ(m.pixels, 1U);
}

TEST(ImageMetrics, RefusePicturesThatCannotBeMeasured) {
    const Picture grey(2, glm::dvec3(1.0));
    const Picture black(2, glm::dvec3(0.0));
    Picture broken = grey;
    broken[1].b = std::numeric_limits<double>::quiet_NaN();
    const std::vector<bool> all(2, true);
    EXPECT_THROW((void)compare_images(grey, grey, {false, false}), std::invalid_argument);
    EXPECT_THROW((void)compare_images(grey, black, all), std::invalid_argument);
    EXPECT_THROW((void)compare_images(Picture(3), grey, all), std::invalid_argument);
    // A value that is not finite counts even where nothing is measured.
    EXPECT_THROW((void)compare_images(broken, grey, {true, false}), std::invalid_argument);
    EXPECT_THROW((void)compare_images(grey, broken, {true, false}), std::invalid_argument);
}

TEST(EmitterMask, LeavesOutEmittersAndTheirEightNeighbours) {
    // An emitter in the corner and one inside a picture of 5 x 4.
    std::vector<bool> emitters(20, false);
    emitters[0] = true;
    emitters[2 * 5 + 3] = true;
    const std::vector<bool> measured = without_emitters(emitters, {5, 4});
    std::string found;
    for (const bool m : measured) {
        found += m ? '#' : ' ';
    }
    // (3, 2) takes columns 2..4 of rows 1..3.
    EXPECT_EQ(found,
              "  ###"
              "     "
              "##   "
              "##   ");
}

}  // namespace
}  // namespace raybundle
