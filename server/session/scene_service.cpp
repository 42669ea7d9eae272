// SPDX-License-Identifier: Apache-2.0
#include "session/scene_service.h"

namespace raybundle {

HandlerResult SceneService::request_scene(ViewerSession& session, const ClientEvent& event) {
    if (parts_.scene_requests) {
        parts_.scene_requests(event, session.name());
    } else {
        parts_.server.reply_error(event, v1::Error::NOT_FOUND,
                                  "this server has no folder of scenes");
    }
    return HandlerResult::answered;
}

HandlerResult SceneService::measure_effects(ViewerSession& /*session*/, const ClientEvent& event) {
    if (parts_.effect_requests) {
        parts_.effect_requests(event, parts_.scene.scene(), parts_.scene.settled_mesh());
    } else {
        parts_.server.reply_error(event, v1::Error::NOT_FOUND, "this server measures no effects");
    }
    return HandlerResult::answered;
}

}  // namespace raybundle
