// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <span>

#include "stream/viewer_id.h"

namespace raybundle {

/// Decides when the next change of the scene may begin. No frame is drawn while a change is worked
/// in, so changes that follow each other at once would stop everybody's pictures. Between two
/// changes every viewer that can take a frame gets one, and iterations get their share of the time
/// that the change and these frames take, one at least. Has no clock of its own: it is told what
/// work has cost.
class ChangeGate {
  public:
    /// iteration_share: of the time.
    explicit ChangeGate(double iteration_share) : iteration_share_(iteration_share) {}

    /// A change has begun, and its beginning has taken so long.
    void begin_change(double cost_ms);
    /// A slice of the work on it has taken so long.
    void note_change(double cost_ms) { owe(cost_ms); }
    /// It has been worked in: these viewers wait for a frame that shows it.
    void end_change(std::span<const ViewerId> watchers);

    /// A viewer's frame has been drawn and has taken so long.
    void note_frame(ViewerId viewer, double cost_ms);
    /// A viewer cannot take a frame now: it is away, its network is slow, or its last frame is
    /// being encoded.
    void excuse(ViewerId viewer) { waiting_.erase(viewer); }
    /// An iteration has taken so long.
    void note_iteration(double cost_ms);

    /// Whether the next change may begin. solver_rests: no iterations are wanted.
    [[nodiscard]] bool open(bool solver_rests) const {
        return waiting_.empty() && (solver_rests || !iterations_due_);
    }

  private:
    void owe(double cost_ms);

    double iteration_share_;
    std::set<ViewerId> waiting_;
    double owed_ms_ = 0.0;         // to iterations, since the last change began
    bool iterations_due_ = false;  // likewise
};

}  // namespace raybundle
