// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "stream/image_encoder.h"

namespace raybundle {

/// How one frame of a video is to be encoded.
struct VideoFrameWish {
    std::size_t bytes = 0;    ///< that a frame may take on average; a key frame 2.5 times that
    bool key = false;         ///< it has to be decoded without those before it
    int shown_ms = kFrameMs;  ///< time that it is shown for, as far as rate control is concerned
    static constexpr int kFrameMs = 40;
};

struct VideoFrame {
    std::vector<std::uint8_t> bytes;
    bool key = false;
    int quality = 0;  ///< 1..99: 100 less the quantizer in percent of the coarsest
};

/// VP9 by libvpx, profile 0 (4:2:0, 8 bits), BT.709 in limited range: one frame in, one out, none
/// kept back. A change of size makes a key frame. Used by one thread at a time.
class VideoEncoder {
  public:
    /// Whether this program was built with libvpx. Without it encode() always throws.
    static bool available();
    /// Bytes that an encoder of this size takes, with its pictures; an upper bound, measured.
    static std::size_t bytes_for(int width, int height);
    /// Edge of the largest picture, pixels.
    static constexpr int kMaxEdge = 8192;

    VideoEncoder();
    ~VideoEncoder();
    VideoEncoder(const VideoEncoder&) = delete;
    VideoEncoder& operator=(const VideoEncoder&) = delete;

    /// Throws std::runtime_error where libvpx refuses; the next frame is a key frame then.
    VideoFrame encode(const PixelView& pixels, const VideoFrameWish& wish);

  private:
    class Codec;
    std::unique_ptr<Codec> codec_;
};

}  // namespace raybundle
