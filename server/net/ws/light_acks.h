// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>

#include "stream/viewer_id.h"

namespace raybundle {

/// Which messages of light viewers have taken in, on their way from the network thread to the one
/// that sends light: of each viewer the newest alone, so that there are never more than viewers.
class LightAcks {
  public:
    using Numbers = std::map<ViewerId, std::uint32_t>;

    void acknowledge(ViewerId viewer, std::uint32_t number);
    /// A viewer has left.
    void forget(ViewerId viewer);

    /// Takes what has come in of some viewers, the caller's own; waits for it, for interrupt() or
    /// until the time is up. While another scene takes over, two threads send light.
    Numbers take(const std::function<bool(ViewerId)>& own, std::chrono::milliseconds timeout);
    /// Ends all take() that wait, or the next one at once.
    void interrupt();

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    Numbers numbers_;
    bool interrupted_ = false;
};

}  // namespace raybundle
