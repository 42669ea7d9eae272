// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "scheduling/change_gate.h"
#include "scheduling/clock.h"
#include "scheduling/moving_scale.h"
#include "scheduling/phase_budget.h"
#include "scheduling/scheduling_settings.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// When a change of the scene may begin, how many bundles its special phase has time for, and how
/// large pictures are while an object is dragged.
class ChangePolicy {
  public:
    ChangePolicy(const SchedulingSettings& settings, const Clock& clock);

    [[nodiscard]] const Clock& clock() const { return clock_; }

    /// Whether the next change may begin. solver_rests: no iterations are wanted.
    [[nodiscard]] bool may_begin(bool solver_rests) const { return gate_.open(solver_rests); }

    /// A special phase begins. dragged: of an object whose drag goes on.
    void begin_phase(bool dragged);
    /// Notes the cost of all that came before its first bundle.
    void note_beginning(double cost_ms) { gate_.begin_change(cost_ms); }
    /// Notes the cost of a bundle of it. last: the phase ends. Of the full_pixels of all pictures,
    /// drawn_pixels are drawn.
    void note_bundle(double cost_ms, bool last, double full_pixels, double drawn_pixels);
    /// Notes that the change has been worked in: these viewers wait for a frame that shows it.
    void end_change(std::span<const ViewerId> watchers);

    /// Notes the cost of a viewer's frame.
    void note_frame(ViewerId viewer, double cost_ms) { gate_.note_frame(viewer, cost_ms); }
    /// Does not wait for this viewer, which cannot take a frame now.
    void excuse(ViewerId viewer) { gate_.excuse(viewer); }
    void note_iteration(double cost_ms) { gate_.note_iteration(cost_ms); }

    /// Bundles that a phase has time for.
    [[nodiscard]] const PhaseBudget& phase_budget() const { return phases_; }
    /// True if the running phase, or the last one, belongs to a drag that goes on.
    [[nodiscard]] bool phase_of_drag() const { return phase_of_drag_; }
    /// True shortly after an object has been dragged.
    [[nodiscard]] bool dragging() const;
    /// Share of width and height that all pictures have while an object is dragged.
    [[nodiscard]] double drag_scale() const { return drag_scale_.scale(); }

  private:
    void note_drag_phase(double full_pixels, double drawn_pixels);

    ChangeSettings settings_;
    const Clock& clock_;
    ChangeGate gate_;
    PhaseBudget phases_;
    MovingScale drag_scale_;
    double full_phase_ms_ = 0.0;  // mean of a phase of a drag if all pictures were full; 0: unknown
    bool phase_of_drag_ = false;
    TimePoint last_drag_;
};

}  // namespace raybundle
