// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "telemetry/otlp_settings.h"
#include "telemetry/span.h"

namespace raybundle {

/// Sends spans to a collector, on a thread of its own. Who submits some never waits: they stand in
/// a queue, and where that is full, or the collector stays away, they are dropped and counted.
class SpanExporter : public SpanSink {
  public:
    static constexpr std::size_t max_queued = 4096;
    static constexpr std::size_t max_batch = 512;
    static constexpr int max_attempts = 5;  ///< of one batch, where its failure may pass
    /// stop() waits so long for what is left to be sent.
    static constexpr std::chrono::milliseconds last_time{1000};

    /// Throws std::runtime_error where the certificates of the settings cannot be read.
    explicit SpanExporter(OtlpSettings settings);
    ~SpanExporter() override { stop(); }

    void submit(std::vector<Span> spans) override;

    /// Ends its thread, within last_time; what has not gone out by then is dropped.
    void stop();

    struct Figures {
        std::uint64_t exported = 0;  ///< spans that the collector has taken
        std::uint64_t dropped = 0;   ///< spans that it has not and never will
        std::uint64_t failures = 0;  ///< attempts to send some
    };
    [[nodiscard]] Figures figures() const;

  private:
    using Clock = std::chrono::steady_clock;

    void run();
    std::vector<Span> take_batch();
    void deliver(const std::vector<Span>& batch);
    bool rest(std::chrono::milliseconds time);
    [[nodiscard]] Clock::time_point deadline(Clock::time_point begun) const;
    void note_failure(const PostResult& result);
    void note_success(std::size_t spans);

    const OtlpSettings settings_;
    const HttpPost post_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Span> queue_;
    bool stopping_ = false;
    Clock::time_point last_end_;  ///< once stopping_ is set
    std::atomic<std::uint64_t> exported_{0}, dropped_{0}, failures_{0};
    bool failing_ = false;  ///< the last attempt; its thread only
    std::thread thread_;
};

}  // namespace raybundle
