// SPDX-License-Identifier: Apache-2.0
#include "session/changes/lighting_service.h"

namespace raybundle {

HandlerResult LightingService::answer(const ClientEvent& event, bool done,
                                      v1::ServerMessage& message) {
    if (!done) {
        parts_.server.reply_error(event, scenes_.refusal().code(), scenes_.refusal().message());
        return HandlerResult::answered;
    }
    message.mutable_lighting_scene_changed()->set_by(event.viewer);
    parts_.server.reply(event, message);
    parts_.server.broadcast(message, event.viewer);
    return HandlerResult::answered;
}

void LightingService::follow(const LogEntry& note) {
    const v1::ServerMessage news = scenes_.follow(note.number, note.body);
    if (news.body_case() != v1::ServerMessage::BODY_NOT_SET) {
        parts_.server.broadcast(news);
    }
}

HandlerResult LightingService::save(ViewerSession& session, const ClientEvent& event) {
    const std::string& name = event.message.save_lighting_scene().name();
    const std::string& key = event.message.request_key();
    const bool kept = event.message.has_request_key() && parts_.scene.log().kept(key) != nullptr;
    const bool done = kept || scenes_.save(name, session.name(), parts_.scene.scene(), key);
    v1::ServerMessage message;
    message.mutable_lighting_scene_changed()->set_name(name);
    message.mutable_lighting_scene_changed()->set_by_name(session.name());
    if (!kept) {
        return answer(event, done, message);
    }
    message.mutable_lighting_scene_changed()->set_by(event.viewer);
    message.mutable_lighting_scene_changed()->set_removed(!scenes_.contains(name));
    parts_.server.reply(event, message);  // nothing is new to the others
    return HandlerResult::answered;
}

HandlerResult LightingService::remove(ViewerSession& session, const ClientEvent& event) {
    const std::string& name = event.message.remove_lighting_scene().name();
    const bool done = scenes_.remove(name);
    v1::ServerMessage message;
    message.mutable_lighting_scene_changed()->set_name(name);
    message.mutable_lighting_scene_changed()->set_by_name(session.name());
    message.mutable_lighting_scene_changed()->set_removed(true);
    return answer(event, done, message);
}

}  // namespace raybundle
