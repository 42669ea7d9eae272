// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "raybundle.pb.h"
#include "stream/depth_code.h"
#include "stream/image_encoder.h"
#include "stream/video_encoders.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// A picture to encode. `header.codec`, `width`, `height` and `quality` say how; a JPEG of quality
/// 90 or more keeps full chroma resolution. What is to be VP9 becomes a JPEG of that quality where
/// there is no encoder, or no memory for one: the header of the frame says what it has become. Its
/// `key` asks for a key frame, and says whether it is one.
struct EncodeJob {
    ViewerId viewer = 0;
    v1::FrameHeader header;
    std::vector<std::uint8_t> pixels;  ///< width * height * 4: R, G, B, ignored; sRGB
    bool bottom_up = true;             ///< first row is the lowest, as OpenGL reads it
    DepthMap depths;                   ///< to go with it; empty: none
    std::size_t video_bytes = 0;       ///< of VP9: what a frame may take
};

struct EncodedFrame {
    ViewerId viewer = 0;
    v1::FrameHeader header;
    std::vector<std::uint8_t> bytes;  ///< the image, then the depths
};

/// Encodes frames on its own threads. At most one job of a viewer runs and one waits; a newer one
/// replaces the one that waits, so memory is bounded by the number of viewers.
class FrameEncoder {
  public:
    /// Called on an encoder thread with each encoded frame, in order for each viewer.
    using Deliver = std::function<void(EncodedFrame)>;

    FrameEncoder(int threads, Deliver deliver);
    ~FrameEncoder();  ///< drops waiting jobs, finishes running ones
    FrameEncoder(const FrameEncoder&) = delete;
    FrameEncoder& operator=(const FrameEncoder&) = delete;

    /// Queues a job; never blocks on encoding. A job that cannot be encoded is logged and dropped.
    void submit(EncodeJob job);

    /// Whether a job of this viewer waits or runs.
    [[nodiscard]] bool busy(ViewerId viewer) const;

    /// Drops the waiting job of a viewer that has left, and its video.
    void forget(ViewerId viewer);

    /// Ends the video of a viewer whose picture rests: its memory is free, the next frame of VP9
    /// is a key frame.
    void end_video(ViewerId viewer) { videos_.end(viewer); }
    /// Encoders of VP9 that there are.
    [[nodiscard]] VideoEncoders::Load video_load() const { return videos_.load(); }

  private:
    void work();
    bool take(std::unique_lock<std::mutex>& lock, EncodeJob& job);
    std::vector<std::uint8_t> encode(JpegEncoder& jpeg, EncodeJob& job);

    Deliver deliver_;
    VideoEncoders videos_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::list<ViewerId> order_;  ///< viewers with a waiting job, longest waiting first
    std::map<ViewerId, EncodeJob> waiting_;
    std::set<ViewerId> running_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace raybundle
