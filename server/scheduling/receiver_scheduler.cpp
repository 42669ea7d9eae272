// SPDX-License-Identifier: Apache-2.0
#include "scheduling/receiver_scheduler.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace raybundle {

/// Turns to those who had the fewest, in random order among equals, while they fit. Who has just
/// come, or begun to rest, is at most one turn behind the others.
void ReceiverScheduler::deal(std::vector<ReceiverRequest> members, double budget_ms,
                             double& spent_ms, std::vector<ViewerId>& chosen) {
    std::uint64_t most = 0;
    for (const ReceiverRequest& member : members) {
        most = std::max(most, turns_[member.viewer]);
    }
    for (const ReceiverRequest& member : members) {
        std::uint64_t& turns = turns_[member.viewer];
        turns = std::max(turns + 1, most) - 1;
    }
    // Fisher and Yates's shuffle; std::shuffle differs among standard libraries.
    for (std::size_t i = members.size(); i > 1; --i) {
        std::swap(members[i - 1], members[random_() % i]);
    }
    std::stable_sort(members.begin(), members.end(),
                     [this](const ReceiverRequest& a, const ReceiverRequest& b) {
                         return turns_.at(a.viewer) < turns_.at(b.viewer);
                     });
    for (const ReceiverRequest& member : members) {
        if (!chosen.empty() && spent_ms + member.cost_ms > budget_ms) {
            break;
        }
        chosen.push_back(member.viewer);
        spent_ms += member.cost_ms;
        ++turns_[member.viewer];
    }
}

std::vector<ViewerId> ReceiverScheduler::next(std::span<const ReceiverRequest> members,
                                              double budget_ms) {
    std::erase_if(turns_, [&](const auto& entry) {
        return std::none_of(members.begin(), members.end(),
                            [&](const ReceiverRequest& m) { return m.viewer == entry.first; });
    });
    std::vector<ViewerId> chosen;
    double spent_ms = 0.0;
    for (const bool moving : {false, true}) {
        std::vector<ReceiverRequest> kind;
        std::copy_if(members.begin(), members.end(), std::back_inserter(kind),
                     [moving](const ReceiverRequest& m) { return m.moving == moving; });
        deal(std::move(kind), budget_ms, spent_ms, chosen);
    }
    return chosen;
}

}  // namespace raybundle
