// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace raybundle {

using TraceId = std::array<std::uint8_t, 16>;
using SpanId = std::array<std::uint8_t, 8>;

/// Which span of which trace something belongs to: W3C Trace Context,
/// https://www.w3.org/TR/trace-context/.
struct TraceContext {
    TraceId trace{};
    SpanId span{};
    bool sampled = true;  ///< its caller keeps the trace
};

/// "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01". Nothing for any other text, which the
/// standard wants ignored.
std::optional<TraceContext> parse_traceparent(std::string_view text);
std::string traceparent_of(const TraceContext& context);

/// Lower-case hexadecimal digits.
std::string hex_of(std::span<const std::uint8_t> bytes);

/// Random numbers of the system, which have nothing to do with the seeds of the solver; never 0.
TraceId random_trace_id();
SpanId random_span_id();

}  // namespace raybundle
