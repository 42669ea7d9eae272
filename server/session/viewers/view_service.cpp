// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/view_service.h"

#include <string>
#include <utility>
#include <vector>

#include "session/messages/scene_messages.h"

namespace raybundle {

ViewService::ViewService(const Parts& parts)
    : parts_(parts),
      targets_(parts.scene.log()),
      walk_mapper_(
          std::as_const(parts.scene).scene(), parts.policy.settings().rests.walk_map,
          [this](const ClientEvent& event, const std::optional<WalkMap>& map, std::uint32_t epoch) {
              answer_walk_map(event, map, epoch);
          },
          &parts.scene.geometry_mutex()) {}

HandlerResult ViewService::set_camera(ViewerSession& session, const ClientEvent& event) {
    session.follow(0);
    session.set_camera(event.message.set_camera(), event.message.id());
    parts_.presence.lead(session);
    parts_.light.look(session);
    return HandlerResult::ok;
}

HandlerResult ViewService::set_display(ViewerSession& session, const ClientEvent& event) {
    session.set_display(event.message.set_display());
    return HandlerResult::ok;
}

HandlerResult ViewService::set_depths(ViewerSession& session, const ClientEvent& event) {
    session.set_depths(event.message.set_depths().columns());
    return HandlerResult::ok;
}

HandlerResult ViewService::set_hidden(ViewerSession& session, const ClientEvent& event) {
    std::vector<std::uint32_t> objects;
    for (const std::uint32_t id : event.message.set_hidden().objects()) {
        if (id < 1 || id > parts_.scene.scene().objects.size()) {
            parts_.server.reply_error(event, v1::Error::NOT_FOUND,
                                      "setHidden.objects: no object " + std::to_string(id));
            return HandlerResult::answered;
        }
        objects.push_back(id - 1);
    }
    session.set_hidden(std::move(objects));
    return HandlerResult::ok;
}

HandlerResult ViewService::set_target(ViewerSession& session, const ClientEvent& event) {
    const v1::SetTarget& target = event.message.set_target();
    if (!targets_.keep(session.name(), target)) {
        const v1::Error error = parts_.scene.log().refusal("the target could not be saved");
        parts_.server.reply_error(event, error.code(), error.message());
        return HandlerResult::answered;
    }
    session.set_target(target);
    return HandlerResult::ok;
}

void ViewService::restore_target(ViewerSession& session) const {
    if (const v1::SetTarget* const target = targets_.of(session.name())) {
        session.set_target(*target);
    }
}

HandlerResult ViewService::get_walk_map(ViewerSession& /*session*/, const ClientEvent& event) {
    walk_mapper_.ask(event, parts_.scene.epoch());
    return HandlerResult::answered;
}

/// On the mapper's thread, or on the caller's where a newer request has replaced this one.
void ViewService::answer_walk_map(const ClientEvent& event, const std::optional<WalkMap>& map,
                                  std::uint32_t epoch) const {
    if (!map) {
        parts_.server.reply_error(event, v1::Error::RESOURCE_EXHAUSTED,
                                  "getWalkMap: a newer one has come before its turn");
        return;
    }
    v1::ServerMessage answer;
    v1::WalkMap& out = *answer.mutable_walk_map();
    to_message(map->origin, out.mutable_origin());
    out.set_cell(WalkMap::cell);
    out.set_layer(WalkMap::layer);
    out.set_columns(WalkMap::columns);
    out.set_layers(WalkMap::layers);
    std::string& bytes = *out.mutable_occupied();
    for (const std::uint64_t column : map->occupied) {
        for (int byte = 0; byte < 8; ++byte) {
            bytes.push_back(static_cast<char>(column >> (8 * byte) & 0xffU));
        }
    }
    if (map->floor) {
        out.set_floor(*map->floor);
    }
    out.set_epoch(epoch);
    parts_.server.reply(event, answer);
}

}  // namespace raybundle
