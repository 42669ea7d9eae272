// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "net/ws/client_event.h"
#include "session/changes/change_queue.h"
#include "stream/viewer_id.h"
#include "telemetry/trace.h"
#include "telemetry/trace_scope.h"

namespace raybundle {

/// Follows each change that a viewer asks for, from its message to the first frames that show it:
/// a trace with the stages inbox, queue, record, apply and special phase, then a frame for each
/// viewer. What plays is followed to the first frames of it, and a change of another server from
/// when it has come, as part of the trace there. Where nobody wants traces there are none, and
/// every call returns at once.
class ChangeTraces {
  public:
    using Clock = Trace::Clock;
    /// A viewer that has got no frame by then, as one that has paused, is waited for no longer.
    static constexpr std::chrono::seconds max_wait{10};
    static constexpr std::size_t max_awaited = 64;  ///< traces that wait for one viewer's frame

    /// sink: null where nobody wants traces.
    ChangeTraces(SpanSink* sink, std::string scene) : sink_(sink), scene_(std::move(scene)) {}

    /// The trace of a request that has come out of the inbox; null where there is to be none.
    [[nodiscard]] std::shared_ptr<Trace> begin(const ClientEvent& request) const;
    /// The trace of a change that another server has made; null where that one keeps none.
    [[nodiscard]] std::shared_ptr<Trace> begin(const LogEntry& followed) const;

    /// The special phase of a change begins.
    void begin_phase(const PendingChange& change);
    /// It has ended: viewers wait for frames of this epoch.
    void end_phase(std::span<const ViewerId> watchers, std::uint32_t epoch);

    /// A frame of a viewer goes out. Any thread.
    void note_frame(ViewerId viewer, std::uint32_t epoch, std::size_t bytes);
    /// A viewer has left. Any thread.
    void forget(ViewerId viewer);
    /// Gives up what has been waited for too long.
    void expire(Clock::time_point now = Clock::now());

  private:
    struct Awaited {
        std::shared_ptr<Trace> trace;
        std::uint32_t epoch = 0;
        Clock::time_point since;
    };

    SpanSink* sink_;
    std::string scene_;
    std::vector<std::shared_ptr<Trace>> in_phase_;
    std::mutex mutex_;
    std::map<ViewerId, std::vector<Awaited>> awaited_;
};

/// Ends a stage of all traces of a change.
void end_stage(const PendingChange& change, const std::string& name);
/// What they tell of has failed.
void fail(const std::vector<std::shared_ptr<Trace>>& traces, const std::string& reason);
/// What other servers go on with; empty where there is no trace.
[[nodiscard]] std::string traceparent_of(const PendingChange& change);
/// What is logged belongs to the first of them.
[[nodiscard]] TraceScope scope_of(const PendingChange& change);

}  // namespace raybundle
