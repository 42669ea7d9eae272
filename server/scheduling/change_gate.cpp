// SPDX-License-Identifier: Apache-2.0
#include "scheduling/change_gate.h"

#include <algorithm>

namespace raybundle {

void ChangeGate::owe(double cost_ms) {
    owed_ms_ += std::max(cost_ms, 0.0) * iteration_share_ / (1.0 - iteration_share_);
}

void ChangeGate::begin_change(double cost_ms) {
    waiting_.clear();
    owed_ms_ = 0.0;
    iterations_due_ = true;
    owe(cost_ms);
}

void ChangeGate::end_change(std::span<const ViewerId> watchers) {
    waiting_ = {watchers.begin(), watchers.end()};
}

/// Further frames of a viewer owe nothing: those of a walk would outrun iterations for ever.
void ChangeGate::note_frame(ViewerId viewer, double cost_ms) {
    if (waiting_.erase(viewer) > 0) {
        owe(cost_ms);
    }
}

void ChangeGate::note_iteration(double cost_ms) {
    owed_ms_ -= std::max(cost_ms, 0.0);
    iterations_due_ = iterations_due_ && owed_ms_ > 0.0;
}

}  // namespace raybundle
