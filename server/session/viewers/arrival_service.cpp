// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/arrival_service.h"

#include <spdlog/spdlog.h>

#include "session/messages/scene_messages.h"

namespace raybundle {

/// One who asks over HTTP has no pictures that there might be no room for.
void ArrivalService::join_caller(const ClientEvent& event) {
    ViewerSession& session = parts_.viewers.add_caller(event.viewer, event.message.hello(),
                                                       parts_.scene.scene().cameras.front());
    session.set_role(event.role);
    if (event.message.has_id()) {
        v1::ServerMessage message;
        fill_welcome(event, message.mutable_welcome());
        parts_.server.reply(event, message);
    }
    spdlog::debug("caller {} '{}' asks", event.viewer, session.name());
}

void ArrivalService::join(const ClientEvent& event) {
    if (event.caller) {
        join_caller(event);
        return;
    }
    v1::Hello hello = event.message.hello();
    const glm::uvec2 size = parts_.admission.served_size(ViewerSession::size_of(hello), nullptr);
    to_message(size, hello.mutable_viewport());
    if (const std::string reason = parts_.admission.no_room_for(size, nullptr); !reason.empty()) {
        parts_.metrics.count_refused_viewer();
        parts_.server.reply_error(event, v1::Error::RESOURCE_EXHAUSTED, reason);
        parts_.server.close(event.viewer, CloseCode::try_again_later, reason);
        return;
    }
    ViewerSession& session =
        parts_.viewers.add(event.viewer, hello, parts_.scene.scene().cameras.front());
    session.set_role(event.role);
    parts_.views.restore_target(session);
    parts_.presence.note_arrival();
    v1::ServerMessage message;
    fill_welcome(event, message.mutable_welcome());
    to_message(size, message.mutable_welcome()->mutable_viewport());
    parts_.server.reply(event, message);
    if (!event.message.has_id()) {
        parts_.server.send(event.viewer, message);
    }
    if (hello.light()) {
        parts_.light.join(session);
    }
    spdlog::info("viewer {} '{}' joined", event.viewer, hello.name());
}

void ArrivalService::fill_welcome(const ClientEvent& event, v1::Welcome* welcome) const {
    welcome->set_protocol("1.0");
    welcome->set_server("raybundle " RAYBUNDLE_VERSION);
    welcome->set_viewer(event.viewer);
    welcome->set_role(event.role);
    welcome->set_epoch(parts_.scene.epoch());
    describe_scene(parts_.scene.scene(), welcome->mutable_scene());
    parts_.lighting.describe(welcome->mutable_scene());
    parts_.animations.describe(welcome->mutable_scene());
    parts_.scene.fades().describe(parts_.clock.now(), welcome->mutable_scene());
    ViewerAdmission::fill_limits(welcome->mutable_limits());
    welcome->set_renderer(parts_.traits.renderer);
    welcome->set_software_rendering(parts_.traits.software_rendering);
    welcome->set_can_open_scenes(parts_.traits.can_open_scenes);
    welcome->set_saving(parts_.scene.log().saving());
    if (event.message.hello().light()) {
        welcome->set_light(true);
    }
    welcome->set_name(event.message.hello().name());
    parts_.review.fill_welcome(welcome);
    parts_.measurements.fill_welcome(welcome);
}

}  // namespace raybundle
