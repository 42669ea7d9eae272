// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "scheduling/change_policy.h"
#include "scheduling/clock.h"
#include "scheduling/cost_model.h"
#include "scheduling/frame_scheduler.h"
#include "scheduling/moving_scale.h"
#include "scheduling/receiver_scheduler.h"
#include "scheduling/request_share.h"
#include "scheduling/scheduling_settings.h"
#include "scheduling/time_budget.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// What FramePolicy has to know of a viewer.
struct ViewerLoad {
    ViewerId viewer = 0;
    bool has_picture = false;    ///< of its own, which it does not draw by itself now
    bool moving = false;         ///< its picture changes
    bool paused = false;         ///< nobody seems to look
    double pixels = 0.0;         ///< of its full picture
    double drawn_pixels = 0.0;   ///< of its picture as it is
    double full_frame_ms = 0.0;  ///< of a frame in motion with a full picture; 0: not known
};

/// Says who gets the next slice of the render thread's time: requests, frames, iterations, changes.
/// Asks a controller for each, and tells it what the work has cost. docs/scheduling.md has it in
/// sentences. For one thread; knows neither GL nor the network.
class FramePolicy {
  public:
    FramePolicy(const SchedulingSettings& settings, const Clock& clock);

    [[nodiscard]] const SchedulingSettings& settings() const { return settings_; }
    [[nodiscard]] const Clock& clock() const { return clock_; }
    /// Of changes of the scene.
    [[nodiscard]] ChangePolicy& changes() { return changes_; }
    [[nodiscard]] const ChangePolicy& changes() const { return changes_; }

    /// Forgets a viewer that has left.
    void forget(ViewerId viewer);

    /// Viewers whose requests have had their share of the time, and wait.
    [[nodiscard]] std::set<ViewerId> exhausted_requests();
    /// Notes the cost of a request. viewers: how many there are.
    void note_request(ViewerId viewer, double cost_ms, std::size_t viewers);

    /// Looks at what frames in motion take now, and chooses the size of their pictures.
    /// drawn_moving: a frame in motion is about to be drawn.
    void begin_frames(std::span<const ViewerLoad> loads, bool drawn_moving);
    /// Time for frames until the next step of the solver.
    [[nodiscard]] double frame_slice_ms(bool moving) const;
    /// Whose frame comes next; nothing where nobody wants one.
    [[nodiscard]] std::optional<ViewerId> next_frame(std::span<const FrameRequest> requests) {
        return frames_.next(requests);
    }
    /// Notes the cost of a frame of so many pixels.
    void note_frame(ViewerId viewer, double cost_ms, double drawn_pixels);
    /// Share of width and height that the next frame's picture has while it moves.
    [[nodiscard]] double moving_scale() const;
    /// Whether there is time for a first frame while others move. answers: the viewer has answered
    /// a ping.
    [[nodiscard]] bool may_greet(bool answers);
    void note_greeting(bool answers, double cost_ms);

    /// What a frame for everybody who moves takes, ms; 0: nobody moves.
    [[nodiscard]] double moving_frames_ms(std::span<const ViewerLoad> loads) const;
    /// True while frames in motion are sent and leave too little time for steps of the solver. A
    /// viewer that takes no frames for a while does not hold up the solver.
    [[nodiscard]] bool walking(std::span<const ViewerLoad> loads) const;
    /// Whether the solver may make a step: it has the time that frames in motion leave, and a fifth
    /// at least.
    [[nodiscard]] bool solver_may_run(std::span<const ViewerLoad> loads, bool in_special_phase);
    /// Notes the cost of a step of the solver.
    void note_step(double cost_ms, std::span<const ViewerLoad> loads);
    /// Notes that the step was an iteration in which so many pixels gathered light.
    void note_iteration(double cost_ms, double receiver_pixels);
    /// Chooses the viewers whose pictures gather light in the next iterations: as many as there is
    /// time for, of those that look, or of all if nobody does.
    [[nodiscard]] std::vector<ViewerId> choose_receivers(std::span<const ViewerLoad> loads);

    /// Whether there is time to look at the error of a picture.
    [[nodiscard]] bool may_measure_error() { return statistics_.may(clock_.now_ms()); }
    void note_error_measured(double cost_ms) { statistics_.charge(cost_ms); }

    /// Whether there is time for a picture of this size beside present_pixels.
    [[nodiscard]] CostModel::Verdict admit(std::uint32_t width, std::uint32_t height,
                                           double present_pixels) const;
    /// True if several people watch and a frame for each takes so long that none sees at once what
    /// the others do.
    [[nodiscard]] bool crowded(std::span<const ViewerLoad> loads) const;

  private:
    SchedulingSettings settings_;
    const Clock& clock_;
    FrameScheduler frames_;
    RequestShare requests_;
    ReceiverScheduler receivers_;
    TimeBudget greeting_, silent_greeting_, statistics_, solving_;
    MovingScale moving_scale_;
    CostModel cost_;
    ChangePolicy changes_;
    double last_step_ms_ = 0.0;
    TimePoint last_walk_frame_;
};

}  // namespace raybundle
