// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "telemetry/span.h"

namespace raybundle {

/// The trace of one thing that happens, while it happens: a span for all of it, and below that one
/// for each stage. It is sent when nobody holds it any more. Any thread.
class Trace {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t max_spans = 256;  ///< further ones are only counted

    /// parent: whose trace it goes on with; nothing: one of its own.
    Trace(SpanSink& sink, std::string name, const std::optional<TraceContext>& parent,
          Clock::time_point begun);
    ~Trace();
    Trace(const Trace&) = delete;
    Trace& operator=(const Trace&) = delete;

    /// Of the span for all of it.
    [[nodiscard]] TraceContext context() const { return {root_.trace, root_.id, true}; }

    /// Sets an attribute of the whole.
    void set(const std::string& key, AttributeValue value);
    /// It has failed.
    void fail(const std::string& reason);

    /// A stage ends now that began where the one before ended.
    void end_stage(std::string name, std::vector<Attribute> attributes = {},
                   Clock::time_point now = Clock::now());
    /// Something that went on beside the stages ends now.
    void add(std::string name, Clock::time_point begun, std::vector<Attribute> attributes = {},
             Clock::time_point now = Clock::now());

  private:
    struct Part {
        std::string name;
        Clock::time_point begun, ended;
        std::vector<Attribute> attributes;
    };
    void keep(Part part);

    SpanSink& sink_;
    std::mutex mutex_;
    Span root_;  ///< without its times until the end
    std::vector<Part> parts_;
    std::int64_t dropped_ = 0;
    Clock::time_point begun_, ended_;
    Clock::time_point stage_;  ///< where the next one begins
};

}  // namespace raybundle
