// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace raybundle {

/// Pixels of a picture as read back from the GPU: 4 bytes each, R, G, B and one ignored, sRGB.
struct PixelView {
    std::span<const std::uint8_t> rgbx;  ///< width * height * 4
    int width = 0;
    int height = 0;
    bool bottom_up = true;  ///< first row is the lowest, as OpenGL reads it
};

/// Throws std::runtime_error where there are too few bytes for the size, or it is not positive.
void check_size(const PixelView& pixels);

enum class ChromaSampling { full, halved };  ///< 4:4:4, 4:2:0

/// JPEG by libjpeg-turbo. Keeps its compressor, so use one per thread.
class JpegEncoder {
  public:
    JpegEncoder();
    ~JpegEncoder();
    JpegEncoder(const JpegEncoder&) = delete;
    JpegEncoder& operator=(const JpegEncoder&) = delete;

    /// Throws std::runtime_error where libjpeg-turbo refuses. `quality` is 1..100.
    std::vector<std::uint8_t> encode(const PixelView& pixels, int quality, ChromaSampling chroma);

  private:
    void* compressor_;  ///< tjhandle
};

/// PNG, 8-bit RGB, fast compression. Throws std::runtime_error where libpng refuses.
std::vector<std::uint8_t> encode_png(const PixelView& pixels);

}  // namespace raybundle
