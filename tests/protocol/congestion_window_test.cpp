// SPDX-License-Identifier: Apache-2.0
#include "stream/congestion_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

namespace raybundle {
namespace {

/// A bottleneck of given rate with an unbounded queue, and a viewer that acknowledges everything.
struct Link {
    double bytes_per_ms;
    double rtt_ms;
    double stall_from_ms = 1e300;
    double stall_to_ms = 1e300;

    double free_ms = 0.0;  ///< when the bottleneck is idle again

    double deliver(double bytes, double now_ms) {
        double start = std::max(free_ms, now_ms);
        const double end = start + bytes / bytes_per_ms;
        free_ms =
            end > stall_from_ms && start < stall_to_ms ? end + stall_to_ms - stall_from_ms : end;
        return free_ms + rtt_ms;  // acknowledged
    }
};

struct Sent {
    std::uint32_t frame;
    double sent_ms;
    double acked_ms;
    FrameAdvice advice;
};

constexpr double kPixels = 1280.0 * 720.0;
constexpr double kBytesPerPixel = 0.12;  ///< of a typical interior at quality 80

double encoded_size(const FrameAdvice& advice) {
    const double quality_factor = std::pow(2.0, (advice.quality - 80) / 15.0);
    return kPixels * advice.scale * advice.scale * kBytesPerPixel * quality_factor;
}

/// Runs the window against a link; a frame is due every `frame_ms`.
class Simulation {
  public:
    explicit Simulation(Link link) : link_(link) {}

    void run(double until_ms, bool moving, double frame_ms = 33.0) {
        for (; now_ms_ < until_ms; now_ms_ += 1.0) {
            while (!pending_.empty() && pending_.front().acked_ms <= now_ms_) {
                window_.on_ack(pending_.front().frame, 2.0, pending_.front().acked_ms);
                pending_.pop_front();
            }
            if (now_ms_ >= pong_ms_) {
                window_.on_probe_answered(now_ms_);
                pong_ms_ = 1e300;
            }
            if (now_ms_ >= next_frame_ms_) {
                offer(moving, frame_ms);
            }
        }
    }

    /// Largest delay from sending to acknowledgement, above the round trip, of frames sent since.
    [[nodiscard]] double worst_delay_since(double from_ms) const {
        double worst = 0.0;
        for (const Sent& sent : sent_) {
            if (sent.sent_ms >= from_ms) {
                worst = std::max(worst, sent.acked_ms - sent.sent_ms - link_.rtt_ms);
            }
        }
        return worst;
    }

    [[nodiscard]] std::size_t frames_since(double from_ms) const {
        return static_cast<std::size_t>(std::count_if(
            sent_.begin(), sent_.end(), [&](const Sent& s) { return s.sent_ms >= from_ms; }));
    }

    Link& link() { return link_; }
    CongestionWindow& window() { return window_; }
    [[nodiscard]] const FrameAdvice& last() const { return sent_.back().advice; }

  private:
    void offer(bool moving, double frame_ms) {
        const FrameAdvice advice = window_.advise({moving, false, kPixels}, now_ms_);
        if (!advice.send) {
            return;
        }
        next_frame_ms_ = now_ms_ + frame_ms;
        if (window_.wants_probe(now_ms_)) {
            window_.on_probe_sent(now_ms_);
            pong_ms_ = link_.deliver(20.0, now_ms_);
        }
        const double bytes = encoded_size(advice);
        window_.on_sent(++frame_, static_cast<std::size_t>(bytes), advice.quality,
                        kPixels * advice.scale * advice.scale, now_ms_);
        sent_.push_back({frame_, now_ms_, link_.deliver(bytes, now_ms_) + 2.0, advice});
        pending_.push_back(sent_.back());
    }

    CongestionWindow window_;
    Link link_;
    double now_ms_ = 0.0;
    double next_frame_ms_ = 0.0;
    double pong_ms_ = 1e300;
    std::uint32_t frame_ = 0;
    std::deque<Sent> pending_;
    std::vector<Sent> sent_;
};

constexpr double mbit(double rate) {
    return rate * 1e6 / 8.0 / 1000.0;
}

TEST(CongestionWindow, OneFrameUntilTheFirstAcknowledgement) {
    CongestionWindow window;
    const FrameAdvice first = window.advise({true, false, kPixels}, 0.0);
    EXPECT_TRUE(first.send);
    EXPECT_EQ(first.scale, 1.0);
    window.on_sent(1, 1000, 80, kPixels, 0.0);
    EXPECT_FALSE(window.advise({true, false, kPixels}, 1e9).send);
    window.on_ack(7, 0.0, 1e9);  // never sent
    EXPECT_EQ(window.in_flight(), 1);
    window.on_ack(1, 0.0, 1e9);
    EXPECT_TRUE(window.advise({true, false, kPixels}, 1e9).send);
}

TEST(CongestionWindow, AnAcknowledgementCoversSkippedFrames) {
    CongestionWindow window;
    double now = 0.0;
    for (std::uint32_t frame = 1; frame < 20; ++frame) {
        window.on_sent(frame, 1000, 80, kPixels, now);
        window.on_ack(frame, 0.0, now += 1.0);
    }
    ASSERT_GE(window.window(), 2.0);
    window.on_sent(20, 1000, 80, kPixels, now);
    window.on_sent(21, 1000, 80, kPixels, now);
    window.on_ack(21, 0.0, now + 1.0);
    EXPECT_EQ(window.in_flight(), 0);
}

TEST(CongestionWindow, ToleratesImpossibleTimes) {
    CongestionWindow window;
    window.on_sent(1, 1000, 80, kPixels, 100.0);
    window.on_ack(1, 1e300, 50.0);
    window.on_sent(2, 0, 80, 0.0, 60.0);
    window.on_ack(2, std::nan(""), 70.0);
    EXPECT_TRUE(std::isfinite(window.bytes_per_ms()));
    EXPECT_TRUE(std::isfinite(window.window()));
    EXPECT_TRUE(window.advise({true, false, 0.0}, 80.0).send);
}

TEST(CongestionWindow, FastLinkGetsEveryFrameAtBestQuality) {
    Simulation simulation({mbit(1000), 1.0});
    simulation.run(5000, true);
    EXPECT_GE(simulation.frames_since(3000), 58U);
    EXPECT_EQ(simulation.last().quality, 85);
    EXPECT_EQ(simulation.last().scale, 1.0);
    simulation.run(8000, false);
    EXPECT_EQ(simulation.last().quality, 95);
}

TEST(CongestionWindow, LosslessOnlyWhereItIsWanted) {
    CongestionWindow window;
    double now = 0.0;
    FrameAdvice advice;
    for (std::uint32_t frame = 1; frame < 20; ++frame, now += 1000.0) {
        advice = window.advise({false, true, kPixels}, now);
        window.on_sent(frame, 1000, advice.quality, kPixels, now);
        window.on_ack(frame, 0.0, now + 1.0);
    }
    EXPECT_EQ(advice.quality, FrameAdvice::kLossless);
    EXPECT_EQ(window.advise({true, true, kPixels}, now).quality, 85);
}

struct LinkCase {
    double mbit_per_s;
    double rtt_ms;
    double allowed_ms;  ///< queueing delay, the frame's own transmission included
    std::size_t frames_per_s;
};

class CongestionWindowLinks : public testing::TestWithParam<LinkCase> {};

TEST_P(CongestionWindowLinks, BoundsTheDelayWhileMoving) {
    const LinkCase& link = GetParam();
    Simulation simulation({mbit(link.mbit_per_s), link.rtt_ms});
    simulation.run(30000, true);
    EXPECT_LE(simulation.worst_delay_since(5000), link.allowed_ms);
    EXPECT_GE(simulation.frames_since(20000), 10 * link.frames_per_s);
}

// 0.3 Mbit/s carries 37 bytes a millisecond: the smallest picture of this size alone takes 120 ms.
INSTANTIATE_TEST_SUITE_P(TokenBuckets, CongestionWindowLinks,
                         testing::Values(LinkCase{0.3, 20, 400, 3}, LinkCase{0.3, 150, 450, 3},
                                         LinkCase{2, 20, 200, 8}, LinkCase{2, 150, 300, 6},
                                         LinkCase{20, 20, 150, 20}, LinkCase{20, 150, 250, 12}));

TEST(CongestionWindow, RecoversFromAStallWithinASecond) {
    Link link{mbit(20), 20.0};
    link.stall_from_ms = 10000;
    link.stall_to_ms = 15000;
    Simulation simulation(link);
    simulation.run(20000, true);
    EXPECT_LE(simulation.window().in_flight(), 3);
    EXPECT_LE(simulation.worst_delay_since(16000), 150.0);
    EXPECT_GE(simulation.frames_since(16000), 60U);
    EXPECT_LE(simulation.frames_since(10000) - simulation.frames_since(15000), 6U);
}

TEST(CongestionWindow, RecoversFromABandwidthDropSoonAfterTheFirstLateFrame) {
    Simulation simulation({mbit(20), 20.0});
    simulation.run(10000, true);
    simulation.link().bytes_per_ms = mbit(2);
    simulation.run(20000, true);
    EXPECT_LE(simulation.worst_delay_since(12000), 200.0);
    simulation.link().bytes_per_ms = mbit(20);
    simulation.run(30000, true);
    EXPECT_GE(simulation.last().quality, 70);
}

TEST(CongestionWindow, LearnsALongerRouteAgain) {
    Simulation simulation({mbit(50), 20.0});
    simulation.run(10000, true);
    simulation.link().rtt_ms = 220.0;
    simulation.run(40000, true);
    EXPECT_NEAR(simulation.window().base_rtt_ms(), 220.0, 40.0);
    EXPECT_GE(simulation.last().quality, 70);
    EXPECT_EQ(simulation.last().scale, 1.0);
}

TEST(CongestionWindow, BestQualityComesAfterARestOnASlowLinkToo) {
    Simulation simulation({mbit(0.3), 20.0});
    simulation.run(5000, true);
    simulation.run(20000, false);
    EXPECT_EQ(simulation.last().quality, 95);
    EXPECT_EQ(simulation.last().scale, 1.0);
}

}  // namespace
}  // namespace raybundle
