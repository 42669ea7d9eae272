// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>

#include "scheduling/scheduling_settings.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// A viewer that wants a frame now.
struct FrameRequest {
    ViewerId viewer = 0;
    bool moving = false;  ///< its picture changes: served first, and with a larger share
};

/// Shares rendering time among viewers by deficit round robin (Shreedhar and Varghese, Efficient
/// Fair Queuing Using Deficit Round-Robin, 1995), in measured milliseconds instead of bytes: a
/// viewer with a large picture gets fewer frames, not more time. Has no clock of its own.
class FrameScheduler {
  public:
    explicit FrameScheduler(const FrameShareSettings& settings = {}) : settings_(settings) {}

    /// The viewer whose frame comes next; nothing if nobody wants one. A viewer without a request
    /// loses what it has saved.
    std::optional<ViewerId> next(std::span<const FrameRequest> requests);

    /// Notes the cost of a frame of this viewer.
    void charge(ViewerId viewer, double milliseconds);

    /// Notes the cost of other work for this viewer.
    void charge_besides(ViewerId viewer, double milliseconds);

    /// Smoothed cost of this viewer's frames.
    [[nodiscard]] double cost_ms(ViewerId viewer) const;

    void forget(ViewerId viewer) { accounts_.erase(viewer); }

  private:
    struct Account {
        double deficit_ms = 0.0;
        double cost_ms = 0.0;
    };

    std::optional<ViewerId> affordable(std::span<const FrameRequest> requests, bool moving) const;
    void begin_rounds(std::span<const FrameRequest> requests);

    [[nodiscard]] double quantum(const FrameRequest& request) const;
    Account& account(ViewerId viewer);

    FrameShareSettings settings_;
    std::map<ViewerId, Account> accounts_;
    ViewerId last_ = 0;  ///< served last: the next one in order follows it
};

}  // namespace raybundle
