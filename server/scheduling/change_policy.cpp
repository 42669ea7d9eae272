// SPDX-License-Identifier: Apache-2.0
#include "scheduling/change_policy.h"

#include <algorithm>

namespace raybundle {

ChangePolicy::ChangePolicy(const SchedulingSettings& settings, const Clock& clock)
    : settings_(settings.changes),
      clock_(clock),
      gate_(settings.changes.iteration_share),
      phases_(settings.changes),
      drag_scale_(settings.moving_scale) {}

void ChangePolicy::begin_phase(bool dragged) {
    phases_.begin(clock_.now_ms());
    phase_of_drag_ = dragged;
    last_drag_ = dragged ? clock_.now() : last_drag_;
}

void ChangePolicy::note_bundle(double cost_ms, bool last, double full_pixels, double drawn_pixels) {
    phases_.note_bundle(clock_.now_ms(), last);
    if (last && phase_of_drag_) {
        note_drag_phase(full_pixels, drawn_pixels);
    }
    gate_.note_change(cost_ms);
}

/// The time of a whole phase of a drag decides about the sizes of pictures in the next one.
void ChangePolicy::note_drag_phase(double full_pixels, double drawn_pixels) {
    const double full_ms =
        phases_.elapsed_ms(clock_.now_ms()) * full_pixels / std::max(drawn_pixels, 1.0);
    const double weight = full_phase_ms_ > 0.0 ? settings_.phase_smoothing : 1.0;
    full_phase_ms_ += weight * (full_ms - full_phase_ms_);
    drag_scale_.note(full_phase_ms_, settings_.phase_deadline_ms);
}

void ChangePolicy::end_change(std::span<const ViewerId> watchers) {
    last_drag_ = phase_of_drag_ ? clock_.now() : last_drag_;
    gate_.end_change(watchers);
}

bool ChangePolicy::dragging() const {
    return clock_.ms_since(last_drag_) < settings_.drag_pause_ms;
}

}  // namespace raybundle
