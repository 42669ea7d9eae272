// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "net/ws/client_event.h"

namespace raybundle {

/// Bounded queue of client events from the network thread to the render thread.
///
/// Of one viewer's setCamera, setViewport and unfinished moves of one object only the newest waits:
/// it takes over the ids of those it replaces, as many as the limit allows; the oldest beyond them
/// is to be answered at once. Any other message of that viewer is a barrier, so that for example a
/// probe sees the camera that was set before it. What cannot be merged counts against a limit for
/// each viewer; joining and leaving always fit, since one viewer does both once.
class Inbox {
  public:
    /// What has become of a message.
    struct Pushed {
        bool taken = false;
        /// Id of a request that newer ones have replaced; nobody else answers it.
        std::optional<std::uint32_t> replaced;

        explicit operator bool() const { return taken; }
    };

    explicit Inbox(std::size_t max_waiting_per_viewer = 64)
        : max_waiting_(max_waiting_per_viewer) {}

    void joined(ViewerId viewer, v1::ClientMessage hello, v1::Role role = v1::EDITOR,
                bool caller = false);

    /// `call` hears of each viewer that joins, on the thread that reports it, right after its event
    /// has been queued. Set it before the network starts.
    void set_on_joined(std::function<void(ViewerId)> call) { on_joined_ = std::move(call); }

    /// Not taken where the viewer has too many requests waiting that cannot be merged.
    [[nodiscard]] Pushed push(ViewerId viewer, v1::ClientMessage message,
                              v1::Role role = v1::EDITOR, bool caller = false);

    /// Forgets what waits of this viewer; if the render thread has not heard of it yet, it never
    /// will.
    void left(ViewerId viewer);

    /// Takes everything that waits, in order of arrival.
    std::vector<ClientEvent> drain();

    /// Takes what has waited longest, but no message of those who are to wait: payers, see
    /// ClientEvent. Callers who are to wait do not even come in.
    std::optional<ClientEvent> take(const std::set<ViewerId>& to_wait);

    /// Events that wait.
    [[nodiscard]] std::size_t size() const;

    /// Waits until something waits, interrupt() is called or the time is up. True: something waits.
    bool wait_for(std::chrono::milliseconds timeout);

    /// Ends a wait_for() in progress, or the next one at once.
    void interrupt();

  private:
    using Events = std::deque<ClientEvent>;

    Events::iterator find_mergeable(ViewerId viewer, const v1::ClientMessage& message);

    std::size_t max_waiting_;
    std::function<void(ViewerId)> on_joined_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Events events_;
    bool interrupted_ = false;
};

}  // namespace raybundle
