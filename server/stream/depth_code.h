// SPDX-License-Identifier: Apache-2.0
// Depths of a picture as they travel; protocol/README.md ("Depths") describes the bytes.
#pragma once

#include <cstdint>
#include <vector>

namespace raybundle {

/// Inverse depths of a picture along its line of sight, 1/m, on a grid from corner to corner, row 0
/// at the top; 0: nothing is there. Linear over the picture wherever it shows a plane.
struct DepthMap {
    std::uint32_t columns = 0, rows = 0;
    std::vector<float> inverse;  ///< columns * rows, finite and >= 0

    [[nodiscard]] bool empty() const { return inverse.empty(); }
};

struct EncodedDepths {
    std::vector<std::uint8_t> bytes;
    float nearest = 0.0F;  ///< m; 0 where there is nothing
};

/// 16 bits for each point, relative to the nearest one; what a plane through three neighbours
/// predicts is taken away, and the rest deflated. Throws std::runtime_error where zlib refuses.
EncodedDepths encode_depths(const DepthMap& depths);

}  // namespace raybundle
