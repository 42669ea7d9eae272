// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "net/server.h"
#include "scheduling/frame_policy.h"
#include "session/light/solution_sharing.h"
#include "session/live_scene.h"
#include "session/loop_metrics.h"
#include "session/viewers/viewer_pictures.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Tells viewers how far the solution is, and operators how the loop does.
class StatusReporter {
  public:
    struct Parts {
        const LiveScene& scene;
        const Viewers& viewers;
        const ViewerPictures& pictures;
        const FramePolicy& policy;
        const SolutionSharing& sharing;
        Server& server;
        LoopMetrics& metrics;
    };
    explicit StatusReporter(const Parts& parts) : parts_(parts) {}

    /// From now on iterations are counted.
    void begin();
    /// Once a second: counts iterations and publishes metrics. Throws GpuError where the context
    /// has been lost.
    void update_metrics();
    /// It is time for another send_solutions().
    [[nodiscard]] bool due();
    /// Tells each viewer how far its picture and the solution are.
    void send_solutions();

  private:
    void publish(TimePoint now);

    Parts parts_;
    TimePoint last_solution_, rate_since_;
    std::uint64_t rate_iterations_ = 0;
    double iterations_per_second_ = 0.0;
};

}  // namespace raybundle
