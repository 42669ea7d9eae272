// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

namespace raybundle {

/// How many bytes of light a viewer may have on the way, by its acknowledgements: more while they
/// come as fast as ever, half where they have come to queue. As CongestionWindow it aims at a
/// bounded delay, since pictures and changes take the same way. It has no clock: every call passes
/// the time, in milliseconds of any steady clock.
class LightWindow {
  public:
    static constexpr std::size_t kMin = 16384;    ///< bytes; a picture or two
    static constexpr std::size_t kStart = 32768;  ///< before anything has been acknowledged
    static constexpr std::size_t kMax = 1048576;  ///< 80 Mbit/s at 100 ms
    static constexpr double kTargetMs = 100.0;    ///< of queueing, as that of frames
    static constexpr std::size_t kRoundTripsKept = 64;

    void on_sent(std::uint32_t number, std::size_t bytes, double now_ms);
    /// That message and all before it have arrived; unknown numbers are ignored.
    void on_ack(std::uint32_t number, double now_ms);
    [[nodiscard]] std::size_t bytes() const { return window_; }

  private:
    struct Sent {
        std::uint32_t number = 0;
        std::size_t bytes = 0;
        double at_ms = 0.0;
    };

    std::deque<Sent> sent_;
    std::deque<double> round_trips_ms_;
    std::size_t window_ = kStart;
};

}  // namespace raybundle
