// SPDX-License-Identifier: Apache-2.0
#include "session/snapshots/snapshot_quota.h"

#include <algorithm>
#include <map>

namespace raybundle {
namespace {

bool only_looks(const WaitingSnapshot& snapshot) {
    return snapshot.role <= v1::VIEWER;
}

std::string limit_text(const char* whose, std::size_t limit) {
    return std::string("snapshot: ") + whose + " may have " + std::to_string(limit) +
           " waiting at a time";
}

}  // namespace

std::optional<std::string> refuse_snapshot(std::span<const WaitingSnapshot> waiting,
                                           const WaitingSnapshot& next) {
    const auto own = static_cast<std::size_t>(
        std::count_if(waiting.begin(), waiting.end(),
                      [&](const WaitingSnapshot& other) { return other.viewer == next.viewer; }));
    const std::size_t limit =
        only_looks(next) ? max_snapshots_per_viewer : max_snapshots_per_editor;
    if (own >= limit) {
        return limit_text(only_looks(next) ? "a viewer of role VIEWER" : "a viewer", limit);
    }
    const auto of_lookers =
        static_cast<std::size_t>(std::count_if(waiting.begin(), waiting.end(), only_looks));
    if (only_looks(next) && of_lookers >= max_snapshots_of_viewers) {
        return limit_text("all viewers of role VIEWER", max_snapshots_of_viewers);
    }
    if (waiting.size() >= max_snapshots) {
        return limit_text("all viewers", max_snapshots);
    }
    return std::nullopt;
}

std::size_t place_of_snapshot(std::span<const WaitingSnapshot> waiting,
                              const WaitingSnapshot& next) {
    std::map<ViewerId, std::size_t> before;
    for (const WaitingSnapshot& other : waiting) {
        ++before[other.viewer];
    }
    const std::size_t rank = before[next.viewer];
    before.clear();
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        if (before[waiting[i].viewer]++ > rank && i > 0) {
            return i;
        }
    }
    return waiting.size();
}

}  // namespace raybundle
