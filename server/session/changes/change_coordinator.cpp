// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_coordinator.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>
#include <utility>

#include "session/changes/change_expansion.h"
#include "session/changes/special_settings.h"
#include "session/messages/addition_messages.h"
#include "session/messages/scene_messages.h"

namespace raybundle {

namespace {

// Who sets the day again so soon after having heard of it holds its slider.
constexpr double day_pause_ms = 2000.0;

/// What is removed, or comes back, is a move to nowhere or from there.
bool is_move(const v1::SceneChanged& change) {
    return change.has_move_object() || change.has_add_object();
}

/// Number of the object that moves.
std::uint32_t moved_object(const v1::SceneChanged& change) {
    return change.has_move_object() ? change.move_object().object() : change.add_object().object();
}

/// Whether a change can be worked in together with those that come before it.
bool fits(const PendingChange& next, const std::vector<PendingChange>& pending,
          const Scene& scene) {
    const bool moving = is_move(pending.front().change);
    if (next.stands_for_several() || next.change.has_set_daylight() ||
        pending.back().change.has_set_daylight() || is_move(next.change) != moving ||
        grows(scene, next.change) || grows(scene, pending.back().change)) {
        return false;
    }
    const auto same = [&next](const PendingChange& p) {
        return moved_object(p.change) == moved_object(next.change);
    };
    return !moving ||
           (pending.size() < MOST_MOVED && std::none_of(pending.begin(), pending.end(), same));
}

/// A move whose drag goes on, or by an animation that plays on.
bool is_dragged(const PendingChange& pending) {
    const v1::MoveObject& last = pending.requests.empty()
                                     ? pending.change.move_object()
                                     : pending.requests.back().message.move_object();
    return last.has_final() && !last.final();
}

}  // namespace

HandlerResult ChangeCoordinator::request(ViewerSession& /*session*/, const ClientEvent& event) {
    if (recorder_.answer_made(event)) {
        return HandlerResult::answered;
    }
    std::shared_ptr<Trace> trace = parts_.traces.begin(event);
    const TraceScope scope(trace.get());
    const v1::SceneChanged change = change_of(event);
    if (change.change_case() != v1::SceneChanged::CHANGE_NOT_SET) {
        v1::Error problem = problem_of(parts_.scene.scene(), change);
        if (problem.code() == v1::Error::CODE_UNSPECIFIED) {
            problem = problem_of_presence(parts_.scene.scene(), change);
        }
        if (problem.code() != v1::Error::CODE_UNSPECIFIED) {
            if (trace) {
                trace->fail(problem.message());
            }
            parts_.server.reply_error(event, problem.code(), problem.message());
            return HandlerResult::answered;
        }
    }
    parts_.animations.note_request(event, change);
    if (change.has_set_daylight()) {
        day_held_ =
            day_by_ == event.viewer && parts_.policy.clock().ms_since(day_told_) < day_pause_ms;
    }
    queue_.add(event, std::move(trace));
    return HandlerResult::answered;
}

PendingChange ChangeCoordinator::take() {
    PendingChange next = queue_.take();
    end_stage(next, "queue");
    return next;
}

void ChangeCoordinator::start_pending() {
    if (parts_.scene.solver().correcting() ||
        !parts_.policy.may_begin(parts_.demand.nobody_waits())) {
        return;
    }
    if (!queue_.has_steps()) {
        const std::vector<v1::SceneChanged> steps = parts_.animations.step();
        queue_.add_steps(steps, steps.empty() ? nullptr : parts_.animations.take_trace());
    }
    if (fades_are_next()) {
        step_fades();
        return;
    }
    if (queue_.empty()) {
        return;
    }
    PendingChange first = take();
    recorder_.renumber(first);
    if (!recorder_.fits_scene(first)) {
        recorder_.refuse_unfit(first);
        return;
    }
    if (first.stands_for_several()) {
        start_several(std::move(first));
        return;
    }
    const TraceScope scope = scope_of(first);
    const TimePoint begun = parts_.policy.clock().now();
    std::vector<PendingChange> pending;
    pending.push_back(std::move(first));
    // One that another server has made comes behind what that one has recorded of its lights.
    if (pending.front().change.has_set_daylight() && !pending.front().recorded) {
        undim_sky(pending);
    }
    while (!queue_.empty() && fits(queue_.front(), pending, parts_.scene.scene()) &&
           recorder_.fits_scene(queue_.front())) {
        pending.push_back(take());
    }
    if (start(std::move(pending))) {
        parts_.policy.note_beginning(parts_.policy.clock().ms_since(begun));
        end_change();
    }
}

/// False: nothing could be saved, so nothing has changed.
bool ChangeCoordinator::start(std::vector<PendingChange> pending) {
    const v1::SceneChanged& first = pending.front().change;
    fade_waits_ = true;  // changes of objects do not take fades along
    const bool made = grows(parts_.scene.scene(), first) ? start_growth(pending)
                      : is_move(first)                   ? start_moves(pending)
                                                         : start_surfaces(pending);
    if (made) {
        for (const PendingChange& change : pending) {
            announce(change);
        }
    }
    return made;
}

/// Keeps of `pending` what could be saved.
bool ChangeCoordinator::start_moves(std::vector<PendingChange>& pending) {
    queue_.put_back(recorder_.record(pending));
    std::vector<ObjectMove> moves;
    for (const PendingChange& p : pending) {
        const std::uint32_t object = moved_object(p.change) - 1;
        moves.push_back({object, parts_.scene.scene().objects[object].world_from_object()});
    }
    if (moves.empty()) {
        return false;
    }
    gather_all();
    const bool dragged = std::any_of(pending.begin(), pending.end(), is_dragged);
    begin_phase(parts_.scene.solver(), dragged);
    if (dragged) {
        shrink_for_drag();
    }
    parts_.scene.solver().move_objects(moves, parts_.receivers.list());
    return true;
}

/// Puts the changes that a request stands for where their turn is next, or answers it once they
/// have been made.
void ChangeCoordinator::start_several(PendingChange pending) {
    if (!pending.expanded && recorder_.drop_made(pending)) {
        return;
    }
    if (pending.expanded) {
        if (pending.requests.front().message.has_undo()) {
            parts_.animations.note_undo(pending.requests.front().message.undo().epoch());
        }
        for (const ClientEvent& request : pending.requests) {
            recorder_.some_failed() ? recorder_.refuse_unsaved(request)
                                    : recorder_.answer_all_made(request);
        }
        return;
    }
    recorder_.begin_several();
    const Expansion expansion = expand(pending, parts_.scene.scene(), parts_.scene.mesh(),
                                       parts_.scene.log(), parts_.lighting);
    if (expansion.problem.code() == v1::Error::CODE_UNSPECIFIED) {
        if (expansion.is_answer) {
            PendingChange named{expansion.changes.front(), pending.requests, false};
            named.traces = pending.traces;
            queue_.put_first(std::move(named));
        } else {
            queue_.add_expanded(expansion.changes, pending, expansion.made, expansion.fresh);
        }
        return;
    }
    fail(pending.traces, expansion.problem.message());
    for (const ClientEvent& request : pending.requests) {
        parts_.server.reply_error(request, expansion.problem.code(), expansion.problem.message());
    }
}

/// All pictures take part in a special phase, those of viewers who look away, too; but not of those
/// who draw by themselves now.
void ChangeCoordinator::gather_all() {
    parts_.snapshots.restart();
    parts_.pictures.note_change();
    parts_.receivers.clear();
    const TimePoint now = parts_.policy.clock().now();
    for (const auto& [id, session] : parts_.viewers) {
        if (session->has_image() && session->draws_itself(now)) {
            session->note_outdated();
        } else if (session->has_image()) {
            parts_.receivers.add(session->image());
        }
    }
}

void ChangeCoordinator::begin_phase(Solver& solver, bool dragged) {
    double target = 0.0;
    for (const auto& [id, session] : parts_.viewers) {
        if (session->target_error() > 0.0) {
            target =
                target > 0.0 ? std::min(target, session->target_error()) : session->target_error();
        }
    }
    solver.set_special(special_settings(parts_.policy.phase_budget(), target, !queue_.empty()));
    parts_.policy.begin_phase(dragged);
    parts_.metrics.count_phase();
}

/// While an object is dragged, the day goes on or an animation plays, phases gather light in fewer
/// pixels if they take too long.
void ChangeCoordinator::shrink_for_drag() {
    const TimePoint now = parts_.policy.clock().now();
    for (const auto& [id, session] : parts_.viewers) {
        if (session->has_image()) {
            session->note_drag(parts_.policy.drag_scale(), now);
        }
    }
}

void ChangeCoordinator::announce(const PendingChange& pending) {
    end_stage(pending, "apply");
    parts_.traces.begin_phase(pending);
    if (pending.change.has_set_daylight()) {
        day_by_ = pending.change.by();
        day_told_ = parts_.policy.clock().now();
    }
    v1::ServerMessage message;
    *message.mutable_scene_changed() = announced(parts_.scene.scene(), pending.change);
    for (const ClientEvent& request : pending.requests) {
        parts_.server.reply(request, message);
    }
    // What stands for several changes is answered apart: its requester hears of each, too.
    parts_.server.broadcast(message, pending.requests.empty() ? 0 : pending.change.by());
    note_shown();
}

/// Light is on its way: what is known of pictures and their errors begins anew.
void ChangeCoordinator::note_shown() {
    parts_.scene.note_change();
    for (const auto& [id, session] : parts_.viewers) {
        session->note_change();
    }
}

void ChangeCoordinator::note_bundle(double cost_ms) {
    double full = 0.0;
    double drawn = 0.0;
    for (const auto& [id, session] : parts_.viewers) {
        full += session->has_image() ? session->pixels() : 0.0;
        drawn += session->has_image() ? session->drawn_pixels() : 0.0;
    }
    parts_.policy.note_bundle(cost_ms, !parts_.scene.solver().correcting(), full, drawn);
    end_change();
}

/// Once a change has been worked in, every viewer waits for a frame that shows it.
void ChangeCoordinator::end_change() {
    if (parts_.scene.solver().correcting()) {
        return;
    }
    const TimePoint now = parts_.policy.clock().now();
    std::vector<ViewerId> watchers;
    std::vector<ViewerId> followed;
    for (const auto& [id, session] : parts_.viewers) {
        watchers.push_back(id);
        if (session->acknowledged() && !session->paused() && !session->draws_itself(now)) {
            followed.push_back(id);
        }
        if (parts_.policy.phase_of_drag()) {
            session->stay_in_motion(now);
        }
    }
    parts_.policy.end_change(watchers);
    parts_.traces.end_phase(followed, parts_.scene.epoch());
}

}  // namespace raybundle
