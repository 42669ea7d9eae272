// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <set>

#include "scheduling/scheduling_settings.h"
#include "scheduling/time_budget.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// Bounds the time that requests take from frames and iterations: requests of one viewer take a
/// quarter, those of all together half. Requests of a viewer that has had its share wait in the
/// inbox, which is bounded. Has no clock of its own.
class RequestShare {
  public:
    explicit RequestShare(const RequestSettings& settings = {}) : settings_(settings) {}

    /// Notes the cost of a request of this viewer. viewers: how many there are.
    void charge(ViewerId viewer, double cost_ms, std::size_t viewers) {
        const double crowd = static_cast<double>(viewers) / settings_.full_shares;
        budgets_.try_emplace(viewer, settings_.of_one)
            .first->second.charge(cost_ms * (crowd > 1.0 ? crowd : 1.0));
    }

    /// Viewers that have had their share.
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
    RequestSettings settings_;
    std::map<ViewerId, TimeBudget> budgets_;
};

}  // namespace raybundle
