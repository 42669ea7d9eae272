// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "telemetry/trace_context.h"

namespace raybundle {

class Trace;

/// What this thread logs while it lives belongs to a trace; null: to the one before.
class TraceScope {
  public:
    explicit TraceScope(const Trace* trace);
    ~TraceScope();
    TraceScope(const TraceScope&) = delete;
    TraceScope& operator=(const TraceScope&) = delete;

  private:
    std::optional<TraceContext> before_;
};

/// Of this thread.
const std::optional<TraceContext>& current_trace();

}  // namespace raybundle
