// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/animation/animation_service.h"
#include "session/changes/change_coordinator.h"
#include "session/changes/change_traces.h"
#include "session/changes/lighting_service.h"
#include "session/changes/project_follower.h"
#include "session/light/light_service.h"
#include "session/light/solution_sharing.h"
#include "session/measure/error_service.h"
#include "session/measure/measure_service.h"
#include "session/measure/probe_service.h"
#include "session/render_loop_settings.h"
#include "session/report/report_service.h"
#include "session/review/review_service.h"
#include "session/scene_service.h"
#include "session/session_state.h"
#include "session/snapshots/snapshot_queue.h"
#include "session/snapshots/snapshot_service.h"
#include "session/solver_driver.h"
#include "session/status_reporter.h"
#include "session/viewers/arrival_service.h"
#include "session/viewers/frame_dispatcher.h"
#include "session/viewers/presence_service.h"
#include "session/viewers/view_service.h"
#include "session/viewers/viewer_admission.h"

namespace raybundle {

/// All that the render loop does, in the order in which one needs the other: who handles which
/// message is in message_handlers.cpp, and what comes when in render_loop.cpp.
struct SessionServices {
    SessionServices(SessionState& state, const RenderLoopSettings& settings);

    /// A viewer has left.
    void forget(SessionState& state, ViewerId viewer);

    SnapshotQueue snapshot_queue;
    SnapshotService snapshots;
    LightingService lighting;
    ChangeTraces traces;
    AnimationService animations;
    ChangeCoordinator changes;
    ErrorService errors;
    SolverDriver solver;
    FrameDispatcher frames;
    PresenceService presence;
    LightService light;
    ViewService views;
    ViewerAdmission admission;
    ProbeService probes;
    MeasureService measurements;
    ReviewService review;
    ReportService reports;
    SceneService scenes;
    ArrivalService arrivals;
    SolutionSharing sharing;
    StatusReporter status;
    ProjectFollower follower;
};

}  // namespace raybundle
