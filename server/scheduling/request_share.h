// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <set>

#include "scheduling/time_budget.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// Bounds the time that requests take from frames and iterations, whatever one costs: those of one
/// viewer a quarter, those of all together half. Whoever has had its share waits, and what it
/// wants with it, in the inbox, which is bounded. Has no clock of its own.
class RequestShare {
  public:
    static constexpr double kShare = 0.25;      ///< of the time, for one or two viewers
    static constexpr double kBurstMs = 250.0;   ///< may be saved up, likewise
    static constexpr double kFullShares = 2.0;  ///< more viewers than so have smaller shares

    /// A request of this viewer, one of so many, has taken so long.
    void charge(ViewerId viewer, double cost_ms, std::size_t viewers) {
        const double crowd = static_cast<double>(viewers) / kFullShares;
        budgets_.try_emplace(viewer, kShare, kBurstMs)
            .first->second.charge(cost_ms * (crowd > 1.0 ? crowd : 1.0));
    }

    /// Those who have had their share.
    [[nodiscard]] std::set<ViewerId> exhausted(double now_ms) {
        std::set<ViewerId> result;
        for (auto& [viewer, budget] : budgets_) {
            if (!budget.may(now_ms)) {
                result.insert(viewer);
            }
        }
        return result;
    }

    void forget(ViewerId viewer) { budgets_.erase(viewer); }

  private:
    std::map<ViewerId, TimeBudget> budgets_;
};

}  // namespace raybundle
