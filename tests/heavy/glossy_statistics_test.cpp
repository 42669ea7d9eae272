// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "oracle/glossy_oracles.h"

namespace raybundle {
namespace {

/// Lamp - glossy floor - plate that sees no lamp, within 3 %: with 16 runs the bound is 4 standard
/// errors of the mean or more, and the error of the mean itself is checked.
TEST(GlossyStatistics, IlluminanceByAGlossyFloorIsRight) {
    constexpr int runs = 16;
    double sum = 0.0;
    double squares = 0.0;
    for (int run = 0; run < runs; ++run) {
        OracleSettings settings;
        settings.iterations = 12'288;
        settings.resolution = {64, 160};
        settings.probabilities = {0.6F, 0.0F, 0.4F};
        settings.seed = static_cast<std::uint64_t>(run) + 1;
        const GlossyReflection r = glossy_reflection(0.5F, settings);
        sum += r.solved / r.exact;
        squares += r.solved * r.solved / (r.exact * r.exact);
    }
    const double mean = sum / runs;
    const double error = std::sqrt((squares / runs - mean * mean) / (runs - 1));
    RecordProperty("mean", std::to_string(mean));
    EXPECT_LT(error, 0.0075);
    EXPECT_NEAR(mean, 1.0, 0.03);
}

}  // namespace
}  // namespace raybundle
