// SPDX-License-Identifier: Apache-2.0
#include "stream/frame_encoder.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace raybundle {
namespace {

constexpr std::uint32_t kFullChromaQuality = 90;

/// Puts the depths behind the image, and their figures into the header.
void append_depths(const DepthMap& depths, v1::FrameHeader& header,
                   std::vector<std::uint8_t>& bytes) {
    const EncodedDepths encoded = encode_depths(depths);
    header.set_depth_bytes(static_cast<std::uint32_t>(encoded.bytes.size()));
    header.set_depth_columns(depths.columns);
    header.set_depth_rows(depths.rows);
    header.set_depth_nearest(encoded.nearest);
    bytes.insert(bytes.end(), encoded.bytes.begin(), encoded.bytes.end());
}

}  // namespace

FrameEncoder::FrameEncoder(int threads, Deliver deliver) : deliver_(std::move(deliver)) {
    for (int i = 0; i < std::max(threads, 1); ++i) {
        threads_.emplace_back([this] { work(); });
    }
}

FrameEncoder::~FrameEncoder() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    for (auto& thread : threads_) {
        thread.join();
    }
}

void FrameEncoder::submit(EncodeJob job) {
    {
        const std::lock_guard lock(mutex_);
        const ViewerId viewer = job.viewer;
        const auto before = waiting_.find(viewer);
        if (before != waiting_.end() && before->second.header.key() && job.header.has_key()) {
            job.header.set_key(true);  // somebody waits for it
        }
        if (waiting_.insert_or_assign(viewer, std::move(job)).second) {
            order_.push_back(viewer);
        }
    }
    changed_.notify_one();
}

bool FrameEncoder::busy(ViewerId viewer) const {
    const std::lock_guard lock(mutex_);
    return waiting_.contains(viewer) || running_.contains(viewer);
}

void FrameEncoder::forget(ViewerId viewer) {
    videos_.end(viewer);
    const std::lock_guard lock(mutex_);
    if (waiting_.erase(viewer) != 0) {
        order_.remove(viewer);
    }
}

/// Waits for a job whose viewer has none running, which keeps each viewer's frames in order.
/// False: no more jobs.
bool FrameEncoder::take(std::unique_lock<std::mutex>& lock, EncodeJob& job) {
    auto next = order_.end();
    changed_.wait(lock, [&] {
        next = std::find_if(order_.begin(), order_.end(),
                            [&](ViewerId viewer) { return !running_.contains(viewer); });
        return stopping_ || next != order_.end();
    });
    if (stopping_) {
        return false;
    }
    auto node = waiting_.extract(*next);
    job = std::move(node.mapped());
    order_.erase(next);
    running_.insert(job.viewer);
    return true;
}

std::vector<std::uint8_t> FrameEncoder::encode(JpegEncoder& jpeg, EncodeJob& job) {
    v1::FrameHeader& header = job.header;
    const PixelView pixels{job.pixels, static_cast<int>(header.width()),
                           static_cast<int>(header.height()), job.bottom_up};
    if (header.codec() == v1::VP9) {
        if (auto frame = videos_.encode(job.viewer, pixels, {job.video_bytes, header.key()})) {
            header.set_key(frame->key);
            header.set_quality(static_cast<std::uint32_t>(frame->quality));
            return std::move(frame->bytes);
        }
        header.set_codec(v1::JPEG);
    }
    header.clear_key();
    videos_.end(job.viewer);
    if (header.codec() == v1::PNG) {
        return encode_png(pixels);
    }
    const auto chroma =
        header.quality() >= kFullChromaQuality ? ChromaSampling::full : ChromaSampling::halved;
    return jpeg.encode(pixels, static_cast<int>(header.quality()), chroma);
}

void FrameEncoder::work() {
    JpegEncoder jpeg;
    EncodeJob job;
    std::unique_lock lock(mutex_);
    while (take(lock, job)) {
        const ViewerId viewer = job.viewer;
        lock.unlock();
        try {
            auto bytes = encode(jpeg, job);
            if (!job.depths.empty()) {
                append_depths(job.depths, job.header, bytes);
            }
            deliver_({viewer, std::move(job.header), std::move(bytes)});
        } catch (const std::exception& error) {
            spdlog::error("frame {} of viewer {} was dropped: {}", job.header.frame(), viewer,
                          error.what());
        }
        lock.lock();
        running_.erase(viewer);  // this thread looks again itself, so nobody needs to be woken
    }
}

}  // namespace raybundle
