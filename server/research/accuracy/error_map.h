// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace raybundle {

/// Where a picture is too dark and where too bright: (lum I - lum R) / max(lum R, 1e-3 mean lum R),
/// blue below, red above, pale where it is right; saturated from +-scale on, grey where nothing is
/// measured. RGBA, row 0 at the top. All have the same number of pixels.
std::vector<std::uint8_t> error_map(std::span<const glm::dvec3> image,
                                    std::span<const glm::dvec3> reference,
                                    const std::vector<bool>& measured, double scale);

/// A round number for the scale of error maps: the smallest of 2, 5, 10, 20, 50 and 100 % that is
/// not below the given 95th percentile of the errors.
double error_map_scale(double p95);

/// CSS gradient of the map's colours from left (too dark) to right.
std::string error_map_gradient();

/// 8-bit PNG of a picture, RGBA, row 0 at the top.
std::string png_of(std::span<const std::uint8_t> rgba, glm::uvec2 size);

}  // namespace raybundle
