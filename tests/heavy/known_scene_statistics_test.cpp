// SPDX-License-Identifier: Apache-2.0
// Closed forms patch by patch. Seeds are fixed.
#include <gtest/gtest.h>

#include "oracle/oracles.h"

namespace raybundle {
namespace {

/// Every patch of a furnace, not only their mean.
TEST(FurnaceStatistics, EveryPatchIsWithinTwoPercent) {
    OracleSettings settings;
    settings.iterations = 32'768;
    for (const float albedo : {0.5F, 0.9F}) {
        EXPECT_LT(furnace_worst(albedo, settings), 0.02) << albedo;
    }
}

}  // namespace
}  // namespace raybundle
