// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "telemetry/trace_context.h"

namespace raybundle {

using AttributeValue = std::variant<std::int64_t, double, bool, std::string>;
using Attribute = std::pair<std::string, AttributeValue>;

/// A stretch of time of a trace, as it is sent.
struct Span {
    TraceId trace{};
    SpanId id{};
    std::optional<SpanId> parent;
    bool serves = false;  ///< what somebody else has asked for
    std::string name;
    std::uint64_t begun_ns = 0;  ///< Unix time
    std::uint64_t ended_ns = 0;
    std::vector<Attribute> attributes;
    std::optional<std::string> error;
};

/// Takes finished spans; any thread, and it never waits.
class SpanSink {
  public:
    SpanSink() = default;
    virtual ~SpanSink() = default;
    SpanSink(const SpanSink&) = delete;
    SpanSink& operator=(const SpanSink&) = delete;

    virtual void submit(std::vector<Span> spans) = 0;
};

}  // namespace raybundle
