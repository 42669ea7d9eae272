// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_recorder.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>
#include <utility>

#include "scene/edit/luminaire_edit.h"
#include "session/changes/change_traces.h"
#include "session/messages/addition_messages.h"
#include "session/messages/daylight_messages.h"
#include "session/messages/light_messages.h"
#include "session/messages/scene_messages.h"
#include "session/unix_time.h"

namespace raybundle {

namespace {

constexpr const char* not_saved = "the change could not be saved, so it was not made";

/// What there is to know of an addition, or of what is there again.
template <typename Addition>
void complete(const Scene& scene, Addition& addition) {
    const bool removed = addition.removed();
    addition = state_of_addition(scene, addition);
    addition.set_removed(removed);
}

}  // namespace

std::vector<PendingChange> ChangeRecorder::record(std::vector<PendingChange>& pending) {
    std::vector<PendingChange> kept;
    std::vector<PendingChange> later;
    for (PendingChange& change : pending) {
        switch (record_one(change)) {
            case Recorded::yes:
                kept.push_back(std::move(change));
                break;
            case Recorded::later:
                later.push_back(std::move(change));
                later.back().again = true;
                break;
            case Recorded::no:
                break;
        }
    }
    pending = std::move(kept);
    return later;
}

/// Numbers, saves and applies a change to the scene. `no`: it could not be saved and is answered.
Recorded ChangeRecorder::record_one(PendingChange& pending) {
    Scene& scene = parts_.scene.scene();
    ChangeLog& log = parts_.scene.log();
    const TraceScope scope = scope_of(pending);
    if (drop_made(pending) || part_is_over(pending)) {
        return Recorded::no;
    }
    if (pending.fresh) {
        pending.change.mutable_add_luminaire()->set_light(next_luminaire(scene));
    }
    if (pending.recorded) {
        pending.change.set_by(0);  // numbers of viewers are each server's own
        parts_.animations.note_foreign(pending.change);
    } else if (pending.change.has_set_light()) {
        *pending.change.mutable_set_light() = resolved(scene, pending.change.set_light());
    } else if (pending.change.has_add_object()) {
        complete(scene, *pending.change.mutable_add_object());
    } else if (pending.change.has_add_luminaire()) {
        complete(scene, *pending.change.mutable_add_luminaire());
    } else if (pending.change.has_set_daylight()) {
        *pending.change.mutable_set_daylight() = resolved(scene, pending.change.set_daylight());
    }
    const v1::SceneChanged before = state_of(scene, pending.change);
    const Recorded recorded = number(pending, before);
    if (recorded != Recorded::yes) {
        return recorded;
    }
    if (pending.change.has_animation()) {
        parts_.animations.note_recorded(pending.change, log.epoch());
    }
    apply(scene, pending.change);
    v1::SceneChanged after = state_of(scene, pending.change);
    after.set_epoch(log.epoch());
    log.note_states(before, after, pending.change.animation().first_epoch());
    set_before(before, pending.change);
    log.records().tell_beginning(pending.change);
    if (pending.change.has_set_daylight()) {
        describe_sky_lights(scene, pending.change.mutable_set_daylight());
    }
    log.note_answer(keys_of(pending), pending.change);
    note_recorded(pending);
    return Recorded::yes;
}

bool ChangeRecorder::fits_scene(const PendingChange& pending) const {
    return problem_now(pending).code() == v1::Error::CODE_UNSPECIFIED;
}

/// Of changes that nobody has checked against the scene as it is now that their turn has come.
v1::Error ChangeRecorder::problem_now(const PendingChange& pending) const {
    v1::Error problem;
    if (pending.recorded && pending.stands_for_several()) {
        problem.set_code(v1::Error::INTERNAL);
        problem.set_message("it cannot be read");
    } else if (pending.recorded || pending.again) {
        problem = problem_of(parts_.scene.scene(), pending.change);
    }
    const bool addition =
        (pending.change.has_add_object() && !pending.change.add_object().removed()) ||
        (pending.change.has_add_luminaire() && !pending.change.add_luminaire().removed());
    if (problem.code() == v1::Error::CODE_UNSPECIFIED && !pending.recorded &&
        !pending.requests.empty() && !pending.stands_for_several() && !addition) {
        problem = problem_of_presence(parts_.scene.scene(), pending.change);
    }
    return problem;
}

void ChangeRecorder::refuse_unfit(const PendingChange& pending) {
    const v1::Error problem = problem_now(pending);
    refuse(pending, problem.code(), problem.message());
}

void ChangeRecorder::refuse(const PendingChange& pending, v1::Error::Code code,
                            const std::string& reason) {
    const TraceScope scope = scope_of(pending);
    fail(pending.traces, reason);
    if (pending.recorded) {  // it keeps its number
        spdlog::error("change {} of another server does not fit the scene: {}",
                      pending.change.epoch(), reason);
        parts_.scene.log().note_lost();
        if (!parts_.scene.log().accept(pending.change, {}, pending.keys)) {
            spdlog::error("change {} of another server is not the next one",
                          pending.change.epoch());
        }
    } else if (pending.requests.empty()) {
        some_failed_ = true;
    }
    for (const ClientEvent& request : pending.requests) {
        parts_.server.reply_error(request, code, reason);
    }
}

void ChangeRecorder::renumber(PendingChange& pending) const {
    if (pending.recorded || pending.requests.empty() || pending.stands_for_several()) {
        return;
    }
    const Scene& scene = parts_.scene.scene();
    const v1::ClientMessage& asked = pending.requests.front().message;
    if (asked.has_add_object() && asked.add_object().object() == 0) {
        pending.change.mutable_add_object()->set_object(
            static_cast<std::uint32_t>(scene.objects.size()) + 1);
    } else if (asked.has_add_luminaire() && asked.add_luminaire().light() == 0) {
        pending.change.mutable_add_luminaire()->set_light(next_luminaire(scene));
    }
}

/// For those who look on.
void ChangeRecorder::note_recorded(const PendingChange& pending) const {
    const std::uint32_t epoch = parts_.scene.log().epoch();
    for (const std::shared_ptr<Trace>& trace : pending.traces) {
        trace->set("raybundle.epoch", std::int64_t{epoch});
        trace->end_stage("record");
    }
    // Of an animation the first of its changes says enough.
    const bool goes_on =
        pending.change.has_animation() && pending.change.animation().first_epoch() != epoch;
    AuditLog* const audit = parts_.server.audit();
    if (audit != nullptr && !pending.recorded && !goes_on) {
        audit->change(pending.change, epoch);
    }
    if (!pending.requests.empty()) {
        spdlog::debug("change {} is viewer {}'s", epoch, pending.change.by());
    }
}

/// Gives a change its epoch, in the log.
Recorded ChangeRecorder::number(PendingChange& pending, const v1::SceneChanged& before) {
    ChangeLog& log = parts_.scene.log();
    if (pending.recorded) {
        return log.accept(pending.change, before, pending.keys) ? Recorded::yes : Recorded::no;
    }
    sign(pending);
    const bool played = pending.change.has_animation();
    if (played) {
        parts_.animations.number(pending.change, log.epoch() + 1);
    }
    const Recorded recorded =
        log.record(pending.change, before, keys_of(pending), traceparent_of(pending));
    if (recorded == Recorded::no) {
        some_failed_ = true;
        fail(pending.traces, not_saved);
        if (played) {
            parts_.animations.note_failure();
        }
        for (const ClientEvent& request : pending.requests) {
            refuse_unsaved(request);
        }
    }
    return recorded;
}

void ChangeRecorder::refuse_unsaved(const ClientEvent& request) const {
    const v1::Error error = parts_.scene.log().refusal(not_saved);
    parts_.server.reply_error(request, error.code(), error.message());
}

bool ChangeRecorder::answer_made(const ClientEvent& request) const {
    const MadeRequest* const made = request.message.has_request_key()
                                        ? parts_.scene.log().made(request.message.request_key())
                                        : nullptr;
    if (made == nullptr || !made->key.complete()) {
        return false;
    }
    if (made->key.parts > 0) {
        parts_.server.reply_ok(request);
        return true;
    }
    const Scene& scene = parts_.scene.scene();
    v1::ServerMessage message;
    v1::SceneChanged& change = *message.mutable_scene_changed() = announced(scene, made->change);
    if (change.has_set_daylight() && change.set_daylight().lights().empty()) {
        describe_sky_lights(scene, change.mutable_set_daylight());  // the log has it without
    }
    parts_.server.reply(request, message);
    return true;
}

void ChangeRecorder::answer_all_made(const ClientEvent& request) const {
    if (request.message.has_request_key()) {  // of none no change in the log knows the key
        parts_.scene.log().note_answer({{request.message.request_key(), 1, 1}}, {});
    }
    parts_.server.reply_ok(request);
}

/// A part of what a request stands for is not made where an earlier one has failed, so that what
/// has been made is known by the last part; nor where another server has made it meanwhile.
bool ChangeRecorder::part_is_over(const PendingChange& pending) const {
    if (!pending.part || some_failed_) {
        return pending.part;
    }
    return pending.fresh &&
           std::any_of(pending.keys.begin(), pending.keys.end(), [this](const RequestKey& key) {
               const MadeRequest* const made = parts_.scene.log().made(key.text);
               return made != nullptr && made->key.parts == key.parts && made->key.part >= key.part;
           });
}

bool ChangeRecorder::drop_made(PendingChange& pending) const {
    if (pending.requests.empty()) {
        return false;
    }
    std::erase_if(pending.requests,
                  [this](const ClientEvent& request) { return answer_made(request); });
    return pending.requests.empty();
}

/// Notes in a change who makes it, and when.
void ChangeRecorder::sign(PendingChange& pending) const {
    if (!pending.requests.empty()) {
        pending.change.set_by(pending.requests.back().viewer);
    }
    const ViewerSession* const viewer = parts_.viewers.find(pending.change.by());
    if (viewer != nullptr || !pending.change.has_animation()) {  // plays on after who began it
        pending.change.set_by_name(viewer == nullptr ? "" : viewer->name());
    }
    pending.change.set_at_ms(unix_ms());
}

}  // namespace raybundle
