// SPDX-License-Identifier: Apache-2.0
#include "telemetry/trace.h"

#include <algorithm>
#include <utility>

namespace raybundle {
namespace {

std::int64_t nanoseconds(auto since) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
}

}  // namespace

Trace::Trace(SpanSink& sink, std::string name, const std::optional<TraceContext>& parent,
             Clock::time_point begun)
    : sink_(sink), begun_(begun), ended_(begun), stage_(begun) {
    root_.trace = parent ? parent->trace : random_trace_id();
    root_.id = random_span_id();
    root_.parent = parent ? std::optional(parent->span) : std::nullopt;
    root_.serves = true;
    root_.name = std::move(name);
}

/// One reading of both clocks for all spans: whatever sets the system's clock, they stay in order.
Trace::~Trace() {
    const std::int64_t offset = nanoseconds(std::chrono::system_clock::now().time_since_epoch()) -
                                nanoseconds(Clock::now().time_since_epoch());
    const auto unix_ns = [offset](Clock::time_point time) {
        return static_cast<std::uint64_t>(offset + nanoseconds(time.time_since_epoch()));
    };
    root_.begun_ns = unix_ns(begun_);
    root_.ended_ns = unix_ns(ended_);
    if (dropped_ > 0) {
        set("raybundle.spans_dropped", dropped_);
    }
    std::vector<Span> spans{root_};
    for (Part& part : parts_) {
        spans.push_back({root_.trace, random_span_id(), root_.id, false, std::move(part.name),
                         unix_ns(part.begun), unix_ns(part.ended), std::move(part.attributes),
                         std::nullopt});
    }
    sink_.submit(std::move(spans));
}

void Trace::set(const std::string& key, AttributeValue value) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(root_.attributes.begin(), root_.attributes.end(),
                                    [&](const Attribute& other) { return other.first == key; });
    if (found == root_.attributes.end()) {
        root_.attributes.emplace_back(key, std::move(value));
    } else {
        found->second = std::move(value);
    }
}

void Trace::fail(const std::string& reason) {
    const std::lock_guard lock(mutex_);
    root_.error = reason;
}

void Trace::keep(Part part) {
    ended_ = std::max(ended_, part.ended);
    if (parts_.size() + 1 < max_spans) {
        parts_.push_back(std::move(part));
    } else {
        ++dropped_;
    }
}

void Trace::end_stage(std::string name, std::vector<Attribute> attributes, Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    keep({std::move(name), stage_, now, std::move(attributes)});
    stage_ = now;
}

void Trace::add(std::string name, Clock::time_point begun, std::vector<Attribute> attributes,
                Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    keep({std::move(name), begun, now, std::move(attributes)});
}

}  // namespace raybundle
