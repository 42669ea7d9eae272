// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "stream/video_encoder.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// The encoders of viewers whose pictures move, as many as there is memory for. All methods may be
/// called from any thread, encode() for one viewer from one at a time.
class VideoEncoders {
  public:
    /// Bytes of all encoders: 1 GiB, but an eighth of the machine's memory at most. 1 GiB is one
    /// picture of 3840x2160, or 18 of 800x600.
    static std::size_t room();

    struct Load {
        std::size_t encoders = 0;
        std::size_t bytes = 0;
    };

    explicit VideoEncoders(std::size_t max_bytes = room()) : max_bytes_(max_bytes) {}

    /// The next frame of the viewer's video, which begins with a key frame. Nothing where there is
    /// no room for its encoder or libvpx refuses: the video has ended then.
    std::optional<VideoFrame> encode(ViewerId viewer, const PixelView& pixels,
                                     const VideoFrameWish& wish);

    /// Ends a viewer's video; a frame that is being encoded is still finished.
    void end(ViewerId viewer);

    [[nodiscard]] Load load() const;

  private:
    struct Video {
        std::shared_ptr<VideoEncoder> encoder;
        std::size_t bytes = 0;
    };
    std::shared_ptr<VideoEncoder> find_or_begin(ViewerId viewer, std::size_t bytes);

    const std::size_t max_bytes_;
    mutable std::mutex mutex_;
    std::map<ViewerId, Video> videos_;
    std::size_t bytes_ = 0;
};

}  // namespace raybundle
