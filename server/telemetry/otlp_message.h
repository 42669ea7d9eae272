// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "telemetry/span.h"

namespace raybundle {

/// What all spans of a process have in common.
struct SpanSource {
    std::string service = "raybundle";  ///< service.name
    std::vector<Attribute> attributes;  ///< further ones of the resource
};

/// Bytes of an ExportTraceServiceRequest, see protocol/otlp_trace.proto.
std::string otlp_message(const SpanSource& source, std::span<const Span> spans);

}  // namespace raybundle
