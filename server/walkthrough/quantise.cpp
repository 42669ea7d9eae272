// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/quantise.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

namespace {

constexpr int mantissa_bits = 9;
constexpr int exponent_bias = 15;

/// Factor of the mantissas.
float unit_of(int exponent) {
    return std::ldexp(1.0F, exponent - exponent_bias - mantissa_bits);
}

/// Point of the square that a direction is unfolded to (Meyer et al. 2010).
glm::vec2 octahedral(const glm::vec3& direction) {
    const float sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(sum > 0.0F)) {
        return glm::vec2(0.0F);
    }
    const glm::vec2 p = glm::vec2(direction) / sum;
    const glm::vec2 sign(p.x < 0.0F ? -1.0F : 1.0F, p.y < 0.0F ? -1.0F : 1.0F);
    return direction.z < 0.0F ? (1.0F - glm::abs(glm::vec2(p.y, p.x))) * sign : p;
}

std::uint32_t snorm8(float value) {
    return static_cast<std::uint32_t>(
        static_cast<std::uint8_t>(static_cast<std::int8_t>(std::lround(127.0F * value))));
}

}  // namespace

std::uint32_t rgb9e5(const glm::vec3& colour) {
    glm::vec3 c;
    for (int i = 0; i < 3; ++i) {
        c[i] = colour[i] > 0.0F ? std::min(colour[i], largest_rgb9e5) : 0.0F;
    }
    const float most = std::max({c.r, c.g, c.b});
    if (!(most > 0.0F)) {
        return 0;
    }
    int exponent = std::max(-exponent_bias - 1, std::ilogb(most)) + 1 + exponent_bias;
    if (std::lround(most / unit_of(exponent)) == 1L << mantissa_bits) {
        ++exponent;
    }
    const float unit = unit_of(exponent);
    const auto mantissa = [unit](float value) {
        return static_cast<std::uint32_t>(std::lround(value / unit));
    };
    return mantissa(c.r) | mantissa(c.g) << 9U | mantissa(c.b) << 18U |
           static_cast<std::uint32_t>(exponent) << 27U;
}

glm::vec3 from_rgb9e5(std::uint32_t packed) {
    const float unit = unit_of(static_cast<int>(packed >> 27U));
    return unit * glm::vec3(packed & 511U, packed >> 9U & 511U, packed >> 18U & 511U);
}

PositionGrid::PositionGrid(const Bounds& bounds)
    : origin(bounds.empty() ? glm::vec3(0.0F) : bounds.min),
      step(glm::max(bounds.extent(), 1e-6F) / steps) {}

glm::uvec3 PositionGrid::place(const glm::vec3& position) const {
    return glm::uvec3(glm::clamp(glm::round((position - origin) / step), 0.0F, steps));
}

std::array<std::uint32_t, 3> packed_vertex(const PositionGrid& grid, const glm::vec3& position,
                                           const glm::vec3& normal) {
    const glm::uvec3 p = grid.place(position);
    const glm::vec2 n = octahedral(normal);
    return {p.x | p.y << 21U, p.y >> 11U | p.z << 10U, snorm8(n.x) | snorm8(n.y) << 8U};
}

std::uint32_t packed_colour(const glm::vec3& colour) {
    const glm::vec3 root = glm::sqrt(glm::clamp(colour, 0.0F, 1.0F));
    const auto byte = [](float value) {
        return static_cast<std::uint32_t>(std::lround(255.0F * value));
    };
    return byte(root.r) | byte(root.g) << 8U | byte(root.b) << 16U | 255U << 24U;
}

}  // namespace raybundle
