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

/// Chooses the pictures that gather light in the next group of iterations, if all together would
/// take too long. Pictures at rest take turns, each in as many groups as any other; pictures in
/// motion get the rest of the time. Each round has another random order: bundles come from
/// low-discrepancy sequences, and every n-th group of such a sequence is biased.
class ReceiverScheduler {
  public:
    explicit ReceiverScheduler(std::uint64_t seed = 1) : random_(seed) {}

    /// As many viewers as fit into `budget_ms`; one at least, if there are any.
    std::vector<ViewerId> next(std::span<const ReceiverRequest> members, double budget_ms);

  private:
    void deal(std::vector<ReceiverRequest> members, double budget_ms, double& spent_ms,
              std::vector<ViewerId>& chosen);

    std::mt19937_64 random_;
    std::map<ViewerId, std::uint64_t> turns_;  ///< of those present
};

}  // namespace raybundle
