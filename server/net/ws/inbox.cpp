// SPDX-License-Identifier: Apache-2.0
#include "net/ws/inbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "net/ws/rules/message_rules.h"

namespace raybundle {
namespace {

using WaitingBody = v1::ClientMessage::BodyCase;

/// Messages of which only the newest matters.
bool is_state(const v1::ClientMessage& message) {
    const MessageRule* const rule = rule_of(message.body_case());
    return rule != nullptr && rule->waiting == Waiting::newest_only;
}

bool is_final(const v1::MoveObject& move) {
    return !move.has_final() || move.final();
}

/// Whether both set the same thing: the camera, the viewport, the place of one object.
bool same_subject(const v1::ClientMessage& a, const v1::ClientMessage& b) {
    return a.body_case() == b.body_case() && (a.body_case() != WaitingBody::kMoveObject ||
                                              a.move_object().object() == b.move_object().object());
}

}  // namespace

void Inbox::joined(ViewerId viewer, v1::ClientMessage hello, v1::Role role, bool caller) {
    {
        const std::lock_guard lock(mutex_);
        events_.push_back({viewer, ClientEvent::Kind::joined, std::move(hello), {}, role, caller});
    }
    changed_.notify_one();
    if (on_joined_) {
        on_joined_(viewer);
    }
}

/// The waiting event that `message` makes obsolete, or end().
Inbox::Events::iterator Inbox::find_mergeable(ViewerId viewer, const v1::ClientMessage& message) {
    if (!is_state(message)) {
        return events_.end();
    }
    for (auto event = events_.rbegin(); event != events_.rend(); ++event) {
        if (event->viewer != viewer) {
            continue;
        }
        if (event->kind != ClientEvent::Kind::message || !is_state(event->message)) {
            return events_.end();
        }
        if (same_subject(event->message, message)) {
            const bool settled = message.body_case() == WaitingBody::kMoveObject &&
                                 is_final(event->message.move_object());
            return settled ? events_.end() : std::next(event).base();
        }
    }
    return events_.end();
}

Inbox::Pushed Inbox::push(ViewerId viewer, v1::ClientMessage message, v1::Role role, bool caller) {
    Pushed pushed{true, std::nullopt};
    {
        const std::lock_guard lock(mutex_);
        ClientEvent event{viewer, ClientEvent::Kind::message, std::move(message), {}, role, caller};
        event.received = std::chrono::steady_clock::now();
        if (const auto old = find_mergeable(viewer, event.message); old != events_.end()) {
            event.superseded = std::move(old->superseded);
            if (old->message.has_id()) {
                event.superseded.push_back(old->message.id());
            }
            if (event.superseded.size() > max_waiting_) {
                pushed.replaced = event.superseded.front();
                event.superseded.erase(event.superseded.begin());
            }
            events_.erase(old);
        } else {
            const auto waiting = std::count_if(
                events_.begin(), events_.end(),
                [viewer](const ClientEvent& other) { return other.viewer == viewer; });
            if (static_cast<std::size_t>(waiting) >= max_waiting_) {
                return {};
            }
        }
        events_.push_back(std::move(event));
    }
    changed_.notify_one();
    return pushed;
}

void Inbox::left(ViewerId viewer) {
    {
        const std::lock_guard lock(mutex_);
        const auto of_viewer = [viewer](const ClientEvent& event) {
            return event.viewer == viewer;
        };
        const bool unheard =
            std::any_of(events_.begin(), events_.end(), [&](const ClientEvent& event) {
                return of_viewer(event) && event.kind == ClientEvent::Kind::joined;
            });
        std::erase_if(events_, of_viewer);
        if (unheard) {
            return;
        }
        events_.push_back({viewer, ClientEvent::Kind::left, {}, {}, v1::EDITOR});
    }
    changed_.notify_one();
}

std::vector<ClientEvent> Inbox::drain() {
    const std::lock_guard lock(mutex_);
    std::vector<ClientEvent> events(std::move_iterator(events_.begin()),
                                    std::move_iterator(events_.end()));
    events_.clear();
    return events;
}

std::optional<ClientEvent> Inbox::take(const std::set<ViewerId>& to_wait) {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(events_.begin(), events_.end(), [&to_wait](const ClientEvent& event) {
            const bool may_wait = event.kind == ClientEvent::Kind::message || event.caller;
            return !may_wait || !to_wait.contains(event.payer());
        });
    if (found == events_.end()) {
        return std::nullopt;
    }
    ClientEvent event = std::move(*found);
    events_.erase(found);
    return event;
}

std::size_t Inbox::size() const {
    const std::lock_guard lock(mutex_);
    return events_.size();
}

bool Inbox::wait_for(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return interrupted_ || !events_.empty(); });
    interrupted_ = false;
    return !events_.empty();
}

void Inbox::interrupt() {
    {
        const std::lock_guard lock(mutex_);
        interrupted_ = true;
    }
    changed_.notify_all();
}

}  // namespace raybundle
