// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "journal/change_sum.h"
#include "net/ws/client_event.h"

namespace raybundle {

/// A change of the scene that waits to be made, and everyone who asked for a part of it.
struct PendingChange {
    v1::SceneChanged change;  ///< without epoch; not set: an undo
    std::vector<ClientEvent> requests;
    bool undone = false;  ///< of an undo: its changes have been made, it is to be answered

    [[nodiscard]] bool is_undo() const {
        return change.change_case() == v1::SceneChanged::CHANGE_NOT_SET;
    }
};

/// Changes in the order in which their subjects were first asked for. What is asked for of a
/// subject that waits already joins it, so that nothing is lost and nothing is made twice; an undo
/// stands between what comes before it and after it.
class ChangeQueue {
  public:
    /// A request of kind moveObject, setLight, setMaterial or undo.
    void add(const ClientEvent& event);
    /// Puts the changes of an undo in front, and the undo itself, now `undone`, behind them.
    void add_undone(const std::vector<v1::SceneChanged>& changes, const PendingChange& undo);
    [[nodiscard]] bool empty() const { return pending_.empty(); }
    [[nodiscard]] std::size_t size() const { return pending_.size(); }
    [[nodiscard]] const PendingChange& front() const { return pending_.front(); }
    PendingChange take();
    /// All requests that wait; the queue is empty then.
    std::vector<ClientEvent> take_requests();

  private:
    std::deque<PendingChange> pending_;
};

/// The change that a request asks for; empty for an undo.
v1::SceneChanged change_of(const ClientEvent& event);

}  // namespace raybundle
