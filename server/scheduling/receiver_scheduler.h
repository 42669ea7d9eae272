// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <vector>

#include "stream/viewer_id.h"

namespace raybundle {

/// A viewer whose picture could gather light.
struct ReceiverRequest {
    ViewerId viewer = 0;
    bool moving = false;   ///< its picture changes: it lives on the object-space solution meanwhile
    double cost_ms = 0.0;  ///< that its pixels add to an iteration
};

/// Deals out which pictures gather light in the next group of iterations where all together would
/// take too long: those at rest in turn, each in as many groups as any other, and moving ones with
/// what time is left. Each round goes through them in another random order: bundles come from
/// low-discrepancy sequences, of which every n-th group alone would be a biased part.
class ReceiverScheduler {
  public:
    explicit ReceiverScheduler(std::uint64_t seed = 1) : random_(seed) {}

    /// Who gathers: as many as fit into `budget_ms`, but one at least where there are any.
    std::vector<ViewerId> next(std::span<const ReceiverRequest> members, double budget_ms);

  private:
    void deal(std::vector<ReceiverRequest> members, double budget_ms, double& spent_ms,
              std::vector<ViewerId>& chosen);

    std::mt19937_64 random_;
    std::map<ViewerId, std::uint64_t> turns_;  ///< of those present
};

}  // namespace raybundle
