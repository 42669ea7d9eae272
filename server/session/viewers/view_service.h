// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "net/server.h"
#include "session/handler_result.h"
#include "session/light/light_service.h"
#include "session/live_scene.h"
#include "session/viewers/presence_service.h"
#include "session/viewers/target_store.h"
#include "session/viewers/viewer_session.h"
#include "session/viewers/walk_mapper.h"

namespace raybundle {

/// Handles what a viewer says about its own picture: camera, display, what is hidden, target; and
/// the map that it walks by.
class ViewService {
  public:
    struct Parts {
        LiveScene& scene;
        PresenceService& presence;
        LightService& light;
        const FramePolicy& policy;
        Server& server;
    };
    explicit ViewService(const Parts& parts);

    HandlerResult set_camera(ViewerSession& session, const ClientEvent& event);
    HandlerResult set_display(ViewerSession& session, const ClientEvent& event);
    HandlerResult set_depths(ViewerSession& session, const ClientEvent& event);
    HandlerResult set_hidden(ViewerSession& session, const ClientEvent& event);
    HandlerResult set_target(ViewerSession& session, const ClientEvent& event);
    HandlerResult get_walk_map(ViewerSession& session, const ClientEvent& event);

    /// A target of another server of the project.
    void follow(const LogEntry& note) { targets_.follow(note.number, note.body); }
    /// Gives a viewer the target that one of its name has set.
    void restore_target(ViewerSession& session) const;

  private:
    void answer_walk_map(const ClientEvent& event, const std::optional<WalkMap>& map,
                         std::uint32_t epoch) const;

    Parts parts_;
    TargetStore targets_;
    WalkMapper walk_mapper_;  // last: its thread uses the others
};

}  // namespace raybundle
