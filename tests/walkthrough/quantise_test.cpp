// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/quantise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace raybundle {
namespace {

TEST(SharedExponent, KeepsColoursWithinHalfAStep) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-16.0F, 15.9F);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    for (int i = 0; i < 10'000; ++i) {
        const float most = std::exp2(exponent(random));
        const glm::vec3 colour(most, most * share(random), most * share(random));
        const glm::vec3 error = glm::abs(from_rgb9e5(rgb9e5(colour)) - colour);
        // Of the mantissa's 511 steps at least 256 are in use.
        EXPECT_LE(std::max({error.r, error.g, error.b}), most / 510.0F);
    }
}

TEST(SharedExponent, KeepsWhatItHasExactly) {
    for (const glm::vec3& colour : {glm::vec3(0.0F), glm::vec3(1.0F, 0.5F, 0.25F),
                                    glm::vec3(largest_rgb9e5), glm::vec3(511.0F, 1.0F, 0.0F)}) {
        EXPECT_EQ(from_rgb9e5(rgb9e5(colour)), colour);
    }
    // 511.75 rounds to 512, which needs the next exponent.
    EXPECT_EQ(from_rgb9e5(rgb9e5(glm::vec3(511.75F, 0.0F, 0.0F))).r, 512.0F);
}

TEST(SharedExponent, BoundsWhatItHasNot) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(from_rgb9e5(rgb9e5(glm::vec3(inf, -1.0F, nan))),
              glm::vec3(largest_rgb9e5, 0.0F, 0.0F));
    EXPECT_EQ(rgb9e5(glm::vec3(1e-30F)), 0U);
}

TEST(PackedVertex, KeepsPlacesToHalfAStepOfTheGrid) {
    Bounds bounds;
    bounds.add({-150.0F, 0.0F, 20.0F});
    bounds.add({150.0F, 3.0F, 20.0F});  // flat
    const PositionGrid grid(bounds);
    std::mt19937 random(2);
    std::uniform_real_distribution<float> part(0.0F, 1.0F);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 position =
            bounds.min + glm::vec3(part(random), part(random), part(random)) * bounds.extent();
        const auto v = packed_vertex(grid, position, glm::vec3(0, 1, 0));
        const glm::uvec3 place(v[0] & 0x1fffffU, v[0] >> 21U | (v[1] & 0x3ffU) << 11U,
                               v[1] >> 10U & 0x1fffffU);
        const glm::vec3 found = grid.origin + grid.step * glm::vec3(place);
        // Half a step of 0.14 mm, and the rounding of floats at 150 m.
        EXPECT_LE(glm::length(found - position), 1e-4F);
    }
}

TEST(PackedVertex, KeepsNormalsToADegree) {
    Bounds bounds;
    bounds.add(glm::vec3(0.0F));
    bounds.add(glm::vec3(1.0F));
    const PositionGrid grid(bounds);
    std::mt19937 random(3);
    std::normal_distribution<float> gauss;
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 normal =
            glm::normalize(glm::vec3(gauss(random), gauss(random), gauss(random)));
        const std::uint32_t bits = packed_vertex(grid, glm::vec3(0.5F), normal)[2];
        glm::vec3 n(static_cast<float>(static_cast<std::int8_t>(bits & 255U)) / 127.0F,
                    static_cast<float>(static_cast<std::int8_t>(bits >> 8U & 255U)) / 127.0F, 0.0F);
        n.z = 1.0F - std::abs(n.x) - std::abs(n.y);
        const float below = std::max(-n.z, 0.0F);
        n.x -= n.x < 0.0F ? -below : below;
        n.y -= n.y < 0.0F ? -below : below;
        EXPECT_GT(glm::dot(glm::normalize(n), normal), std::cos(glm::radians(1.0F)));
    }
}

}  // namespace
}  // namespace raybundle
