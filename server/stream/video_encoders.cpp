// SPDX-License-Identifier: Apache-2.0
#include "stream/video_encoders.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <exception>

namespace raybundle {

std::size_t VideoEncoder::bytes_for(int width, int height) {
    // Measured with libvpx 1.12, one thread: 13 MB and 74 B a pixel; in blocks of 64 pixels.
    constexpr std::size_t kFixed = 16U << 20U;
    constexpr std::size_t kPerPixel = 75;
    const auto whole = [](int edge) { return (static_cast<std::size_t>(edge) + 63U) / 64U * 64U; };
    return kFixed + kPerPixel * whole(std::max(width, 0)) * whole(std::max(height, 0));
}

std::size_t VideoEncoders::room() {
    constexpr std::size_t kMost = std::size_t{1} << 30U;
    const auto pages = static_cast<std::size_t>(std::max(sysconf(_SC_PHYS_PAGES), 0L));
    return std::min(kMost, pages / 8 * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
}

std::shared_ptr<VideoEncoder> VideoEncoders::find_or_begin(ViewerId viewer, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    const auto found = videos_.find(viewer);
    const std::size_t before = found == videos_.end() ? 0 : found->second.bytes;
    if (bytes_ - before + bytes > max_bytes_) {
        return nullptr;
    }
    bytes_ += bytes - before;
    Video& video = videos_[viewer];
    video.bytes = bytes;
    if (!video.encoder) {
        video.encoder = std::make_shared<VideoEncoder>();
    }
    return video.encoder;
}

std::optional<VideoFrame> VideoEncoders::encode(ViewerId viewer, const PixelView& pixels,
                                                const VideoFrameWish& wish) {
    if (!VideoEncoder::available()) {
        return std::nullopt;
    }
    const auto encoder =
        find_or_begin(viewer, VideoEncoder::bytes_for(pixels.width, pixels.height));
    if (!encoder) {
        end(viewer);
        return std::nullopt;
    }
    try {
        return encoder->encode(pixels, wish);
    } catch (const std::exception& error) {
        spdlog::warn("no video for viewer {}: {}", viewer, error.what());
        end(viewer);
        return std::nullopt;
    }
}

void VideoEncoders::end(ViewerId viewer) {
    Video last;  // destroyed without the lock
    const std::lock_guard lock(mutex_);
    if (const auto found = videos_.find(viewer); found != videos_.end()) {
        last = std::move(found->second);
        bytes_ -= last.bytes;
        videos_.erase(found);
    }
}

VideoEncoders::Load VideoEncoders::load() const {
    const std::lock_guard lock(mutex_);
    return {videos_.size(), bytes_};
}

}  // namespace raybundle
