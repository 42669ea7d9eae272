// SPDX-License-Identifier: Apache-2.0
#include "session/animation/animation_service.h"

namespace raybundle {

AnimationService::AnimationService(const Parts& parts, const Clock& clock)
    : parts_(parts), player_(parts.scene.scene(), clock) {
    player_.restore(parts.scene.log().animation_steps());
}

v1::ServerMessage AnimationService::message_of(std::size_t animation, std::uint32_t by) const {
    v1::ServerMessage message;
    v1::AnimationChanged& changed = *message.mutable_animation_changed();
    *changed.mutable_state() = player_.state_of(animation);
    changed.set_by(by);
    const ViewerSession* const viewer = parts_.viewers.find(by);
    changed.set_by_name(viewer == nullptr ? "" : viewer->name());
    return message;
}

/// All viewers, of all but the first so many.
void AnimationService::tell(const std::vector<std::size_t>& animations, std::uint32_t by,
                            std::size_t but_not_first) {
    for (std::size_t i = but_not_first; i < animations.size(); ++i) {
        parts_.server.broadcast(message_of(animations[i], by), 0);
    }
}

/// Keeps the key of a request, and answers it where that is not new or cannot be kept. False: it is
/// to be carried out.
bool AnimationService::answer_kept(const ClientEvent& event) {
    if (!event.message.has_request_key()) {
        return false;
    }
    ChangeLog& log = parts_.scene.log();
    const std::size_t animation = player_.index_of(event.message.play_animation());
    if (log.kept(event.message.request_key()) != nullptr) {
        parts_.server.reply(event, message_of(animation, event.viewer));
        return true;
    }
    const std::string body = event.message.play_animation().SerializeAsString();
    if (log.keep_note(NoteKind::played, static_cast<std::uint32_t>(animation) + 1, body,
                      event.message.request_key())) {
        return false;
    }
    const v1::Error refusal = log.refusal("the animation's request could not be saved");
    parts_.server.reply_error(event, refusal.code(), refusal.message());
    return true;
}

HandlerResult AnimationService::play(ViewerSession& session, const ClientEvent& event) {
    const v1::PlayAnimation& request = event.message.play_animation();
    std::shared_ptr<Trace> trace = parts_.traces.begin(event);
    const TraceScope scope(trace.get());
    const v1::Error problem = player_.problem_of(request);
    if (problem.code() != v1::Error::CODE_UNSPECIFIED) {
        if (trace) {
            trace->fail(problem.message());
        }
        parts_.server.reply_error(event, problem.code(), problem.message());
        return HandlerResult::answered;
    }
    if (answer_kept(event)) {
        return HandlerResult::answered;
    }
    trace_ = std::move(trace);
    const std::vector<std::size_t> changed = player_.play(request, event.viewer, session.name());
    const v1::ServerMessage message = message_of(changed.front(), event.viewer);
    parts_.server.reply(event, message);
    parts_.server.broadcast(message, event.viewer);
    tell(changed, event.viewer, 1);
    return HandlerResult::answered;
}

std::vector<v1::SceneChanged> AnimationService::step() {
    std::vector<v1::SceneChanged> changes = player_.step(!parts_.viewers.empty());
    tell(player_.take_ended(), 0);
    if (changes.empty() && !player_.playing()) {
        trace_.reset();  // it has changed nothing
    }
    return changes;
}

void AnimationService::note_request(const ClientEvent& event, const v1::SceneChanged& change) {
    tell(event.message.has_undo() ? player_.stop_all() : player_.make_way(change), event.viewer);
}

void AnimationService::note_foreign(const v1::SceneChanged& change) {
    if (!change.has_animation()) {
        tell(player_.make_way(change), 0);
    }
}

void AnimationService::note_undo(std::uint32_t epoch) {
    player_.note_undo(epoch);
}

void AnimationService::note_failure() {
    tell(player_.stop_all(), 0);
}

}  // namespace raybundle
