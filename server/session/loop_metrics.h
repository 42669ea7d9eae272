// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "journal/solution_exchange.h"
#include "scheduling/clock.h"
#include "stream/video_encoders.h"
#include "transport/iteration_schedule.h"

namespace raybundle {

/// State of the render loop, once a second.
struct LoopFigures {
    std::uint64_t iterations = 0;
    double iterations_per_second = 0.0;
    double settled = 0.0;                  ///< 0..1
    std::optional<double> relative_error;  ///< largest of all viewers' pictures
    std::uint32_t epoch = 0;
    unsigned viewers = 0, moving = 0, paused = 0;
    std::uint64_t non_finite = 0;  ///< contributions dropped
    std::size_t gl_bytes = 0;      ///< buffers and textures
    std::uint64_t journal_failures = 0;
    bool journal_working = true;
    std::optional<ExchangeFigures> exchange;  ///< absent: light is not shared with other workers
};

/// What /metrics says about the render loop. Written by its thread, read by any.
class LoopMetrics {
  public:
    void count_frame(std::size_t bytes);
    /// A message of light; any thread.
    void count_light(std::size_t bytes) {
        ++light_messages_;
        light_bytes_ += bytes;
    }
    void set_light_viewers(std::size_t viewers) { light_viewers_ = viewers; }
    void set_video_load(const VideoEncoders::Load& load) {
        video_encoders_ = load.encoders;
        video_bytes_ = load.bytes;
    }
    void count_turn() { ++turns_; }
    void count_refused_viewer() { ++refused_; }
    void count_phase() { ++phases_; }  ///< special iteration phases begun

    /// A step of the solver; `strategy` absent: a slice of a special iteration phase.
    void note_step(std::optional<Strategy> strategy, double milliseconds);

    void publish(const LoopFigures& figures, TimePoint now);

    /// Prometheus text; names and units are in deploy/README.md.
    [[nodiscard]] std::string text() const;

  private:
    struct Steps {
        std::uint64_t count = 0;
        double seconds = 0.0;
    };

    std::atomic<std::uint64_t> frames_{0}, frame_bytes_{0}, refused_{0}, phases_{0}, turns_{0};
    std::atomic<std::uint64_t> light_messages_{0}, light_bytes_{0}, light_viewers_{0};
    std::atomic<std::uint64_t> video_encoders_{0}, video_bytes_{0};
    mutable std::mutex mutex_;
    Steps perspective_, layered_, opening_, special_;
    LoopFigures figures_;
    double frames_per_second_ = 0.0;
    std::uint64_t frames_before_ = 0;
    TimePoint published_;
};

}  // namespace raybundle
