// SPDX-License-Identifier: Apache-2.0
// Built in place of video_encoder.cpp where libvpx is missing.
#include <stdexcept>

#include "stream/video_encoder.h"

namespace raybundle {

class VideoEncoder::Codec {};

VideoEncoder::VideoEncoder() = default;
VideoEncoder::~VideoEncoder() = default;

bool VideoEncoder::available() {
    return false;
}

VideoFrame VideoEncoder::encode(const PixelView& /*pixels*/, const VideoFrameWish& /*wish*/) {
    throw std::runtime_error("built without libvpx");
}

}  // namespace raybundle
