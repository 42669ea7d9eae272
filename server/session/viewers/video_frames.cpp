// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/video_frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stream/video_encoder.h"

namespace raybundle {
namespace {

constexpr double kGrowAfterS = 2.0;

}  // namespace

bool VideoFrames::wanted_by(const v1::Hello& hello) {
    const auto& codecs = hello.codecs();
    const auto first = std::find_if(codecs.begin(), codecs.end(), [](int codec) {
        return codec == v1::VP9 || codec == v1::JPEG;
    });
    return VideoEncoder::available() && first != codecs.end() && *first == v1::VP9;
}

bool VideoFrames::is_jump(const Camera& from, const Camera& to) {
    const glm::vec3 before = from.target - from.eye;
    const glm::vec3 after = to.target - to.eye;
    const float distance = std::min(glm::length(before), glm::length(after));
    if (!(distance > 0.0F)) {
        return true;
    }
    const float cosine = glm::dot(before, after) / (glm::length(before) * glm::length(after));
    return cosine < std::cos(std::min(to.vertical_fov, 3.0F)) ||
           glm::distance(from.eye, to.eye) > distance;
}

glm::uvec2 VideoFrames::next(const FrameAdvice& advice, glm::uvec2 fits, glm::uvec2 viewport,
                             const Camera& camera, TimePoint now) {
    if (advice.video_bytes == 0) {
        end();
        return fits;
    }
    const bool begins = bytes_ == 0 || viewport != viewport_;
    const bool keeps = !begins && glm::all(glm::lessThanEqual(size_, fits)) &&
                       (size_ == fits || seconds(now - sized_) < kGrowAfterS);
    if (!keeps) {
        size_ = fits;
        sized_ = now;
    }
    key_ = advice.key || begins || is_jump(camera_, camera);
    bytes_ = advice.video_bytes;
    viewport_ = viewport;
    camera_ = camera;
    return size_;
}

void VideoFrames::fill(v1::FrameHeader& header) const {
    if (bytes_ > 0) {
        header.set_codec(v1::VP9);
        header.set_key(key_);
    }
}

bool VideoFrames::end() {
    return std::exchange(bytes_, 0) > 0;
}

}  // namespace raybundle
