// SPDX-License-Identifier: Apache-2.0
#include "stream/video_encoder.h"

#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <thread>

#include "stream/yuv_picture.h"

namespace raybundle {
namespace {

/// Both on libvpx's scale of 0..63, as WebRTC has them for VP9 in real time: finer is not seen in
/// motion, coarser is worse than fewer pixels (CongestionWindow).
constexpr unsigned kFinestQuantizer = 8;
constexpr unsigned kCoarsestQuantizer = 56;
/// A key frame may fill the queueing delay that is aimed at, of which a frame has 0.4
/// (CongestionSettings::moving_share).
constexpr unsigned kKeyFramePercent = 250;
/// Rate control evens out over the queueing delay that is aimed at
/// (CongestionSettings::min_target_ms).
constexpr unsigned kBufferMs = 100;
constexpr int kFastest = 8;  ///< of VP8E_SET_CPUUSED
constexpr double kQuantizerSteps = 255.0;

/// The solver needs the others; more than four bring nothing for pictures of 4K in real time.
unsigned threads_for(int width) {
    const unsigned spare = std::thread::hardware_concurrency() / 4;
    const auto tiles = static_cast<unsigned>(std::max(width / 256, 1));  // columns of 256 at least
    return std::clamp(std::min(spare, tiles), 1U, 4U);
}

unsigned kbit_per_s(const VideoFrameWish& wish) {
    const double bits = 8.0 * static_cast<double>(wish.bytes);
    return static_cast<unsigned>(std::clamp(bits / std::max(wish.shown_ms, 1), 1.0, 1e6));
}

}  // namespace

class VideoEncoder::Codec {
  public:
    Codec(int width, int height) : width_(width), height_(height) {}

    /// Once, before anything else.
    void begin(const VideoFrameWish& wish) {
        check(vpx_codec_enc_config_default(vpx_codec_vp9_cx(), &config_, 0), "defaults");
        config_.g_w = static_cast<unsigned>(width_);
        config_.g_h = static_cast<unsigned>(height_);
        config_.g_timebase = {1, 1000};
        config_.g_threads = threads_for(width_);
        config_.g_lag_in_frames = 0;
        config_.g_pass = VPX_RC_ONE_PASS;
        config_.g_error_resilient = 0;  // every byte arrives, in order
        config_.rc_end_usage = VPX_CBR;
        config_.rc_dropframe_thresh = 0;
        config_.rc_resize_allowed = 0;
        config_.rc_min_quantizer = kFinestQuantizer;
        config_.rc_max_quantizer = kCoarsestQuantizer;
        config_.rc_undershoot_pct = 50;
        config_.rc_overshoot_pct = 50;
        config_.rc_buf_initial_sz = kBufferMs;
        config_.rc_buf_optimal_sz = kBufferMs;
        config_.rc_buf_sz = 2 * kBufferMs;
        config_.kf_mode = VPX_KF_DISABLED;  // on demand only
        config_.rc_target_bitrate = kbit_per_s(wish);
        check(vpx_codec_enc_init(&context_, vpx_codec_vp9_cx(), &config_, 0), "start");
        begun_ = true;
        set(VP8E_SET_CPUUSED, kFastest);
        set(VP8E_SET_MAX_INTRA_BITRATE_PCT, kKeyFramePercent);
        set(VP8E_SET_STATIC_THRESHOLD, 1U);
        set(VP9E_SET_AQ_MODE, 3U);  // renews what stands still, block by block
        set(VP9E_SET_TILE_COLUMNS, config_.g_threads > 2 ? 2 : config_.g_threads > 1 ? 1 : 0);
        set(VP9E_SET_ROW_MT, 1U);
        set(VP9E_SET_FRAME_PARALLEL_DECODING, 0U);
        set(VP9E_SET_COLOR_SPACE, static_cast<int>(VPX_CS_BT_709));
        set(VP9E_SET_COLOR_RANGE, static_cast<int>(VPX_CR_STUDIO_RANGE));
        if (vpx_img_alloc(&image_, VPX_IMG_FMT_I420, config_.g_w, config_.g_h, 32) == nullptr) {
            throw std::runtime_error("libvpx: no memory for a picture");
        }
        image_.cs = VPX_CS_BT_709;
        image_.range = VPX_CR_STUDIO_RANGE;
    }
    ~Codec() {
        vpx_img_free(&image_);
        if (begun_) {
            vpx_codec_destroy(&context_);
        }
    }
    Codec(const Codec&) = delete;
    Codec& operator=(const Codec&) = delete;

    [[nodiscard]] bool fits(const PixelView& pixels) const {
        return pixels.width == width_ && pixels.height == height_;
    }

    VideoFrame encode(const PixelView& pixels, const VideoFrameWish& wish) {
        if (const unsigned rate = kbit_per_s(wish); rate != config_.rc_target_bitrate) {
            config_.rc_target_bitrate = rate;
            check(vpx_codec_enc_config_set(&context_, &config_), "set the bit rate");
        }
        convert_to_yuv(pixels, {image_.planes[VPX_PLANE_Y], image_.planes[VPX_PLANE_U],
                                image_.planes[VPX_PLANE_V],
                                static_cast<std::size_t>(image_.stride[VPX_PLANE_Y]),
                                static_cast<std::size_t>(image_.stride[VPX_PLANE_U])});
        const int shown_ms = std::max(wish.shown_ms, 1);
        check(vpx_codec_encode(&context_, &image_, time_ms_, static_cast<unsigned long>(shown_ms),
                               wish.key ? VPX_EFLAG_FORCE_KF : 0, VPX_DL_REALTIME),
              "encode");
        time_ms_ += shown_ms;
        return packets();
    }

  private:
    VideoFrame packets() {
        VideoFrame frame;
        vpx_codec_iter_t next = nullptr;
        while (const vpx_codec_cx_pkt_t* packet = vpx_codec_get_cx_data(&context_, &next)) {
            if (packet->kind == VPX_CODEC_CX_FRAME_PKT) {
                const auto* const begin = static_cast<const std::uint8_t*>(packet->data.frame.buf);
                frame.bytes.insert(frame.bytes.end(), begin, begin + packet->data.frame.sz);
                frame.key = frame.key || (packet->data.frame.flags & VPX_FRAME_IS_KEY) != 0;
            }
        }
        if (frame.bytes.empty()) {
            throw std::runtime_error("libvpx: no frame came out");
        }
        int quantizer = 0;
        check(vpx_codec_control(&context_, VP8E_GET_LAST_QUANTIZER, &quantizer), "quantizer");
        frame.quality =
            std::clamp(static_cast<int>(100.0 - 100.0 * quantizer / kQuantizerSteps), 1, 99);
        return frame;
    }

    template <typename Value>
    void set(vp8e_enc_control_id control, Value value) {
        check(vpx_codec_control_(&context_, control, value), "set up");
    }

    void check(vpx_codec_err_t code, const char* what) {
        if (code == VPX_CODEC_OK) {
            return;
        }
        std::string text =
            std::string("libvpx cannot ") + what + ": " + vpx_codec_err_to_string(code);
        if (const char* detail = begun_ ? vpx_codec_error_detail(&context_) : nullptr) {
            text += std::string(", ") + detail;
        }
        throw std::runtime_error(text);
    }

    int width_, height_;
    vpx_codec_enc_cfg_t config_{};
    vpx_codec_ctx_t context_{};
    vpx_image_t image_{};
    bool begun_ = false;
    std::int64_t time_ms_ = 0;
};

VideoEncoder::VideoEncoder() = default;
VideoEncoder::~VideoEncoder() = default;

bool VideoEncoder::available() {
    return true;
}

VideoFrame VideoEncoder::encode(const PixelView& pixels, const VideoFrameWish& wish) {
    check_size(pixels);
    if (std::max(pixels.width, pixels.height) > kMaxEdge) {
        throw std::runtime_error("VP9: edge of more than " + std::to_string(kMaxEdge) + " pixels");
    }
    try {
        if (!codec_ || !codec_->fits(pixels)) {
            codec_.reset();  // before the next one takes its memory
            codec_ = std::make_unique<Codec>(pixels.width, pixels.height);
            codec_->begin(wish);
        }
        return codec_->encode(pixels, wish);
    } catch (...) {
        codec_.reset();
        throw;
    }
}

}  // namespace raybundle
