// SPDX-License-Identifier: Apache-2.0
#include "stream/congestion_window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace raybundle {
namespace {

struct Step {
    int quality;
    double scale;
};

/// From best to smallest. The first two are for pictures at rest.
constexpr std::array<Step, 12> kLadder{{{FrameAdvice::kLossless, 1.0},
                                        {95, 1.0},
                                        {85, 1.0},
                                        {80, 1.0},
                                        {70, 1.0},
                                        {60, 1.0},
                                        {50, 1.0},
                                        {60, 0.75},
                                        {50, 0.75},
                                        {60, 0.5},
                                        {50, 0.5},
                                        {40, 0.5}}};
constexpr std::array<double, 3> kVideoScales{1.0, 0.75, 0.5};
constexpr double kVideoMemory = 0.25;  ///< weight of the newest frame in the mean quality
constexpr std::size_t kBestJpeg = 1;
constexpr std::size_t kBestMoving = 2;
constexpr std::size_t kUnknownLink = 4;
constexpr std::size_t kProbesKept = 8;  ///< a longer route is believed after so many

/// Size of an encoded picture relative to quality 80; typical of interiors, 4:4:4 from quality 90.
double relative_size(int quality) {
    struct Point {
        int quality;
        double size;
    };
    constexpr std::array<Point, 9> kSizes{{{40, 0.45},
                                           {50, 0.52},
                                           {60, 0.60},
                                           {70, 0.74},
                                           {80, 1.0},
                                           {85, 1.2},
                                           {90, 2.0},
                                           {95, 3.0},
                                           {FrameAdvice::kLossless, 10.0}}};
    const auto* const next =
        std::find_if(kSizes.begin(), kSizes.end(), [&](Point p) { return p.quality >= quality; });
    return next == kSizes.end() ? kSizes.back().size : next->size;
}

double cost(int quality, double pixels) {
    return relative_size(quality) * std::max(pixels, 1.0);
}

double cost(const Step& step, double viewport_pixels) {
    return cost(step.quality, viewport_pixels * step.scale * step.scale);
}

}  // namespace

/// Measured by small messages with nothing else in flight: a frame's own round trip holds the time
/// that a slow link needs for its bytes, which would pass for distance.
double CongestionWindow::base_rtt_ms() const {
    if (probes_ms_.empty()) {
        return min_frame_rtt_ms_.value_or(0.0);
    }
    return *std::min_element(probes_ms_.begin(), probes_ms_.end());
}

bool CongestionWindow::wants_probe(double now_ms) const {
    return flights_.empty() && !probe_sent_ms_ &&
           (!last_probe_ms_ || now_ms - *last_probe_ms_ >= settings_.probe_ms);
}

void CongestionWindow::on_probe_sent(double now_ms) {
    probe_sent_ms_ = now_ms;
    last_probe_ms_ = now_ms;
}

void CongestionWindow::on_probe_answered(double now_ms) {
    if (!probe_sent_ms_) {
        return;
    }
    probes_ms_.push_back(std::max(now_ms - *probe_sent_ms_, 0.0));
    probe_sent_ms_.reset();
    if (probes_ms_.size() > kProbesKept) {
        probes_ms_.pop_front();
    }
}

double CongestionWindow::target_ms() const {
    return std::max(settings_.min_target_ms, base_rtt_ms());
}

void CongestionWindow::on_sent(std::uint32_t frame, std::size_t bytes, int quality, double pixels,
                               double now_ms) {
    const auto size = static_cast<double>(bytes);
    flights_.push_back({frame, size, now_ms});
    const double sample = size / cost(quality, pixels);
    bytes_per_cost_ = bytes_per_cost_ > 0.0 ? std::midpoint(bytes_per_cost_, sample) : sample;
}

/// A key frame is as coarse as it has to be; the frames after it show what the line carries.
void CongestionWindow::on_video_sent(std::uint32_t frame, std::size_t bytes, int quality, bool key,
                                     double now_ms) {
    flights_.push_back({frame, static_cast<double>(bytes), now_ms});
    if (!key) {
        video_quality_ += kVideoMemory * (quality - video_quality_);
    }
}

/// Down where the quantizer stays coarse; up only where a video begins, since each change of size
/// costs a key frame.
void CongestionWindow::choose_video_step() {
    if (!video_before_ && video_quality_ > kFineVideo && video_step_ > 0) {
        --video_step_;
        video_quality_ = kFineVideo;
    } else if (video_quality_ < kCoarseVideo && video_step_ + 1 < kVideoScales.size()) {
        ++video_step_;
        video_quality_ = kFineVideo;
    }
}

void CongestionWindow::on_ack(std::uint32_t frame, double decode_ms, double now_ms) {
    const auto acked = std::find_if(flights_.begin(), flights_.end(),
                                    [&](const Flight& flight) { return flight.frame == frame; });
    if (acked == flights_.end()) {
        return;
    }
    // Frames that the viewer skipped took their share of the link as well.
    double bytes = 0.0;
    for (auto flight = flights_.begin(); flight <= acked; ++flight) {
        bytes += flight->bytes;
    }
    const double first_sent_ms = flights_.front().sent_ms;
    const double elapsed_ms = std::max(now_ms - acked->sent_ms, 0.0);
    const double decoding_ms =
        std::isfinite(decode_ms) ? std::clamp(decode_ms, 0.0, elapsed_ms) : 0;
    const double rtt_ms = elapsed_ms - decoding_ms;
    const int in_flight_before = in_flight();
    flights_.erase(flights_.begin(), acked + 1);

    min_frame_rtt_ms_ = std::min(min_frame_rtt_ms_.value_or(rtt_ms), rtt_ms);
    delay_ms_ = std::max(rtt_ms - base_rtt_ms(), 0.0);
    note_bandwidth(bytes, first_sent_ms, now_ms - decoding_ms);
    adapt_window(in_flight_before);
}

/// A frame occupies the bottleneck from its arrival there, or from the end of the frame before it
/// (Lindley's recursion), until its own end; both seen from the acknowledgements' side.
void CongestionWindow::note_bandwidth(double bytes, double sent_ms, double arrival_ms) {
    const double begin_ms = std::max(last_arrival_ms_, sent_ms + base_rtt_ms());
    const double sample = bytes / std::max(arrival_ms - begin_ms, 1.0);
    last_arrival_ms_ = arrival_ms;
    if (rate_ <= 0.0) {
        rate_ = sample;
        return;
    }
    // Down quickly, up with care: a frame that is too large costs delay, one too small only detail.
    const double weight = sample < rate_ ? 0.7 : 0.3;
    rate_ += weight * (sample - rate_);
}

void CongestionWindow::adapt_window(int in_flight_before) {
    const double target = target_ms();
    if (delay_ms_ > target) {
        window_ = std::max(1.0, 0.6 * window_);
    } else if (in_flight_before + 1 >= window_) {
        const double room = 1.0 - delay_ms_ / target;
        window_ = std::min<double>(settings_.max_in_flight, window_ + room / window_);
    }
}

/// A link that stalls gets nothing more, however wide the window was; and now and then frames pause
/// until none is in flight, to measure the base round trip.
bool CongestionWindow::can_send(double now_ms) const {
    if (flights_.empty()) {
        return true;
    }
    const bool stalled = now_ms - flights_.front().sent_ms > base_rtt_ms() + 2.0 * target_ms();
    const bool draining = !probe_sent_ms_ && last_probe_ms_.has_value() &&
                          now_ms - *last_probe_ms_ >= settings_.drain_ms;
    return !stalled && !draining && in_flight() + 1 <= window_;
}

double CongestionWindow::affordable_cost(bool moving) const {
    const double budget_ms =
        moving ? settings_.moving_share * target_ms() : settings_.rest_budget_ms;
    return rate_ * budget_ms / bytes_per_cost_;
}

FrameAdvice CongestionWindow::advise(const FrameDemand& demand, double now_ms) {
    if (demand.moving || !last_moving_ms_) {
        last_moving_ms_ = now_ms;
    }
    if (!can_send(now_ms)) {
        return {};
    }
    const std::size_t best = demand.moving ? kBestMoving : (demand.lossless ? 0 : kBestJpeg);
    const bool known = rate_ > 0.0 && bytes_per_cost_ > 0.0;
    const bool long_rest = now_ms - *last_moving_ms_ >= settings_.rest_ms;
    if (!known) {
        step_ = kUnknownLink;
    } else if (!demand.moving && long_rest && flights_.empty()) {
        step_ = best;
    } else {
        const double affordable = affordable_cost(demand.moving);
        std::size_t fitting = best;
        while (fitting + 1 < kLadder.size() && cost(kLadder[fitting], demand.pixels) > affordable) {
            ++fitting;
        }
        // Up by single steps, so that one lucky measurement does not make the picture flicker.
        step_ = std::max({fitting, best, step_ > 0 ? step_ - 1 : 0});
    }
    FrameAdvice advice{true, kLadder[step_].quality, kLadder[step_].scale};
    if (demand.video && known) {
        choose_video_step();
        advice.scale = kVideoScales[video_step_];
        advice.video_bytes = static_cast<std::size_t>(std::max(video_bytes(), 1.0));
    }
    video_before_ = advice.video_bytes > 0;
    return advice;
}

}  // namespace raybundle
