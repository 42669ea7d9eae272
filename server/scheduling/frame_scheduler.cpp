// SPDX-License-Identifier: Apache-2.0
#include "scheduling/frame_scheduler.h"

#include <algorithm>
#include <cmath>

namespace raybundle {
namespace {

constexpr double kSmoothing = 0.3;  ///< weight of a new measurement

double quantum(const FrameRequest& request) {
    return request.moving ? FrameScheduler::kMovingQuantumMs : FrameScheduler::kRestingQuantumMs;
}

}  // namespace

/// Of the moving or of the resting: the first after the one served last that has saved enough.
std::optional<ViewerId> FrameScheduler::affordable(std::span<const FrameRequest> requests,
                                                   bool moving) const {
    std::optional<ViewerId> first;
    std::optional<ViewerId> following;
    for (const FrameRequest& request : requests) {
        const Account& account = accounts_.at(request.viewer);
        if (request.moving != moving || account.deficit_ms < account.cost_ms) {
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
    double rounds = kMaxCostMs;
    for (const FrameRequest& request : requests) {
        const Account& account = accounts_.at(request.viewer);
        rounds =
            std::min(rounds, std::ceil((account.cost_ms - account.deficit_ms) / quantum(request)));
    }
    for (const FrameRequest& request : requests) {
        Account& account = accounts_.at(request.viewer);
        account.deficit_ms += std::max(rounds, 1.0) * quantum(request);
    }
}

std::optional<ViewerId> FrameScheduler::next(std::span<const FrameRequest> requests) {
    if (requests.empty()) {
        return std::nullopt;
    }
    for (auto& [viewer, account] : accounts_) {
        const bool wants = std::any_of(requests.begin(), requests.end(),
                                       [&, id = viewer](const auto& r) { return r.viewer == id; });
        account.deficit_ms = wants ? account.deficit_ms : std::min(account.deficit_ms, 0.0);
    }
    for (const FrameRequest& request : requests) {
        accounts_.try_emplace(request.viewer);
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
    const double cost = std::clamp(milliseconds, 0.01, kMaxCostMs);
    Account& account = accounts_[viewer];
    account.deficit_ms -= cost;
    account.cost_ms += kSmoothing * (cost - account.cost_ms);
}

void FrameScheduler::charge_besides(ViewerId viewer, double milliseconds) {
    accounts_[viewer].deficit_ms -= std::clamp(milliseconds, 0.0, kMaxCostMs);
}

double FrameScheduler::cost_ms(ViewerId viewer) const {
    const auto found = accounts_.find(viewer);
    return found == accounts_.end() ? kUnknownCostMs : found->second.cost_ms;
}

}  // namespace raybundle
