// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_queue.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace raybundle {

namespace {
constexpr std::size_t max_requests = 64;  // of one change; a further one waits for its own
}

v1::SceneChanged change_of(const ClientEvent& event) {
    v1::SceneChanged change;
    change.set_by(event.viewer);
    const v1::ClientMessage& message = event.message;
    if (message.has_move_object()) {
        *change.mutable_move_object() = message.move_object();
    } else if (message.has_set_light() && !message.set_light().same_type()) {
        *change.mutable_set_light() = message.set_light();
    } else if (message.has_add_luminaire() && message.add_luminaire().light() > 0) {
        *change.mutable_add_luminaire() = message.add_luminaire();
    } else if (message.has_add_object() && message.add_object().object() > 0) {
        *change.mutable_add_object() = message.add_object();
    } else if (message.has_remove_light()) {
        change.mutable_add_luminaire()->set_light(message.remove_light().light());
        change.mutable_add_luminaire()->set_removed(true);
    } else if (message.has_remove_object()) {
        change.mutable_add_object()->set_object(message.remove_object().object());
        change.mutable_add_object()->set_removed(true);
    } else if (message.has_set_material()) {
        *change.mutable_set_material() = message.set_material();
    } else if (message.has_set_daylight()) {
        *change.mutable_set_daylight() = message.set_daylight();
    }
    return change;
}

std::vector<RequestKey> keys_of(const PendingChange& pending) {
    std::vector<RequestKey> keys = pending.keys;
    for (const ClientEvent& request : pending.requests) {
        if (request.message.has_request_key()) {
            keys.push_back({request.message.request_key()});
        }
    }
    return keys;
}

/// Whether a request goes on where one that waits last has begun: a group that is being dimmed.
bool ChangeQueue::joins_last(const ClientEvent& event) const {
    const auto group_of = [](const ClientEvent& e) { return e.message.set_group().group(); };
    return event.message.has_set_group() && !pending_.empty() &&
           pending_.back().stands_for_several() && !pending_.back().expanded &&
           pending_.back().requests.size() < max_requests &&
           pending_.back().requests.front().message.has_set_group() &&
           group_of(pending_.back().requests.front()) == group_of(event);
}

void ChangeQueue::join(PendingChange& waiting, const ClientEvent& event,
                       std::shared_ptr<Trace> trace) {
    waiting.requests.push_back(event);
    if (trace) {
        waiting.traces.push_back(std::move(trace));
    }
}

void ChangeQueue::add(const ClientEvent& event, std::shared_ptr<Trace> trace) {
    const v1::SceneChanged change = change_of(event);
    if (joins_last(event)) {
        join(pending_.back(), event, std::move(trace));
        return;
    }
    PendingChange* waiting = nullptr;
    for (PendingChange& pending : pending_) {
        if (pending.stands_for_several()) {
            waiting = nullptr;
        } else if (pending.recorded) {
            continue;
        } else if (subject_of(pending.change) == subject_of(change)) {
            waiting = &pending;
        }
    }
    const bool several = change.change_case() == v1::SceneChanged::CHANGE_NOT_SET;
    if (several || waiting == nullptr || waiting->requests.size() >= max_requests) {
        pending_.push_back({change, {}});
        join(pending_.back(), event, std::move(trace));
        return;
    }
    add_change(change, waiting->change);
    waiting->change.clear_animation();
    join(*waiting, event, std::move(trace));
}

void ChangeQueue::add_expanded(const std::vector<v1::SceneChanged>& changes,
                               const PendingChange& request, std::uint32_t made, bool fresh) {
    pending_.push_front(request);
    pending_.front().expanded = true;
    const auto all = made + static_cast<std::uint32_t>(changes.size());
    for (std::uint32_t number = all; number > made; --number) {
        PendingChange part{changes[number - made - 1], {}};
        part.change.set_by(request.requests.back().viewer);
        part.keys = keys_of(request);
        for (RequestKey& key : part.keys) {
            key.part = number;
            key.parts = all;
        }
        part.part = true;
        part.fresh = fresh;
        part.traces = request.traces;
        pending_.push_front(std::move(part));
    }
}

std::deque<PendingChange>::iterator ChangeQueue::behind_recorded() {
    return std::find_if(pending_.begin(), pending_.end(),
                        [](const PendingChange& pending) { return !pending.recorded; });
}

void ChangeQueue::add_recorded(LogEntry entry, std::shared_ptr<Trace> trace) {
    PendingChange pending{std::move(entry.change), {}};
    pending.recorded = true;
    pending.keys = std::move(entry.keys);
    if (trace) {
        pending.traces.push_back(std::move(trace));
    }
    pending_.insert(behind_recorded(), std::move(pending));
}

void ChangeQueue::put_back(std::vector<PendingChange> changes) {
    if (changes.empty()) {
        return;  // libstdc++'s deque moves elements onto themselves, which empties their requests
    }
    pending_.insert(behind_recorded(), std::make_move_iterator(changes.begin()),
                    std::make_move_iterator(changes.end()));
}

void ChangeQueue::add_steps(const std::vector<v1::SceneChanged>& changes,
                            std::shared_ptr<Trace> trace) {
    for (const v1::SceneChanged& change : changes) {
        pending_.push_back({change, {}, false});
        if (trace) {
            pending_.back().traces.push_back(std::exchange(trace, nullptr));
        }
    }
}

bool ChangeQueue::has_steps() const {
    return std::any_of(pending_.begin(), pending_.end(),
                       [](const PendingChange& p) { return p.change.has_animation(); });
}

void ChangeQueue::put_first(PendingChange pending) {
    pending_.push_front(std::move(pending));
}

PendingChange ChangeQueue::take() {
    PendingChange first = std::move(pending_.front());
    pending_.pop_front();
    return first;
}

std::vector<ClientEvent> ChangeQueue::take_requests() {
    std::vector<ClientEvent> requests;
    for (const PendingChange& pending : pending_) {
        requests.insert(requests.end(), pending.requests.begin(), pending.requests.end());
    }
    pending_.clear();
    return requests;
}

}  // namespace raybundle
