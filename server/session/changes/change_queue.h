// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "journal/change_sum.h"
#include "journal/project_log.h"
#include "net/ws/client_event.h"
#include "telemetry/trace.h"

namespace raybundle {

/// A change of the scene that waits to be made, and everyone who asked for a part of it.
struct PendingChange {
    v1::SceneChanged change;  ///< without epoch; not set: stands for several ones
    std::vector<ClientEvent> requests;
    bool expanded = false;  ///< of several ones: they have been made, it is to be answered
    /// Is in the log already, by another server of the project, with its epoch and its keys.
    bool recorded = false;
    std::vector<RequestKey> keys = {};
    bool again = false;  ///< has had its turn, when other servers were quicker
    bool part = false;   ///< of what a request stands for, whose keys it has
    /// A part that nobody else adds under another number: it gets its number when it is its turn.
    bool fresh = false;
    std::vector<std::shared_ptr<Trace>> traces = {};  ///< of the requests, where somebody wants any

    /// An undo, a group of lights, a lighting scene: which changes these are is found out when it
    /// is their turn.
    [[nodiscard]] bool stands_for_several() const {
        return change.change_case() == v1::SceneChanged::CHANGE_NOT_SET;
    }
};

/// Changes in the order in which their subjects were first asked for. What is asked for of a
/// subject that waits already joins it, so that nothing is lost and nothing is made twice; what
/// stands for several changes stands between what comes before it and after it.
class ChangeQueue {
  public:
    /// A request for a change, or for what stands for several.
    void add(const ClientEvent& event, std::shared_ptr<Trace> trace = nullptr);
    /// Puts the changes that a request stands for in front, each a part of it with its keys, and
    /// itself, now `expanded`, behind them. made: how many parts of it have been made before, by a
    /// server that has ended since.
    void add_expanded(const std::vector<v1::SceneChanged>& changes, const PendingChange& request,
                      std::uint32_t made = 0, bool fresh = false);
    /// A change that another server has made: behind those of the kind, before all others.
    void add_recorded(LogEntry entry, std::shared_ptr<Trace> trace = nullptr);
    /// Puts changes back whose turn has not come after all, in order, behind recorded ones.
    void put_back(std::vector<PendingChange> changes);
    /// Changes that an animation makes, behind all others. trace: of the request that has it
    /// played, which the first of them is part of.
    void add_steps(const std::vector<v1::SceneChanged>& changes,
                   std::shared_ptr<Trace> trace = nullptr);
    [[nodiscard]] bool has_steps() const;
    /// The change that requests ask for, once it is known which that is; answered by it.
    void put_first(PendingChange pending);
    [[nodiscard]] bool empty() const { return pending_.empty(); }
    [[nodiscard]] std::size_t size() const { return pending_.size(); }
    [[nodiscard]] const PendingChange& front() const { return pending_.front(); }
    PendingChange take();
    /// All requests that wait; the queue is empty then.
    std::vector<ClientEvent> take_requests();

  private:
    static void join(PendingChange& waiting, const ClientEvent& event,
                     std::shared_ptr<Trace> trace);
    [[nodiscard]] bool joins_last(const ClientEvent& event) const;
    [[nodiscard]] std::deque<PendingChange>::iterator behind_recorded();

    std::deque<PendingChange> pending_;
};

/// Keys of the requests for a change, or those that it has.
std::vector<RequestKey> keys_of(const PendingChange& pending);

/// The change that a request asks for; empty for what stands for several.
v1::SceneChanged change_of(const ClientEvent& event);

}  // namespace raybundle
