// SPDX-License-Identifier: Apache-2.0
// What the render loop does for its viewers: who gets in, whose pixels gather, whose frame is next.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>

#include "gpu/egl_context.h"
#include "net/ws/wire_codec.h"
#include "scheduling/elapsed.h"
#include "session/render_loop.h"
#include "session/viewers/picture_refusal.h"

namespace raybundle {

namespace {

constexpr double frame_slice_ms = 60.0;      // of frames between two steps of the solver
constexpr double walkthrough_ms = 40.0;      // drawing and solving; with encoding some 50
constexpr double walk_pause_ms = 250.0;      // without a frame nobody walks
constexpr double drag_pause_ms = 400.0;      // without a step nobody drags
constexpr double min_solver_share = 0.2;     // of the time, where frames take more than that
constexpr double moving_share = 2.0;         // of a step, for frames while somebody moves
constexpr double silence_limit_ms = 3000.0;  // without acknowledgement a viewer counts as away
constexpr double forget_limit_ms = 60e3;     // and after this its picture is forgotten
/// What gathering light adds to an iteration at most: while somebody moves, at least, or half of
/// the time that frames take; and while nobody does, so that who begins to does not wait long.
constexpr double min_receive_ms = 40.0;
constexpr double resting_receive_ms = 100.0;

}  // namespace

/// What has come in by now, but of nobody more than its share where the time is wanted for frames
/// and iterations (`idle`: it is not).
void RenderLoop::process_inbox(bool idle) {
    Inbox& inbox = server_.inbox();
    for (std::size_t left = inbox.size(); left > 0; --left) {
        const auto event =
            inbox.take(idle ? std::set<ViewerId>() : requests_.exhausted(Server::now_ms()));
        if (!event) {
            return;
        }
        handle(*event);
    }
}

/// Who takes part in the next group of iterations: of those who look, or of all where nobody does,
/// as many as an iteration has time for. They must stay the same within a group and within a
/// special phase.
void RenderLoop::choose_receivers() {
    if (solver_->correcting() || !solver_->between_groups()) {
        return;
    }
    const auto now = Clock::now();
    const bool watched = std::any_of(sessions_.begin(), sessions_.end(),
                                     [](const auto& entry) { return !entry.second->paused(); });
    std::vector<ReceiverRequest> members;
    for (const auto& [id, session] : sessions_) {
        if (session->has_image() && (!watched || !session->paused())) {
            members.push_back(
                {id, session->moving(now), cost_.receive_ms(session->drawn_pixels())});
        }
    }
    const double moving_ms = moving_frames_ms(now);
    const double budget_ms =
        moving_ms > 0.0 ? std::max(min_receive_ms, 0.5 * moving_ms) : resting_receive_ms;
    receivers_.clear();
    receiver_pixels_ = 0.0;
    for (const ViewerId viewer : receiver_scheduler_.next(members, budget_ms)) {
        ViewerSession& session = *sessions_.at(viewer);
        receivers_.push_back(&session.image());
        receiver_pixels_ += session.drawn_pixels();
    }
    // Who watches a picture at rest waits for it as whoever has asked for a snapshot does.
    const bool undisturbed = !watched || moving_ms == 0.0 || nobody_waits();
    ViewerImage* const snapshot = snapshots_.next_receiver(solver_->scene(), solver_->store(),
                                                           *programs_, epoch_, undisturbed);
    if (snapshot != nullptr) {
        receivers_.push_back(snapshot);
        receiver_pixels_ += static_cast<double>(snapshot->size().x) * snapshot->size().y;
    }
}

/// What a frame for everybody who moves takes.
double RenderLoop::moving_frames_ms(Clock::time_point now) const {
    double sum = 0.0;
    for (const auto& [id, session] : sessions_) {
        sum += session->has_image() && session->moving(now) ? scheduler_.cost_ms(id) : 0.0;
    }
    return sum;
}

/// Pictures of those who move are as large as their frames have time for.
void RenderLoop::choose_moving_scale(Clock::time_point now) {
    double full_ms = 0.0;
    for (const auto& [id, session] : sessions_) {
        full_ms += session->has_image() && session->moving(now) ? session->full_frame_ms() : 0.0;
    }
    if (full_ms > 0.0) {
        moving_scale_.note(full_ms, (1.0 - min_solver_share) * walkthrough_ms);
    }
}

/// Whether an object has just been dragged.
bool RenderLoop::dragging(Clock::time_point now) const {
    return milliseconds(now - last_drag_) < drag_pause_ms;
}

/// Whether somebody gets frames of a walk, and these and the solver's steps do not fit into its
/// rhythm. Who takes no frames for a while, does not hold up the solver.
bool RenderLoop::walking(Clock::time_point now) const {
    return milliseconds(now - last_walk_frame_) < walk_pause_ms &&
           moving_frames_ms(now) + last_step_ms_ > walkthrough_ms;
}

/// Those who move come first: the solver has what their frames leave, and never nothing.
bool RenderLoop::solver_may_run() {
    const auto now = Clock::now();
    if (!walking(now) || solver_->correcting()) {
        return true;
    }
    solving_.set_share(std::max(1.0 - moving_frames_ms(now) / walkthrough_ms, min_solver_share));
    return solving_.may(Server::now_ms());
}

/// False where it has been refused and answered.
bool RenderLoop::set_target(ViewerSession& session, const ClientEvent& event) {
    const v1::SetTarget& target = event.message.set_target();
    if (!targets_.keep(session.name(), target)) {
        server_.reply_error(event, v1::Error::INTERNAL, "the target could not be saved");
        return false;
    }
    session.set_target(target);
    return true;
}

void RenderLoop::request_scenes(const ViewerSession& session, const ClientEvent& event) {
    if (settings_.scene_requests) {
        settings_.scene_requests(event, session.name());
    } else {
        server_.reply_error(event, v1::Error::NOT_FOUND, "this server has no folder of scenes");
    }
}

void RenderLoop::request_effects(const ClientEvent& event) {
    if (settings_.effect_requests) {
        settings_.effect_requests(event, scene_, mesh_);
    } else {
        server_.reply_error(event, v1::Error::NOT_FOUND, "this server measures no effects");
    }
}

/// Hands finished frames to the encoder. True if there were any.
bool RenderLoop::collect_frames() {
    bool any = false;
    for (const auto& [id, session] : sessions_) {
        if (session->frame_finished()) {
            DepthMap depths = session->take_depths();
            auto [header, pixels] = session->take_frame();
            encoder_.submit({id, header, {pixels.begin(), pixels.end()}, false, std::move(depths)});
            any = true;
        }
    }
    return any;
}

/// The viewer's own picture shows what it wants to see; where it has none, it gets the one that
/// showed its first frame, or a new one.
void RenderLoop::prepare_image(ViewerSession& session) {
    if (!session.has_image()) {
        const bool shown = first_look_ != nullptr && first_look_of_ == session.id();
        session.give_image(shown ? std::move(first_look_)
                                 : std::make_unique<ViewerImage>(solver_->scene(), solver_->store(),
                                                                 *programs_, session.size()),
                           shown);
        first_look_of_ = shown ? 0 : first_look_of_;
    }
    session.apply_view();
}

void RenderLoop::drop_image(ViewerSession& session) {
    if (session.has_image()) {
        std::erase(receivers_, &session.image());
        session.drop_image();
    }
}

/// A picture cannot be made: the viewer is told and sent away.
void RenderLoop::refuse_picture(ViewerSession& session, const GpuError& error) {
    spdlog::error("no picture for viewer {}: {}", session.id(), error.what());
    drop_image(session);
    first_look_.reset();
    const Refusal refusal = refusal_of(error);
    server_.send(session.id(), to_message(refusal));
    server_.close(session.id(), CloseCode::try_again_later, refusal.text);
}

/// Who can take a frame now.
struct RenderLoop::DueFrames {
    std::vector<FrameRequest> requests;
    std::map<ViewerId, FrameAdvice> advices;
    std::vector<Wanted> newcomers;  ///< have never acknowledged a frame, but answered a ping
    std::vector<Wanted> silent;     ///< have never answered anything
    bool moving = false;            ///< one of the requests is of somebody who moves
};

RenderLoop::DueFrames RenderLoop::due_frames(Clock::time_point now) {
    DueFrames due;
    for (const auto& [id, session] : sessions_) {
        const double silence_ms = server_.silence_ms(id);
        session->set_paused(silence_ms > silence_limit_ms);
        if (silence_ms > forget_limit_ms) {
            drop_image(*session);
        }
        if (!session->acknowledged() && server_.acknowledged(id)) {
            session->note_acknowledged();
        }
        // While a change is being worked in, the picture is between two states: finish first.
        if (solver_->correcting()) {
            continue;
        }
        const bool watches = !session->paused() && session->acknowledged();
        if (!watches || encoder_.busy(id) || !session->awaits_frame()) {
            gate_.excuse(id);
        }
        if (!session->due(now) || encoder_.busy(id)) {
            continue;
        }
        const FrameAdvice advice = server_.advise(id, session->demand(now));
        if (!advice.send) {
            gate_.excuse(id);
            continue;
        }
        if (session->has_image() || session->acknowledged()) {
            due.requests.push_back({id, session->moving(now)});
            due.advices[id] = advice;
            due.moving = due.moving || session->moving(now);
        } else {
            (server_.answers(id) ? due.newcomers : due.silent).push_back({id, advice});
        }
    }
    return due;
}

/// Renders due frames, shared out by measured time, for one slice at most. True if there were any.
bool RenderLoop::send_frames() {
    const auto now = Clock::now();
    DueFrames due = due_frames(now);
    const double moving_ms = moving_frames_ms(now);
    choose_moving_scale(now);
    last_walk_frame_ = due.moving ? now : last_walk_frame_;
    // A step takes long where many pictures gather light: those who move shall not wait for it.
    const double slice_ms =
        due.moving ? std::max(frame_slice_ms, moving_share * last_step_ms_) : frame_slice_ms;
    const bool any = !due.requests.empty();
    while (!due.requests.empty() && milliseconds_since(now) < slice_ms) {
        const ViewerId viewer = *scheduler_.next(due.requests);
        send_frame({viewer, due.advices.at(viewer)});
        std::erase_if(due.requests, [&](const FrameRequest& r) { return r.viewer == viewer; });
    }
    return greet(due, moving_ms > 0.0) || any;
}

/// First frames: as many as a slice has time for; while somebody moves, one at a time within a
/// budget. Connections that nobody reads do not delay who answers. True if there were any.
bool RenderLoop::greet(const DueFrames& due, bool anybody_moves) {
    if (anybody_moves) {
        const bool answering = greet_within(greeting_, due.newcomers);
        return greet_within(silent_greeting_, due.silent) || answering;
    }
    const std::vector<Wanted>& first = due.newcomers.empty() ? due.silent : due.newcomers;
    send_first_frames(first, frame_slice_ms);
    return !first.empty();
}

bool RenderLoop::greet_within(TimeBudget& budget, std::span<const Wanted> newcomers) {
    if (newcomers.empty() || !budget.may(Server::now_ms())) {
        return false;
    }
    const auto start = Clock::now();
    send_first_frames(newcomers, 0.0);
    budget.charge(milliseconds_since(start));
    return true;
}

void RenderLoop::send_frame(const Wanted& wanted) {
    ViewerSession& session = *sessions_.at(wanted.viewer);
    const auto start = Clock::now();
    session.set_moving_scale((dragging(start) ? drag_scale_ : moving_scale_).scale(), start);
    try {
        prepare_image(session);
        session.render(wanted.advice, figures(), start);
    } catch (const GpuError& error) {
        refuse_picture(session, error);
    }
    const double cost = milliseconds_since(start);
    scheduler_.charge(wanted.viewer, cost);
    gate_.note_frame(wanted.viewer, cost);
    session.note_frame_cost(cost);
    cost_.note_frame(cost, session.drawn_pixels());
}

/// First frames, all of one picture: a viewer that never acknowledges one costs no more than that.
/// One at least, more until the time is up.
void RenderLoop::send_first_frames(std::span<const Wanted> newcomers, double slice_ms) {
    const auto begin = Clock::now();
    for (const Wanted& wanted : newcomers) {
        ViewerSession& session = *sessions_.at(wanted.viewer);
        const auto start = Clock::now();
        try {
            if (!first_look_) {
                first_look_ = std::make_unique<ViewerImage>(solver_->scene(), solver_->store(),
                                                            *programs_, session.size());
            }
            first_look_of_ = wanted.viewer;
            auto [header, pixels] =
                session.render_first(*first_look_, wanted.advice, figures(), start);
            encoder_.submit({wanted.viewer, header, {pixels.begin(), pixels.end()}, false, {}});
        } catch (const GpuError& error) {
            refuse_picture(session, error);
        }
        if (milliseconds_since(begin) >= slice_ms) {
            return;
        }
    }
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
    f.gl_bytes = solver_->bytes() + (first_look_ ? first_look_->bytes() : 0);
    for (const auto& [id, session] : sessions_) {
        ++f.viewers;
        f.moving += session->moving(now) ? 1 : 0;
        f.paused += session->paused() ? 1 : 0;
        if (!session->has_image()) {
            continue;
        }
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
