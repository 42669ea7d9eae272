// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "raybundle.pb.h"
#include "scene/scene.h"
#include "scheduling/clock.h"
#include "stream/congestion_window.h"

namespace raybundle {

/// Which of one viewer's frames are video, how large they are, and which of them have to be key
/// frames.
class VideoFrames {
  public:
    /// Whether a client gets video: it offers VP9 before JPEG, and this program can encode it.
    static bool wanted_by(const v1::Hello& hello);

    /// Begins the next frame, of at most size `fits`; its size. In a video the size grows at most
    /// every two seconds while the viewport stays: each change costs a key frame, which takes 2.5
    /// times the bytes of another, so this costs at most 1.5 of 50 frames.
    glm::uvec2 next(const FrameAdvice& advice, glm::uvec2 fits, glm::uvec2 viewport,
                    const Camera& camera, TimePoint now);
    /// Its codec and whether it has to be a key frame, where it is video.
    void fill(v1::FrameHeader& header) const;
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

    /// Ends the video. True where there was one.
    bool end();

    /// Whether two pictures have next to nothing in common: the camera has turned by more than it
    /// sees, or has gone farther than what it looks at is away.
    static bool is_jump(const Camera& from, const Camera& to);

  private:
    std::size_t bytes_ = 0;
    bool key_ = false;
    glm::uvec2 size_{0}, viewport_{0};
    Camera camera_;
    TimePoint sized_;
};

}  // namespace raybundle
