// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raybundle {

/// Differences between a picture I and a reference R of the same scene (design.md, section 8), over
/// the pixels of a mask and the three channels.
struct ImageMetrics {
    double relative_rmse = 0.0;  ///< sqrt(sum (I-R)^2 / sum R^2)
    double mrse = 0.0;           ///< mean of (I-R)^2 / (R+0.01)^2, I and R divided by the mean of R
    double median = 0.0;         ///< of |lum I - lum R| / max(lum R, 1e-3 mean lum R)
    double p95 = 0.0;            ///< 95th percentile of the same
    std::size_t pixels = 0;      ///< measured
};

/// Compares two pictures in linear radiance; measured: true where a pixel counts. Sizes are equal.
/// Throws std::invalid_argument where a value anywhere is not finite, sizes differ, no pixel is
/// left to measure or the reference is black.
ImageMetrics compare_images(std::span<const glm::dvec3> image,
                            std::span<const glm::dvec3> reference,
                            const std::vector<bool>& measured);

/// Mask of the pixels to measure: all but those that see an emitter and their 8 neighbours.
/// sees_emitter: row by row, width * height.
std::vector<bool> without_emitters(const std::vector<bool>& sees_emitter, glm::uvec2 size);

}  // namespace raybundle
