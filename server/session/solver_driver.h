// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "net/server.h"
#include "scheduling/frame_policy.h"
#include "session/changes/change_coordinator.h"
#include "session/live_scene.h"
#include "session/loop_metrics.h"
#include "session/measure/error_service.h"
#include "session/receiver_list.h"
#include "session/snapshots/snapshot_queue.h"
#include "session/solver_demand.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Has the solver iterate while somebody wants it and the policy gives it time, and chooses the
/// pictures that gather light.
class SolverDriver {
  public:
    struct Parts {
        LiveScene& scene;
        const Viewers& viewers;
        ReceiverList& receivers;
        SnapshotQueue& snapshots;
        ChangeCoordinator& changes;
        ErrorService& errors;
        const SolverDemand& demand;
        FramePolicy& policy;
        Server& server;
        LoopMetrics& metrics;
        /// Fault injection of tests: the GPU is lost so many iterations after a change; 0: never.
        std::uint64_t lost_after_change = 0;
    };
    explicit SolverDriver(const Parts& parts) : parts_(parts) {}

    /// One step of the solver, or of a snapshot of an earlier scene. False: nobody wants one, or
    /// others have the time. Throws GpuError.
    bool step();

  private:
    void choose_receivers();
    void note_step(double cost_ms);
    void fail_as_a_test_wants() const;

    Parts parts_;
};

}  // namespace raybundle
