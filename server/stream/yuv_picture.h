// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "stream/image_encoder.h"

namespace raybundle {

/// Planes of a 4:2:0 picture, row 0 at the top; chroma has half the width and height, rounded up.
struct YuvPlanes {
    std::uint8_t* y = nullptr;
    std::uint8_t* u = nullptr;
    std::uint8_t* v = nullptr;
    std::size_t y_stride = 0, uv_stride = 0;  ///< bytes
};

/// BT.709 in limited range (16..235, 16..240), rounded; chroma is that of the mean of 2 x 2 pixels.
/// Source: ITU-R BT.709-6, 3.2 to 3.5.
void convert_to_yuv(const PixelView& pixels, const YuvPlanes& planes);

}  // namespace raybundle
