// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "net/server.h"
#include "session/changes/lighting_scenes.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/viewers/viewer_session.h"

namespace raybundle {

/// Handles what people save of the lights. ChangeCoordinator brings it back.
class LightingService {
  public:
    struct Parts {
        LiveScene& scene;
        Server& server;
    };
    explicit LightingService(const Parts& parts) : parts_(parts), scenes_(parts.scene.log()) {
        scenes_.take_up(parts.scene.scene());
    }

    HandlerResult save(ViewerSession& session, const ClientEvent& event);
    HandlerResult remove(ViewerSession& session, const ClientEvent& event);

    /// A lighting scene of another server of the project.
    void follow(const LogEntry& note);

    [[nodiscard]] const LightingScenes& scenes() const { return scenes_; }

  private:
    HandlerResult answer(const ClientEvent& event, bool done, v1::ServerMessage& message);

    Parts parts_;
    LightingScenes scenes_;
};

}  // namespace raybundle
