// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <span>

#include "stream/viewer_id.h"

namespace raybundle {

/// Decides when the next change of the scene may begin. No frame is drawn while a change is worked
/// in: changes in a row would stop everybody's pictures. Between two changes, every viewer that can
/// take a frame gets one, and iterations get their share of the time of the change and these
/// frames, one iteration at least. Has no clock of its own.
class ChangeGate {
  public:
    /// iteration_share: of the time.
    explicit ChangeGate(double iteration_share) : iteration_share_(iteration_share) {}

    /// Notes that a change has begun, and the cost of its beginning.
    void begin_change(double cost_ms);
    /// Notes the cost of a slice of the work on it.
    void note_change(double cost_ms) { owe(cost_ms); }
    /// Notes that the change has been worked in: these viewers wait for a frame that shows it.
    void end_change(std::span<const ViewerId> watchers);

    /// Notes the cost of a viewer's frame.
    void note_frame(ViewerId viewer, double cost_ms);
    /// Does not wait for this viewer: it is away, its network is slow, or its last frame is being
    /// encoded.
    void excuse(ViewerId viewer) { waiting_.erase(viewer); }
    /// Notes the cost of an iteration.
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
