// SPDX-License-Identifier: Apache-2.0
#include "scheduling/frame_scheduler.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

double FrameScheduler::quantum(const FrameRequest& request) const {
    return request.moving ? settings_.moving_quantum_ms : settings_.resting_quantum_ms;
}

/// A viewer's account, a new one where it has none.
FrameScheduler::Account& FrameScheduler::account(ViewerId viewer) {
    return accounts_.try_emplace(viewer, Account{0.0, settings_.unknown_cost_ms}).first->second;
}

/// Of the moving or of the resting: the first after the one served last that has saved enough.
std::optional<ViewerId> FrameScheduler::affordable(std::span<const FrameRequest> requests,
                                                   bool moving) const {
    std::optional<ViewerId> first;
    std::optional<ViewerId> following;
    for (const FrameRequest& request : requests) {
        const Account& known = accounts_.at(request.viewer);
        if (request.moving != moving || known.deficit_ms < known.cost_ms) {
            continue;
        }
        auto& place = request.viewer > last_ ? following : first;
        if (!place || request.viewer < *place) {
            place = request.viewer;
        }
    }
    return following ? following : first;
}

/// Starts as many rounds at once as the first viewer needs to have saved enough.
void FrameScheduler::begin_rounds(std::span<const FrameRequest> requests) {
    double rounds = settings_.max_cost_ms;
    for (const FrameRequest& request : requests) {
        const Account& known = accounts_.at(request.viewer);
        rounds = std::min(rounds, std::ceil((known.cost_ms - known.deficit_ms) / quantum(request)));
    }
    for (const FrameRequest& request : requests) {
        Account& known = accounts_.at(request.viewer);
        known.deficit_ms += std::max(rounds, 1.0) * quantum(request);
    }
}

std::optional<ViewerId> FrameScheduler::next(std::span<const FrameRequest> requests) {
    if (requests.empty()) {
        return std::nullopt;
    }
    for (auto& [viewer, saved] : accounts_) {
        const bool wants = std::any_of(requests.begin(), requests.end(),
                                       [&, id = viewer](const auto& r) { return r.viewer == id; });
        saved.deficit_ms = wants ? saved.deficit_ms : std::min(saved.deficit_ms, 0.0);
    }
    for (const FrameRequest& request : requests) {
        account(request.viewer);
    }
    for (int attempt = 0; attempt < 2; ++attempt) {
        for (const bool moving : {true, false}) {
            if (const auto viewer = affordable(requests, moving)) {
                last_ = *viewer;
                return viewer;
            }
        }
        begin_rounds(requests);
    }
    return requests.front().viewer;
}

void FrameScheduler::charge(ViewerId viewer, double milliseconds) {
    const double cost = std::clamp(milliseconds, 0.01, settings_.max_cost_ms);
    Account& charged = account(viewer);
    charged.deficit_ms -= cost;
    charged.cost_ms += settings_.smoothing * (cost - charged.cost_ms);
}

void FrameScheduler::charge_besides(ViewerId viewer, double milliseconds) {
    account(viewer).deficit_ms -= std::clamp(milliseconds, 0.0, settings_.max_cost_ms);
}

double FrameScheduler::cost_ms(ViewerId viewer) const {
    const auto found = accounts_.find(viewer);
    return found == accounts_.end() ? settings_.unknown_cost_ms : found->second.cost_ms;
}

}  // namespace raybundle
