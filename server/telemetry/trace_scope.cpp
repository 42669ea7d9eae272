// SPDX-License-Identifier: Apache-2.0
#include "telemetry/trace_scope.h"

#include "telemetry/trace.h"

namespace raybundle {
namespace {

thread_local std::optional<TraceContext> trace_of_thread;

}  // namespace

TraceScope::TraceScope(const Trace* trace) : before_(trace_of_thread) {
    if (trace != nullptr) {
        trace_of_thread = trace->context();
    }
}

TraceScope::~TraceScope() {
    trace_of_thread = before_;
}

const std::optional<TraceContext>& current_trace() {
    return trace_of_thread;
}

}  // namespace raybundle
