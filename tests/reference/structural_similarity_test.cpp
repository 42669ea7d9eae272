// SPDX-License-Identifier: Apache-2.0
#include "reference/measures/structural_similarity.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace raybundle {
namespace {

constexpr glm::uvec2 size(24, 20);

/// Stripes of two greys.
std::vector<std::uint8_t> stripes(std::uint8_t dark, std::uint8_t bright, unsigned period) {
    std::vector<std::uint8_t> rgba;
    for (unsigned i = 0; i < size.x * size.y; ++i) {
        const std::uint8_t grey = (i % size.x) % period < period / 2 ? dark : bright;
        rgba.insert(rgba.end(), {grey, grey, grey, 255});
    }
    return rgba;
}

const std::vector<bool> everywhere(std::size_t{size.x} * size.y, true);

TEST(StructuralSimilarity, IsOneOfEqualPicturesAlone) {
    const auto picture = stripes(90, 160, 6);
    EXPECT_DOUBLE_EQ(structural_similarity(picture, picture, everywhere, size), 1.0);
    EXPECT_LT(structural_similarity(stripes(90, 160, 4), picture, everywhere, size), 0.5);
}

TEST(StructuralSimilarity, OfEvenGreysIsTheLuminanceTermAlone) {
    const double c1 = 0.01 * 255 * 0.01 * 255;
    const double expected = (2.0 * 100 * 120 + c1) / (100.0 * 100 + 120.0 * 120 + c1);
    EXPECT_NEAR(structural_similarity(stripes(100, 100, 4), stripes(120, 120, 4), everywhere, size),
                expected, 1e-9);
}

TEST(StructuralSimilarity, CountsThePixelsOfTheMask) {
    auto picture = stripes(90, 90, 4);
    const auto reference = picture;
    picture[0] = 255;  // within reach of the first pixels only
    std::vector<bool> last(everywhere.size(), false);
    last.back() = true;
    EXPECT_LT(structural_similarity(picture, reference, everywhere, size), 1.0);
    EXPECT_DOUBLE_EQ(structural_similarity(picture, reference, last, size), 1.0);
}

TEST(StructuralSimilarity, RefusesWhatCannotBeCompared) {
    const auto picture = stripes(90, 160, 6);
    EXPECT_THROW(structural_similarity(std::span(picture).first(8), picture, everywhere, size),
                 std::invalid_argument);
    EXPECT_THROW(
        structural_similarity(picture, picture, std::vector<bool>(everywhere.size(), false), size),
        std::invalid_argument);
}

}  // namespace
}  // namespace raybundle
