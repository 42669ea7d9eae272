// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace raybundle {

struct CongestionSettings {
    double min_target_ms = 100.0;   ///< queueing delay aimed at: max(this, one base round trip)
    double moving_share = 0.4;      ///< part of that delay that one frame may occupy the link
    double rest_budget_ms = 800.0;  ///< a picture at rest may occupy the link this long
    double rest_ms = 2000.0;        ///< rest after which the best quality is sent at any cost
    double probe_ms = 2000.0;       ///< between measurements of the base round trip
    double drain_ms = 10e3;         ///< without one, frames pause for a round trip to allow it
    int max_in_flight = 12;         ///< frames
};

/// What to send to a viewer next.
struct FrameAdvice {
    static constexpr int kLossless = 100;

    bool send = false;   ///< the viewer can take a frame now
    int quality = 80;    ///< JPEG quality 40..95, or kLossless
    double scale = 1.0;  ///< of the viewport's width and height: 1, 0.75 or 0.5
    /// Of a frame of video, on average; 0: it is to be a picture of its own.
    std::size_t video_bytes = 0;
    bool key = false;  ///< it has to be decoded without those before it
};

/// What the decision depends on.
struct FrameDemand {
    bool moving = false;    ///< the whole picture changes (camera, dragged object): latency matters
    bool lossless = false;  ///< the viewer decodes a lossless codec and the picture deserves it
    double pixels = 0.0;    ///< of the viewport, width * height
    bool video = false;     ///< the viewer decodes video, and the picture moves
};

/// Paces one viewer's frames from its acknowledgements. Aims at a bounded queueing delay, not at
/// throughput: the number of frames in flight follows the delay above the base round trip (the idea
/// of LEDBAT, RFC 6817), the size of a frame follows the measured bandwidth.
/// It has no clock: every call passes the time, in milliseconds of any steady clock.
class CongestionWindow {
  public:
    explicit CongestionWindow(CongestionSettings settings = {}) : settings_(settings) {}

    /// A frame begins to be written: its size on the wire, quality and encoded pixels.
    void on_sent(std::uint32_t frame, std::size_t bytes, int quality, double pixels, double now_ms);
    /// The same of a frame of video; quality: see VideoFrame.
    void on_video_sent(std::uint32_t frame, std::size_t bytes, int quality, bool key,
                       double now_ms);

    /// The viewer has decoded `frame`; earlier frames count as received too. Unknown frames and
    /// impossible decode times are tolerated: a client can only spoil its own pacing.
    void on_ack(std::uint32_t frame, double decode_ms, double now_ms);

    /// Whether to measure the base round trip with a small message now, before the next frame.
    [[nodiscard]] bool wants_probe(double now_ms) const;
    void on_probe_sent(double now_ms);
    void on_probe_answered(double now_ms);

    /// Decides about the next frame. Until the first acknowledgement there is one frame only.
    FrameAdvice advise(const FrameDemand& demand, double now_ms);

    /// Time since the oldest frame without acknowledgement was sent; 0 where there is none.
    [[nodiscard]] double silence_ms(double now_ms) const {
        return flights_.empty() ? 0.0 : std::max(now_ms - flights_.front().sent_ms, 0.0);
    }

    /// Whether any frame has ever been acknowledged.
    [[nodiscard]] bool acknowledged() const { return min_frame_rtt_ms_.has_value(); }
    [[nodiscard]] int in_flight() const { return static_cast<int>(flights_.size()); }
    [[nodiscard]] double window() const { return window_; }               ///< frames
    [[nodiscard]] double base_rtt_ms() const;                             ///< 0: not known yet
    [[nodiscard]] double queueing_delay_ms() const { return delay_ms_; }  ///< at the last ack
    [[nodiscard]] double bytes_per_ms() const { return rate_; }           ///< 0: not known yet

  private:
    /// Where WebRTC's quality scaler takes fewer or more pixels of VP9: at mean quantizers of 205
    /// and 149 out of 255.
    static constexpr double kCoarseVideo = 100.0 - 100.0 * 205.0 / 255.0;
    static constexpr double kFineVideo = 100.0 - 100.0 * 149.0 / 255.0;

    void choose_video_step();
    struct Flight {
        std::uint32_t frame = 0;
        double bytes = 0.0;
        double sent_ms = 0.0;
    };

    [[nodiscard]] double target_ms() const;
    [[nodiscard]] bool can_send(double now_ms) const;
    [[nodiscard]] double affordable_cost(bool moving) const;
    [[nodiscard]] double video_bytes() const {
        return rate_ * settings_.moving_share * target_ms();
    }
    void note_bandwidth(double bytes, double sent_ms, double arrival_ms);
    void adapt_window(int in_flight_before);

    CongestionSettings settings_;
    std::deque<Flight> flights_;  ///< oldest first
    double window_ = 1.0;
    double delay_ms_ = 0.0;
    double rate_ = 0.0;            ///< bytes per millisecond of the bottleneck
    double bytes_per_cost_ = 0.0;  ///< how much detail this viewer's pictures have
    double last_arrival_ms_ = -1e300;
    std::optional<double> last_moving_ms_;    ///< initially the first call
    std::size_t step_ = 0;                    ///< of the quality ladder, last advised
    std::size_t video_step_ = 0;              ///< of the scales of video
    double video_quality_ = kFineVideo;       ///< recent mean at that scale
    bool video_before_ = false;               ///< the last advice was for video
    std::deque<double> probes_ms_;            ///< latest measurements of the base round trip
    std::optional<double> probe_sent_ms_;     ///< of the one without answer
    std::optional<double> last_probe_ms_;     ///< when the last one was sent
    std::optional<double> min_frame_rtt_ms_;  ///< stands in while no probe has been answered
};

}  // namespace raybundle
