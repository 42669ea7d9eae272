// SPDX-License-Identifier: Apache-2.0
// What `selftest --photometry` runs.
#include "oracle/photometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raybundle {
namespace {

TEST(Photometry, EveryPointIsWithinItsInterval) {
    const std::vector<PhotometryPoint> points = run_photometry();
    EXPECT_GE(points.size(), 30U);
    for (const PhotometryPoint& point : points) {
        EXPECT_TRUE(point.passed) << point.name << ": " << point.measured.value << ", exact "
                                  << point.exact;
        EXPECT_LT(std::abs(point.deviation()), 0.005) << point.name;
    }
}

}  // namespace
}  // namespace raybundle
