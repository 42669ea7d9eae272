// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "net/server.h"
#include "scheduling/clock.h"
#include "scheduling/frame_policy.h"
#include "session/changes/change_log.h"
#include "session/live_scene.h"
#include "session/loop_metrics.h"
#include "session/receiver_list.h"
#include "session/render_loop_settings.h"
#include "session/solver_demand.h"
#include "session/viewers/viewer_pictures.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// What more than one service works on. Lives as long as the render loop. Each service gets
/// references to what it needs, never to all of it.
struct SessionState {
    SessionState(Scene scene, PatchMesh mesh, const RenderLoopSettings& settings, Server& to,
                 ChangeLog& log, const Clock& clock)
        : server(to),
          policy(settings.scheduling, clock),
          live(std::move(scene), std::move(mesh), settings.solver, log),
          viewers(policy),
          pictures({live, viewers, receivers, server}),
          demand(live, viewers, settings.scheduling.idle_iterations) {}

    Server& server;
    LoopMetrics metrics;
    FramePolicy policy;
    LiveScene live;
    Viewers viewers;
    ReceiverList receivers;
    ViewerPictures pictures;
    SolverDemand demand;
};

}  // namespace raybundle
