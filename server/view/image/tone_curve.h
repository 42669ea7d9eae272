// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raybundle {

/// Factor from radiance (cd/m²) to the tone curve's input that puts the logarithmic mean of the
/// luminance of the counted pixels at mid-grey (Reinhard et al. 2002, "Photographic Tone
/// Reproduction"). counted: row by row; where it has none the factor is that of 1 cd/m².
double automatic_display_factor(std::span<const glm::dvec3> radiance,
                                const std::vector<bool>& counted);

/// 8-bit sRGB picture, RGBA, as the viewers show it: soft shoulder (Reinhard et al. 2002, eq. 4),
/// white at 6 times the display's white.
std::vector<std::uint8_t> tone_mapped(std::span<const glm::dvec3> radiance, double factor);

}  // namespace raybundle
