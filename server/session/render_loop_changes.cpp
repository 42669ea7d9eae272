// SPDX-License-Identifier: Apache-2.0
// What the render loop does with changes of the scene: in which order they are made, how they are
// recorded, who hears of them.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>

#include "bundle/low_discrepancy.h"
#include "scene/material/specular_surface.h"
#include "scheduling/elapsed.h"
#include "session/render_loop.h"
#include "session/scene_messages.h"
#include "session/unix_time.h"

namespace raybundle {

namespace {

constexpr const char* not_saved = "the change could not be saved, so it was not made";

/// Whether a change can be worked in together with those that come before it.
bool fits(const PendingChange& next, const std::vector<PendingChange>& pending) {
    const bool moving = pending.front().change.has_move_object();
    if (next.is_undo() || next.change.has_move_object() != moving) {
        return false;
    }
    const auto same = [&next](const PendingChange& p) {
        return subject_of(p.change) == subject_of(next.change);
    };
    return !moving ||
           (pending.size() < MOST_MOVED && std::none_of(pending.begin(), pending.end(), same));
}

}  // namespace

void RenderLoop::queue_change(const ClientEvent& event) {
    const v1::SceneChanged change = change_of(event);
    if (change.change_case() != v1::SceneChanged::CHANGE_NOT_SET) {
        const v1::Error problem = problem_of(scene_, change);
        if (problem.code() != v1::Error::CODE_UNSPECIFIED) {
            server_.reply_error(event, problem.code(), problem.message());
            return;
        }
    }
    changes_.add(event);
}

/// Makes the change that waits longest, together with those right behind it that one special phase
/// can work in: lights and materials, or some moved objects. Frames and iterations come first that
/// the change before it has held up.
void RenderLoop::start_pending_change() {
    if (changes_.empty() || solver_->correcting() || !gate_.open(nobody_waits())) {
        return;
    }
    const auto start = Clock::now();
    PendingChange first = changes_.take();
    if (first.is_undo()) {
        start_undo(first);
        return;
    }
    const bool moving = first.change.has_move_object();
    std::vector<PendingChange> pending;
    pending.push_back(std::move(first));
    while (!changes_.empty() && fits(changes_.front(), pending)) {
        pending.push_back(changes_.take());
    }
    const bool made = moving ? start_moves(std::move(pending)) : start_surfaces(std::move(pending));
    if (made) {
        gate_.begin_change(milliseconds_since(start));
        end_change();
    }
}

/// Whoever looks waits for a frame of the change, once it has been worked in.
void RenderLoop::end_change() {
    if (solver_->correcting()) {
        return;
    }
    const auto now = Clock::now();
    last_drag_ = phase_of_drag_ ? now : last_drag_;
    std::vector<ViewerId> watchers;
    for (const auto& [id, session] : sessions_) {
        watchers.push_back(id);
        if (phase_of_drag_) {
            session->stay_in_motion(now);
        }
    }
    gate_.end_change(watchers);
}

/// Numbers, saves and applies a change to the scene. False: it could not be saved and is answered.
bool RenderLoop::record(PendingChange& pending) {
    const v1::SceneChanged before = state_of(scene_, pending.change);
    if (!pending.requests.empty()) {
        pending.change.set_by(pending.requests.back().viewer);
    }
    const auto viewer = sessions_.find(pending.change.by());
    pending.change.set_by_name(viewer == sessions_.end() ? "" : viewer->second->name());
    pending.change.set_at_ms(unix_ms());
    if (!log_.record(pending.change, before)) {
        undo_failed_ = true;
        for (const ClientEvent& request : pending.requests) {
            server_.reply_error(request, v1::Error::INTERNAL, not_saved);
        }
        return false;
    }
    epoch_ = log_.epoch();
    apply(scene_, pending.change);
    v1::SceneChanged after = state_of(scene_, pending.change);
    after.set_epoch(epoch_);
    log_.note_states(before, after);
    set_before(before, pending.change);
    log_.records().tell_beginning(pending.change);
    return true;
}

/// A change concerns also those who look away.
void RenderLoop::gather_all() {
    snapshots_.restart();
    first_look_of_ = 0;
    receivers_.clear();
    for (const auto& [id, session] : sessions_) {
        if (session->has_image()) {
            receivers_.push_back(&session->image());
        }
    }
}

/// Before a change is made: how much time its special phase has.
void RenderLoop::begin_phase(Solver& solver) {
    double target = 0.0;
    for (const auto& [id, session] : sessions_) {
        if (session->target_error() > 0.0) {
            target =
                target > 0.0 ? std::min(target, session->target_error()) : session->target_error();
        }
    }
    solver.set_special(phase_budget_.settings(target, !changes_.empty()));
    phase_budget_.begin(Server::now_ms());
    phase_of_drag_ = false;
    metrics_.count_phase();
}

/// An object is being dragged: its phases gather light in fewer pixels where they take too long.
void RenderLoop::draw_for_drag() {
    phase_of_drag_ = true;
    last_drag_ = Clock::now();
    for (const auto& [id, session] : sessions_) {
        if (session->has_image()) {
            session->note_drag(drag_scale_.scale(), last_drag_);
        }
    }
}

/// After each bundle of a special phase. What a whole phase of a drag takes decides about the
/// pictures of the next.
void RenderLoop::note_phase_end() {
    if (solver_->correcting() || !phase_of_drag_) {
        return;
    }
    double full = 0.0;
    double drawn = 0.0;
    for (const auto& [id, session] : sessions_) {
        full += session->has_image() ? session->pixels() : 0.0;
        drawn += session->has_image() ? session->drawn_pixels() : 0.0;
    }
    const double full_ms = phase_budget_.elapsed_ms(Server::now_ms()) * full / std::max(drawn, 1.0);
    constexpr double newest = 0.3;
    dragged_phase_ms_ += (dragged_phase_ms_ > 0.0 ? newest : 1.0) * (full_ms - dragged_phase_ms_);
    drag_scale_.note(dragged_phase_ms_, PhaseBudget::deadline_ms);
}

void RenderLoop::announce(const PendingChange& pending) {
    iterations_at_change_ = solver_->iterations();
    v1::ServerMessage message;
    *message.mutable_scene_changed() = pending.change;
    for (const ClientEvent& request : pending.requests) {
        server_.reply(request, message);
    }
    // Of an undo also the one who asked for it hears.
    server_.broadcast(message, pending.requests.empty() ? 0 : pending.change.by());
    for (const auto& [id, session] : sessions_) {
        session->note_change();
    }
}

/// False: nothing could be saved, so nothing has changed.
bool RenderLoop::start_moves(std::vector<PendingChange> pending) {
    std::erase_if(pending, [this](PendingChange& p) { return !record(p); });
    std::vector<ObjectMove> moves;
    for (const PendingChange& p : pending) {
        const std::uint32_t object = p.change.move_object().object() - 1;
        moves.push_back({object, scene_.objects[object].world_from_object()});
    }
    if (moves.empty()) {
        return false;
    }
    gather_all();
    begin_phase(*solver_);
    const auto waits_for_more = [](const PendingChange& p) {
        const v1::MoveObject& last = p.requests.back().message.move_object();
        return last.has_final() && !last.final();
    };
    if (std::any_of(pending.begin(), pending.end(), [&](const PendingChange& p) {
            return !p.requests.empty() && waits_for_more(p);
        })) {
        draw_for_drag();
    }
    solver_->move_objects(moves, receivers_);
    for (const PendingChange& p : pending) {
        announce(p);
    }
    return true;
}

/// False: nothing could be saved, so nothing has changed.
bool RenderLoop::start_surfaces(std::vector<PendingChange> pending) {
    const auto material_of = [this](const PendingChange& p) {
        const std::uint32_t id = subject_of(p.change).second;
        return p.change.has_set_light() ? material_of_light(scene_, id) : id - 1;
    };
    std::map<std::uint32_t, SpecularKind> before;
    for (const PendingChange& p : pending) {
        if (material_of(p) != no_material) {
            before.emplace(material_of(p), specular_kind(scene_.materials[material_of(p)]));
        }
    }
    std::erase_if(pending, [this](PendingChange& p) { return !record(p); });
    std::vector<std::uint32_t> materials;
    std::vector<std::uint32_t> reflecting;
    bool covered = true;
    for (const PendingChange& p : pending) {
        const std::uint32_t material = material_of(p);
        if (material == no_material) {
            continue;
        }
        materials.push_back(material);
        // A polished lamp that is put out is a mirror.
        if (!p.change.has_set_light() ||
            specular_kind(scene_.materials[material]) != before.at(material)) {
            reflecting.push_back(material);
            covered = covered && solver_->covers(scene_, material);
        }
    }
    if (pending.empty()) {
        return false;
    }
    if (covered) {
        gather_all();
        begin_phase(*solver_);
        solver_->change_surfaces(scene_, mesh_, materials, reflecting, receivers_);
    } else {
        refresh_surfaces(scene_, materials, mesh_);
        replan(reflecting);
    }
    for (const PendingChange& p : pending) {
        announce(p);
    }
    return true;
}

/// A material calls for shaders that the scene did not need so far (design: re-planned): another
/// solver takes over the solution.
void RenderLoop::replan(std::span<const std::uint32_t> reflecting) {
    SolverSettings settings = settings_.solver;
    settings.seed = mix_bits(settings.seed + ++replans_);
    auto next = std::make_unique<Solver>(scene_, mesh_, settings);
    auto programs = std::make_unique<ViewPrograms>(next->scene());
    first_look_.reset();
    for (const auto& [id, session] : sessions_) {
        if (session->has_image()) {
            session->give_image(std::make_unique<ViewerImage>(next->scene(), next->store(),
                                                              *programs, session->size()),
                                false);
            session->apply_view();
        }
    }
    gather_all();
    begin_phase(*next);
    next->take_over(*solver_, reflecting, receivers_);
    solver_ = std::move(next);
    programs_ = std::move(programs);
    spdlog::info("shaders have been planned anew for a changed material");
}

void RenderLoop::start_undo(const PendingChange& pending) {
    const ClientEvent& request = pending.requests.front();
    const std::uint32_t epoch = request.message.undo().epoch();
    if (pending.undone) {
        if (undo_failed_) {
            server_.reply_error(request, v1::Error::INTERNAL, not_saved);
        } else {
            server_.reply_ok(request);
        }
        return;
    }
    undo_failed_ = false;
    if (const auto changes = log_.history().back_to(epoch); changes && changes->empty()) {
        server_.reply_ok(request);
    } else if (changes) {
        changes_.add_undone(*changes, pending);
    } else if (epoch > epoch_) {
        server_.reply_error(
            request, v1::Error::INVALID_ARGUMENT,
            "undo.epoch: there have been only " + std::to_string(epoch_) + " changes");
    } else {
        server_.reply_error(request, v1::Error::NOT_FOUND,
                            "undo.epoch: what was before change " +
                                std::to_string(log_.history().oldest()) + " is not known any more");
    }
}

}  // namespace raybundle
