// SPDX-License-Identifier: Apache-2.0
#include "session/solver_demand.h"

#include <algorithm>

namespace raybundle {

bool SolverDemand::nobody_waits() const {
    const auto paused = [](const auto& entry) { return entry.second->paused(); };
    const auto content = [](const auto& entry) {
        const auto& session = entry.second;
        return session->paused() || (session->has_target() && session->target_met());
    };
    if (std::all_of(viewers_.begin(), viewers_.end(), paused)) {
        return scene_.iterations_since_change() >= idle_iterations_;
    }
    return std::all_of(viewers_.begin(), viewers_.end(), content);
}

}  // namespace raybundle
