// SPDX-License-Identifier: Apache-2.0
#include "scheduling/frame_policy.h"

#include <algorithm>

namespace raybundle {

FramePolicy::FramePolicy(const SchedulingSettings& settings, const Clock& clock)
    : settings_(settings),
      clock_(clock),
      frames_(settings.frames),
      requests_(settings.requests),
      greeting_(settings.greeting.answering),
      silent_greeting_(settings.greeting.silent),
      statistics_(settings.statistics),
      solving_({1.0, settings.round.solver_burst_ms}),
      moving_scale_(settings.moving_scale),
      changes_(settings, clock) {}

void FramePolicy::forget(ViewerId viewer) {
    frames_.forget(viewer);
    requests_.forget(viewer);
    changes_.excuse(viewer);
}

std::set<ViewerId> FramePolicy::exhausted_requests() {
    return requests_.exhausted(clock_.now_ms());
}

/// Requests are paid with frames of their viewer, too.
void FramePolicy::note_request(ViewerId viewer, double cost_ms, std::size_t viewers) {
    frames_.charge_besides(viewer, cost_ms);
    requests_.charge(viewer, cost_ms, viewers);
}

void FramePolicy::begin_frames(std::span<const ViewerLoad> loads, bool drawn_moving) {
    double full_ms = 0.0;
    for (const ViewerLoad& load : loads) {
        full_ms += load.has_picture && load.moving ? load.full_frame_ms : 0.0;
    }
    if (full_ms > 0.0) {
        const RoundSettings& round = settings_.round;
        moving_scale_.note(full_ms, (1.0 - round.min_solver_share) * round.walk_round_ms);
    }
    last_walk_frame_ = drawn_moving ? clock_.now() : last_walk_frame_;
}

/// A step takes long where many pictures gather light: who moves shall not wait for it.
double FramePolicy::frame_slice_ms(bool moving) const {
    const RoundSettings& round = settings_.round;
    return moving ? std::max(round.frame_slice_ms, round.slice_steps * last_step_ms_)
                  : round.frame_slice_ms;
}

void FramePolicy::note_frame(ViewerId viewer, double cost_ms, double drawn_pixels) {
    frames_.charge(viewer, cost_ms);
    changes_.note_frame(viewer, cost_ms);
    cost_.note_frame(cost_ms, drawn_pixels);
}

double FramePolicy::moving_scale() const {
    return changes_.dragging() ? changes_.drag_scale() : moving_scale_.scale();
}

bool FramePolicy::may_greet(bool answers) {
    return (answers ? greeting_ : silent_greeting_).may(clock_.now_ms());
}

void FramePolicy::note_greeting(bool answers, double cost_ms) {
    (answers ? greeting_ : silent_greeting_).charge(cost_ms);
}

double FramePolicy::moving_frames_ms(std::span<const ViewerLoad> loads) const {
    double sum = 0.0;
    for (const ViewerLoad& load : loads) {
        sum += load.has_picture && load.moving ? frames_.cost_ms(load.viewer) : 0.0;
    }
    return sum;
}

bool FramePolicy::walking(std::span<const ViewerLoad> loads) const {
    const RoundSettings& round = settings_.round;
    return clock_.ms_since(last_walk_frame_) < round.walk_pause_ms &&
           moving_frames_ms(loads) + last_step_ms_ > round.walk_round_ms;
}

bool FramePolicy::solver_may_run(std::span<const ViewerLoad> loads, bool in_special_phase) {
    if (!walking(loads) || in_special_phase) {
        return true;
    }
    const RoundSettings& round = settings_.round;
    const double left = 1.0 - moving_frames_ms(loads) / round.walk_round_ms;
    solving_.set_share(std::max(left, round.min_solver_share));
    return solving_.may(clock_.now_ms());
}

void FramePolicy::note_step(double cost_ms, std::span<const ViewerLoad> loads) {
    last_step_ms_ = cost_ms;
    if (walking(loads)) {
        solving_.charge(cost_ms);
    }
}

void FramePolicy::note_iteration(double cost_ms, double receiver_pixels) {
    changes_.note_iteration(cost_ms);
    cost_.note_iteration(cost_ms, receiver_pixels);
}

std::vector<ViewerId> FramePolicy::choose_receivers(std::span<const ViewerLoad> loads) {
    const bool watched =
        std::any_of(loads.begin(), loads.end(), [](const ViewerLoad& l) { return !l.paused; });
    std::vector<ReceiverRequest> requests;
    for (const ViewerLoad& load : loads) {
        if (load.has_picture && (!watched || !load.paused)) {
            requests.push_back({load.viewer, load.moving, cost_.receive_ms(load.drawn_pixels)});
        }
    }
    const ReceiverSettings& settings = settings_.receivers;
    const double moving_ms = moving_frames_ms(loads);
    const double budget_ms =
        moving_ms > 0.0 ? std::max(settings.min_moving_ms, settings.frames_share * moving_ms)
                        : settings.resting_ms;
    return receivers_.next(requests, budget_ms);
}

CostModel::Verdict FramePolicy::admit(std::uint32_t width, std::uint32_t height,
                                      double present_pixels) const {
    if (settings_.min_frames_per_second <= 0.0) {
        return {};
    }
    return cost_.admit(width, height, present_pixels, 1000.0 / settings_.min_frames_per_second);
}

bool FramePolicy::crowded(std::span<const ViewerLoad> loads) const {
    double pixels = 0.0;
    int watching = 0;
    for (const ViewerLoad& load : loads) {
        pixels += load.paused ? 0.0 : load.pixels;
        watching += load.paused ? 0 : 1;
    }
    return watching > 1 && cost_.round_ms(pixels) > settings_.crowded_ms;
}

}  // namespace raybundle
