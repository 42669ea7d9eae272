// SPDX-License-Identifier: Apache-2.0
// What the render loop does for its viewers: who gets in, whose pixels gather, whose frame is next.
#include <algorithm>
#include <map>

#include "render_loop.h"

namespace raybundle {

namespace {

constexpr double frame_slice_ms = 60.0;      // of frames between two steps of the solver
constexpr double moving_share = 2.0;         // of a step, for frames while somebody moves
constexpr double silence_limit_ms = 3000.0;  // without acknowledgement a viewer counts as away

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

}  // namespace

/// Why a picture of this size cannot be served, with what would fit; empty where it can. `instead`
/// is the viewer whose picture it would replace, or null.
std::string RenderLoop::no_room_for(glm::uvec2 size, const ViewerSession* instead) const {
    double present = 0.0;
    for (const auto& [id, session] : sessions_) {
        present += session->paused() || session.get() == instead ? 0.0 : session->pixels();
    }
    const double limit_ms = 1000.0 / settings_.min_frames_per_second;
    const CostModel::Verdict verdict = cost_.admit(size.x, size.y, present, limit_ms);
    if (verdict.fits) {
        return {};
    }
    const auto& fit = verdict.would_fit;
    return "the server has no time for a picture of " + std::to_string(size.x) + "x" +
           std::to_string(size.y) +
           (fit ? ", " + std::to_string(fit->first) + "x" + std::to_string(fit->second) +
                      " would fit"
                : ", nothing would fit now");
}

/// Who takes part in the next group of iterations: those who look, or all where nobody does. They
/// must stay the same within a group and within a special phase.
void RenderLoop::choose_receivers() {
    if (solver_->correcting() || !solver_->between_groups()) {
        return;
    }
    const bool watched = std::any_of(sessions_.begin(), sessions_.end(),
                                     [](const auto& entry) { return !entry.second->paused(); });
    receivers_.clear();
    receiver_pixels_ = 0.0;
    for (const auto& [id, session] : sessions_) {
        if (!watched || !session->paused()) {
            receivers_.push_back(&session->image());
            receiver_pixels_ += session->pixels();
        }
    }
    const bool alone = !watched || nobody_waits();
    ViewerImage* const snapshot =
        snapshots_.next_receiver(solver_->scene(), solver_->store(), *programs_, epoch_, alone);
    if (snapshot != nullptr) {
        receivers_.push_back(snapshot);
        receiver_pixels_ += static_cast<double>(snapshot->size().x) * snapshot->size().y;
    }
}

/// False where it has been refused and answered.
bool RenderLoop::set_viewport(ViewerSession& session, const ClientEvent& event) {
    const v1::SetViewport& wanted = event.message.set_viewport();
    const glm::uvec2 size(wanted.width(), wanted.height());
    const bool larger =
        static_cast<double>(size.x) * static_cast<double>(size.y) > session.pixels();
    if (const std::string reason = larger ? no_room_for(size, &session) : ""; !reason.empty()) {
        server_.reply_error(event, v1::Error::RESOURCE_EXHAUSTED, reason);
        return false;
    }
    session.set_viewport(size);
    return true;
}

void RenderLoop::request_scenes(const ViewerSession& session, const ClientEvent& event) {
    if (settings_.scene_requests) {
        settings_.scene_requests(event, session.name());
    } else {
        server_.reply_error(event, v1::Error::NOT_FOUND, "this server has no folder of scenes");
    }
}

/// Hands finished frames to the encoder. True if there were any.
bool RenderLoop::collect_frames() {
    bool any = false;
    for (const auto& [id, session] : sessions_) {
        if (session->frame_finished()) {
            auto [header, pixels] = session->take_frame();
            encoder_.submit({id, header, {pixels.begin(), pixels.end()}, false});
            any = true;
        }
    }
    return any;
}

/// Renders due frames, shared out by measured time, for one slice at most. True if there were any.
bool RenderLoop::send_frames() {
    const auto now = Clock::now();
    std::vector<FrameRequest> requests;
    std::map<ViewerId, FrameAdvice> advices;
    for (const auto& [id, session] : sessions_) {
        session->set_paused(server_.silence_ms(id) > silence_limit_ms);
        // While a change is being worked in, the picture is between two states: finish first.
        if (solver_->correcting() || !session->due(now) || encoder_.busy(id)) {
            continue;
        }
        const FrameAdvice advice = server_.advise(id, session->demand(now));
        if (advice.send) {
            requests.push_back({id, session->moving(now)});
            advices[id] = advice;
        }
    }
    const bool any = !requests.empty();
    const bool moving = std::any_of(requests.begin(), requests.end(),
                                    [](const FrameRequest& request) { return request.moving; });
    // A step takes long where many pictures gather light: those who move shall not wait for it.
    const double slice_ms =
        moving ? std::max(frame_slice_ms, moving_share * last_step_ms_) : frame_slice_ms;
    while (!requests.empty() && milliseconds_since(now) < slice_ms) {
        const ViewerId viewer = *scheduler_.next(requests);
        ViewerSession& session = *sessions_.at(viewer);
        const auto start = Clock::now();
        session.render(advices.at(viewer), figures(), start);
        const double cost = milliseconds_since(start);
        scheduler_.charge(viewer, cost);
        cost_.note_frame(cost, session.pixels());
        std::erase_if(requests, [&](const FrameRequest& r) { return r.viewer == viewer; });
    }
    return any;
}

/// One slice of antialiasing for one viewer, so that a camera message waits for no more. True if
/// there was something to do.
bool RenderLoop::smooth_pictures() {
    if (solver_->correcting()) {
        return false;
    }
    const auto now = Clock::now();
    return std::any_of(sessions_.begin(), sessions_.end(), [now](const auto& entry) {
        return !entry.second->paused() && entry.second->smooth(now);
    });
}

void RenderLoop::publish_figures(Clock::time_point now) {
    LoopFigures f;
    f.iterations = solver_->iterations();
    f.iterations_per_second = iterations_per_second_;
    f.settled = solver_->statistics().settled;
    f.epoch = epoch_;
    f.non_finite = solver_->non_finite();
    f.gl_bytes = solver_->bytes();
    for (const auto& [id, session] : sessions_) {
        ++f.viewers;
        f.moving += session->moving(now) ? 1 : 0;
        f.paused += session->paused() ? 1 : 0;
        f.gl_bytes += session->image().bytes();
        const ImageStatistics& statistics = session->image().statistics();
        if (statistics.known) {
            f.relative_error = std::max(f.relative_error.value_or(0.0), statistics.relative_error);
        }
    }
    f.journal_failures = log_.failures();
    f.journal_working = log_.working();
    metrics_.publish(f, now);
}

}  // namespace raybundle
