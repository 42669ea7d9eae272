// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_traces.h"

#include <algorithm>
#include <utility>

#include "net/ws/rules/message_rules.h"

namespace raybundle {

std::shared_ptr<Trace> ChangeTraces::begin(const ClientEvent& request) const {
    if (sink_ == nullptr) {
        return nullptr;
    }
    const auto parent = parse_traceparent(request.message.traceparent());
    if (parent && !parent->sampled) {
        return nullptr;
    }
    const std::string kind = message_name(request.message);
    auto trace = std::make_shared<Trace>(*sink_, "change " + kind, parent, request.received);
    trace->set("raybundle.change", kind);
    trace->set("raybundle.viewer", std::int64_t{request.viewer});
    trace->set("raybundle.scene", scene_);
    trace->end_stage("inbox");
    return trace;
}

std::shared_ptr<Trace> ChangeTraces::begin(const LogEntry& followed) const {
    const auto parent = parse_traceparent(followed.traceparent);
    if (sink_ == nullptr || !parent || !parent->sampled) {
        return nullptr;
    }
    const auto* const field = v1::SceneChanged::descriptor()->FindFieldByNumber(
        static_cast<int>(followed.change.change_case()));
    const std::string kind = field == nullptr ? "change" : field->json_name();
    auto trace = std::make_shared<Trace>(*sink_, "follow " + kind, parent, Clock::now());
    trace->set("raybundle.change", kind);
    trace->set("raybundle.scene", scene_);
    return trace;
}

void ChangeTraces::begin_phase(const PendingChange& change) {
    in_phase_.insert(in_phase_.end(), change.traces.begin(), change.traces.end());
}

void ChangeTraces::end_phase(std::span<const ViewerId> watchers, std::uint32_t epoch) {
    const Clock::time_point now = Clock::now();
    const std::lock_guard lock(mutex_);
    for (const std::shared_ptr<Trace>& trace : in_phase_) {
        trace->end_stage("special phase", {}, now);
        for (const ViewerId viewer : watchers) {
            std::vector<Awaited>& awaited = awaited_[viewer];
            if (awaited.size() < max_awaited) {
                awaited.push_back({trace, epoch, now});
            }
        }
    }
    in_phase_.clear();
}

void ChangeTraces::note_frame(ViewerId viewer, std::uint32_t epoch, std::size_t bytes) {
    if (sink_ == nullptr) {
        return;
    }
    const std::lock_guard lock(mutex_);
    const auto found = awaited_.find(viewer);
    if (found == awaited_.end()) {
        return;
    }
    std::erase_if(found->second, [&](const Awaited& awaited) {
        if (awaited.epoch > epoch) {
            return false;
        }
        awaited.trace->add("frame", awaited.since,
                           {{"raybundle.viewer", std::int64_t{viewer}},
                            {"raybundle.epoch", std::int64_t{epoch}},
                            {"raybundle.bytes", static_cast<std::int64_t>(bytes)}});
        return true;
    });
    if (found->second.empty()) {
        awaited_.erase(found);
    }
}

void ChangeTraces::forget(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    awaited_.erase(viewer);
}

void ChangeTraces::expire(Clock::time_point now) {
    if (sink_ == nullptr) {
        return;
    }
    const std::lock_guard lock(mutex_);
    for (auto& [viewer, awaited] : awaited_) {
        std::erase_if(awaited, [now](const Awaited& a) { return now - a.since > max_wait; });
    }
    std::erase_if(awaited_, [](const auto& entry) { return entry.second.empty(); });
}

void end_stage(const PendingChange& change, const std::string& name) {
    for (const std::shared_ptr<Trace>& trace : change.traces) {
        trace->end_stage(name);
    }
}

void fail(const std::vector<std::shared_ptr<Trace>>& traces, const std::string& reason) {
    for (const std::shared_ptr<Trace>& trace : traces) {
        trace->fail(reason);
    }
}

std::string traceparent_of(const PendingChange& change) {
    return change.traces.empty() ? std::string() : traceparent_of(change.traces.front()->context());
}

TraceScope scope_of(const PendingChange& change) {
    return TraceScope(change.traces.empty() ? nullptr : change.traces.front().get());
}

}  // namespace raybundle
