// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "net/server.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "scheduling/change_gate.h"
#include "scheduling/cost_model.h"
#include "scheduling/frame_scheduler.h"
#include "scheduling/moving_scale.h"
#include "scheduling/receiver_scheduler.h"
#include "scheduling/request_share.h"
#include "scheduling/time_budget.h"
#include "session/changes/change_log.h"
#include "session/changes/change_queue.h"
#include "session/loop_metrics.h"
#include "session/phase_budget.h"
#include "session/review/review_board.h"
#include "session/snapshots/snapshot_queue.h"
#include "session/viewers/error_checker.h"
#include "session/viewers/target_store.h"
#include "session/viewers/viewer_session.h"
#include "session/viewers/walk_mapper.h"
#include "stream/frame_encoder.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

struct RenderLoopSettings {
    SolverSettings solver;
    /// Without viewers the solver rests after this many iterations since the last change.
    std::uint64_t idle_iterations = 4096;
    /// A viewer is refused where the others would fall below this; 0: nobody is.
    double min_frames_per_second = 0.0;
    /// All that viewers and moves need is done once before anybody waits for it.
    bool rehearse = false;
    std::string renderer;             ///< what viewers are told that draws
    bool software_rendering = false;  ///< and that it is no GPU
    /// Fault injection of tests: the GPU is lost so many iterations after a change; 0: never.
    std::uint64_t lost_after_change = 0;
    /// Takes listScenes and openScene with the viewer's name, and answers them; empty: there are
    /// no scenes to open.
    std::function<void(const ClientEvent& request, const std::string& name)> scene_requests;
    /// Takes measureEffects and answers it; empty: effects are not measured.
    std::function<void(const ClientEvent& request, const Scene&, const PatchMesh&)> effect_requests;
};

/// The one place that sees both the network's messages and the GPU: owns the solution and the
/// viewers' pictures on the calling thread, answers requests, sends due frames, and gives the rest
/// of the time to iterations.
class RenderLoop {
  public:
    RenderLoop(Scene scene, PatchMesh mesh, const RenderLoopSettings& settings, Server& server,
               ChangeLog& log);

    /// Does once all that viewers and moves need, where the settings say so and nothing has been
    /// iterated yet: it takes long. Ends early when `stop` is set. Throws GpuError as run() does.
    void rehearse(const std::atomic<bool>& stop);

    /// Runs until `stop` is set and the inbox is interrupted. Throws GpuError where the GPU has
    /// lost its memory, or has not enough of it for the solution.
    void run(const std::atomic<bool>& stop);

    /// Answers what still waits when the loop has ended.
    void refuse_waiting();

    /// Prometheus text; any thread.
    [[nodiscard]] std::string metrics() const;

  private:
    using Clock = std::chrono::steady_clock;

    void rehearse_at(const glm::uvec2& size, const std::atomic<bool>& stop);
    void process_inbox(bool idle);
    void handle(const ClientEvent& event);
    void handle_message(ViewerSession& session, const ClientEvent& event);
    void join(const ClientEvent& event);
    void queue_change(const ClientEvent& event);
    void start_pending_change();
    bool record(PendingChange& pending);
    void start_undo(const PendingChange& pending);
    bool start_surfaces(std::vector<PendingChange> pending);
    bool start_moves(std::vector<PendingChange> pending);
    void end_change();
    void replan(std::span<const std::uint32_t> reflecting);
    void announce(const PendingChange& pending);
    void gather_all();
    void begin_phase(Solver& solver);
    void draw_for_drag();
    void note_phase_end();
    bool set_hidden(ViewerSession& session, const ClientEvent& event);
    void answer_walk_map(const ClientEvent& event, const std::optional<WalkMap>& map,
                         std::uint32_t epoch) const;
    void answer_probe(ViewerSession& session, const ClientEvent& event);
    void cancel_snapshot(const ClientEvent& event);
    void add_snapshot(const ViewerSession& session, const ClientEvent& event);
    [[nodiscard]] std::unique_ptr<EarlierScene> earlier_scene(std::uint32_t epoch) const;
    void request_scenes(const ViewerSession& session, const ClientEvent& event);
    void request_effects(const ClientEvent& event);
    static void fill_limits(v1::Limits* limits);
    void set_viewport(ViewerSession& session, const ClientEvent& event);
    [[nodiscard]] CostModel::Verdict admission(glm::uvec2 size, const ViewerSession* instead) const;
    [[nodiscard]] bool crowded() const;
    [[nodiscard]] std::optional<glm::uvec2> within_memory(glm::uvec2 size,
                                                          const ViewerSession* instead) const;
    [[nodiscard]] glm::uvec2 served_size(glm::uvec2 wanted, const ViewerSession* instead) const;
    bool set_target(ViewerSession& session, const ClientEvent& event);
    bool handle_review(ViewerSession& session, const ClientEvent& event);
    void announce(const ClientEvent& event, const v1::ServerMessage& message);
    void follow(ViewerSession& session, const ClientEvent& event);
    void lead(const ViewerSession& leader);
    void forget_leader(ViewerId viewer);
    void add_pin(ViewerSession& session, const ClientEvent& event);
    void remove_pin(const ClientEvent& event);
    void save_viewpoint(const ClientEvent& event);
    void remove_viewpoint(const ClientEvent& event);
    void point_at(const ClientEvent& event);
    void probe_grid(ViewerSession& session, const ClientEvent& event);
    void send_presence(Clock::time_point now);
    void check_pin();
    [[nodiscard]] bool refine_pin(Pin& pin);
    [[nodiscard]] std::string no_room_for(glm::uvec2 size, const ViewerSession* instead) const;
    void prepare_image(ViewerSession& session);
    void drop_image(ViewerSession& session);
    void refuse_picture(ViewerSession& session, const GpuError& error);
    bool collect_frames();
    struct Wanted {
        ViewerId viewer = 0;
        FrameAdvice advice;
    };
    struct DueFrames;
    [[nodiscard]] DueFrames due_frames(Clock::time_point now);
    bool send_frames();
    void send_frame(const Wanted& wanted);
    bool greet(const DueFrames& due, bool anybody_moves);
    bool greet_within(TimeBudget& budget, std::span<const Wanted> newcomers);
    void send_first_frames(std::span<const Wanted> newcomers, double slice_ms);
    void refresh_statistics(Clock::time_point now);
    void check_pictures(Clock::time_point now);
    [[nodiscard]] double moving_frames_ms(Clock::time_point now) const;
    void choose_moving_scale(Clock::time_point now);
    [[nodiscard]] bool dragging(Clock::time_point now) const;
    [[nodiscard]] bool walking(Clock::time_point now) const;
    [[nodiscard]] bool solver_may_run();
    bool smooth_pictures();
    void send_solutions();
    bool solve();
    [[nodiscard]] bool nobody_waits() const;
    [[nodiscard]] v1::FrameHeader figures() const;
    void choose_receivers();
    void update_rate(Clock::time_point now);
    void publish_figures(Clock::time_point now);

    Scene scene_;
    PatchMesh mesh_;
    RenderLoopSettings settings_;
    Server& server_;
    ChangeLog& log_;
    std::unique_ptr<Solver> solver_;
    std::unique_ptr<ViewPrograms> programs_;
    std::map<ViewerId, std::unique_ptr<ViewerSession>> sessions_;
    std::unique_ptr<ViewerImage> first_look_;  // shows first frames to all who come
    ViewerId first_look_of_ = 0;               // whom it shows last, 0: nobody it still fits
    std::vector<BundleReceiver*> receivers_;
    ChangeQueue changes_;
    ChangeGate gate_;
    bool undo_failed_ = false;  // a change of the running undo could not be saved
    std::uint64_t replans_ = 0;
    std::uint32_t epoch_ = 0;
    std::uint64_t iterations_at_change_ = 0;
    double receiver_pixels_ = 0.0;
    double last_step_ms_ = 0.0;
    FrameScheduler scheduler_;
    RequestShare requests_;
    ReceiverScheduler receiver_scheduler_;
    TimeBudget greeting_, silent_greeting_, statistics_, solving_;
    Clock::time_point last_walk_frame_;  // of somebody who moves
    MovingScale moving_scale_;           // of a walk's pictures
    MovingScale drag_scale_;             // of all pictures while an object is dragged
    double dragged_phase_ms_ = 0.0;      // mean, if all pictures were full; 0: not known
    bool phase_of_drag_ = false;         // the running one is
    Clock::time_point last_drag_;
    CostModel cost_;
    PhaseBudget phase_budget_;
    LoopMetrics metrics_;
    FrameEncoder encoder_;
    ReviewBoard review_;
    TargetStore targets_;
    SnapshotQueue snapshots_;
    ErrorChecker checks_;
    bool presence_changed_ = false;
    Clock::time_point last_presence_;
    Clock::time_point last_solution_, rate_since_;
    std::uint64_t rate_iterations_ = 0;
    double iterations_per_second_ = 0.0;
    // Last, since its thread uses the others.
    WalkMapper walk_maps_{scene_,
                          [this](const ClientEvent& event, const std::optional<WalkMap>& map,
                                 std::uint32_t epoch) { answer_walk_map(event, map, epoch); }};
};

}  // namespace raybundle
