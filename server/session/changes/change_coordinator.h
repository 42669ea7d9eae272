// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "net/server.h"
#include "scheduling/change_policy.h"
#include "session/animation/animation_service.h"
#include "session/changes/change_queue.h"
#include "session/changes/change_recorder.h"
#include "session/changes/change_traces.h"
#include "session/changes/lighting_scenes.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/loop_metrics.h"
#include "session/receiver_list.h"
#include "session/snapshots/snapshot_queue.h"
#include "session/solver_demand.h"
#include "session/viewers/viewer_pictures.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Makes the changes that viewers ask for: decides their order, records each, has the solver work
/// it in and announces it.
class ChangeCoordinator {
  public:
    struct Parts {
        LiveScene& scene;
        const Viewers& viewers;
        ViewerPictures& pictures;
        ReceiverList& receivers;
        SnapshotQueue& snapshots;
        const LightingScenes& lighting;
        AnimationService& animations;
        const SolverDemand& demand;
        ChangePolicy& policy;
        ChangeTraces& traces;
        Server& server;
        LoopMetrics& metrics;
    };
    explicit ChangeCoordinator(const Parts& parts)
        : parts_(parts), recorder_({parts.scene, parts.viewers, parts.animations, parts.server}) {}

    /// Handles moveObject, setLight, setMaterial, and what stands for several of them (undo,
    /// setGroup, applyLightingScene): each waits for its turn, and is answered when it has been
    /// made.
    HandlerResult request(ViewerSession& session, const ClientEvent& event);

    /// A change that another server of the project has made and recorded: its turn is next.
    void follow(LogEntry entry) {
        std::shared_ptr<Trace> trace = parts_.traces.begin(entry);
        queue_.add_recorded(std::move(entry), std::move(trace));
    }

    /// Makes the change that waits longest, a step of what plays among them, with those right
    /// behind it that one special phase can work in: lights and materials, or some moved objects.
    /// Lamps that fade go along with changes of lights and materials, and have turns of their own.
    /// Does nothing while the policy wants frames and iterations first.
    void start_pending();

    /// A bundle of a special phase has been transferred and has taken so long.
    void note_bundle(double cost_ms);

    /// Requests that wait; there are none then.
    [[nodiscard]] std::vector<ClientEvent> take_requests() { return queue_.take_requests(); }

  private:
    bool start(std::vector<PendingChange> pending);
    bool start_moves(std::vector<PendingChange>& pending);
    bool start_growth(std::vector<PendingChange>& changes);
    std::unique_ptr<Solver> plan_anew(std::unique_ptr<ViewPrograms>& programs);
    [[nodiscard]] bool goes_on(const std::vector<PendingChange>& pending) const;
    bool start_surfaces(std::vector<PendingChange>& pending);
    [[nodiscard]] bool fades_are_next() const;
    void step_fades();
    void undim_sky(std::vector<PendingChange>& pending) const;
    void start_several(PendingChange pending);
    void gather_all();
    void begin_phase(Solver& solver, bool dragged);
    void shrink_for_drag();
    void replan(std::span<const std::uint32_t> reflecting);
    void announce(const PendingChange& pending);
    void note_shown();
    PendingChange take();
    void end_change();

    Parts parts_;
    ChangeQueue queue_;
    ChangeRecorder recorder_;
    std::uint64_t replans_ = 0;
    bool fade_waits_ = false;   // something else has had a turn since fades had theirs
    std::uint32_t day_by_ = 0;  // viewer that has set the daylight last
    TimePoint day_told_;        // when all heard of it
    bool day_held_ = false;     // the daylight that waits goes on with that
};

}  // namespace raybundle
