// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace raybundle {

inline constexpr int max_bounces = 1 << 16;  ///< of a path; far beyond what roulette lets live

inline double largest_channel(const glm::dvec3& rgb) {
    return std::max({rgb.r, rgb.g, rgb.b});
}

/// Russian roulette (Arvo, Kirk 1990) that keeps the largest channel of `value` near that of
/// `reference`: whether it goes on, and its value then. u: uniform in (0, 1).
inline bool survives(glm::dvec3& value, const glm::dvec3& reference, double u) {
    const double chance = largest_channel(value) / largest_channel(reference);
    if (chance >= 1.0) {
        return true;
    }
    if (!(chance > 0.0)) {
        return false;
    }
    value /= chance;
    return u < chance;
}

}  // namespace raybundle
