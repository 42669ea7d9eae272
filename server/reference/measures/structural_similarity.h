// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raybundle {

/// Structural similarity of two display pictures (Wang et al. 2004, "Image quality assessment: from
/// error visibility to structural similarity"): 1 where they are equal. Gaussian window of 11x11
/// pixels with a standard deviation of 1.5, K1 = 0.01, K2 = 0.03, of 8-bit luma (BT.601). Mean over
/// the pixels of a mask; the window is cut off at the picture's edges.
/// Pictures: RGBA, row by row. Throws std::invalid_argument where sizes differ or no pixel counts.
double structural_similarity(std::span<const std::uint8_t> image,
                             std::span<const std::uint8_t> reference,
                             const std::vector<bool>& counted, glm::uvec2 size);

}  // namespace raybundle
