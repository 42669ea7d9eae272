// SPDX-License-Identifier: Apache-2.0
#include "reference/sampling/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <utility>

namespace raybundle {
namespace {

/// Known answers of the authors' library Random123 (kat_vectors).
TEST(Philox, GivesThePublishedWords) {
    using Words = std::array<std::uint32_t, 4>;
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
              (Words{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}));
    EXPECT_EQ(philox({~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}),
              (Words{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}));
    EXPECT_EQ(
        philox({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U}, {0xa4093822U, 0x299f31d0U}),
        (Words{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U}));
}

TEST(RandomStream, DependsOnSeedStreamAndPositionOnly) {
    RandomStream a(7, 3);
    RandomStream b(7, 3);
    RandomStream other_stream(7, 4);
    RandomStream other_seed(8, 3);
    for (int i = 0; i < 9; ++i) {
        const double value = a.next();
        EXPECT_EQ(value, b.next());
        EXPECT_NE(value, other_stream.next());
        EXPECT_NE(value, other_seed.next());
        EXPECT_GT(value, 0.0);
        EXPECT_LT(value, 1.0);
    }
}

/// Sobol's first two dimensions are a (0, 2)-sequence in base 2: of each 2^k samples exactly one
/// lies in every elementary interval of area 2^-k, whatever the scrambling.
TEST(PixelSampler, EveryPairFillsTheElementaryIntervals) {
    constexpr std::uint32_t k = 8;
    for (std::uint32_t dimension = 0; dimension < 5; ++dimension) {
        for (std::uint32_t split = 0; split <= k; ++split) {
            std::set<std::pair<int, int>> cells;
            for (std::uint32_t index = 0; index < 1U << k; ++index) {
                PixelSampler sampler(5, 17, 2, index);
                glm::dvec2 point = sampler.next_pair();
                for (std::uint32_t d = 0; d < dimension; ++d) {
                    point = sampler.next_pair();
                }
                cells.emplace(static_cast<int>(point.x * (1 << split)),
                              static_cast<int>(point.y * (1 << (k - split))));
            }
            EXPECT_EQ(cells.size(), 1U << k) << "dimension " << dimension << ", split " << split;
        }
    }
}

/// Correlation of two sources over n samples: its standard deviation is 1/sqrt(n) where they are
/// independent; 5 of them are passed by chance once in 2 million.
double correlation(const std::function<glm::dvec2(std::uint32_t)>& draw, std::uint32_t n) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const glm::dvec2 pair = draw(i);
        sum += 12.0 * (pair.x - 0.5) * (pair.y - 0.5);
    }
    return sum / n;
}

TEST(PixelSampler, PixelsBatchesAndDimensionsAreIndependent) {
    constexpr std::uint32_t n = 1U << 16;
    const double bound = 5.0 / std::sqrt(double{n});
    EXPECT_LT(std::abs(correlation(
                  [](std::uint32_t i) {
                      return glm::dvec2(PixelSampler(1, i, 0, 0).next(),
                                        PixelSampler(1, i + 1, 0, 0).next());
                  },
                  n)),
              bound);
    EXPECT_LT(std::abs(correlation(
                  [](std::uint32_t i) {
                      return glm::dvec2(PixelSampler(1, i, 0, 0).next(),
                                        PixelSampler(1, i, 1, 0).next());
                  },
                  n)),
              bound);
    EXPECT_LT(std::abs(correlation(
                  [](std::uint32_t i) {
                      PixelSampler sampler(1, 9, 0, i);
                      const double first = sampler.next();
                      return glm::dvec2(first, sampler.next());
                  },
                  n)),
              bound);
}

}  // namespace
}  // namespace raybundle
