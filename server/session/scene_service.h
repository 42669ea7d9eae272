// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "net/server.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/viewers/viewer_session.h"

namespace raybundle {

/// Hands requests about scenes on to those who made the loop.
class SceneService {
  public:
    /// Takes listScenes and openScene with the viewer's name, and answers them.
    using SceneRequests =
        std::function<void(const ClientEvent& request, const std::string& viewer_name)>;
    /// Takes measureEffects, and answers it.
    using EffectRequests =
        std::function<void(const ClientEvent& request, const Scene&, const PatchMesh&)>;

    struct Parts {
        const LiveScene& scene;
        Server& server;
        SceneRequests scene_requests;    ///< empty: there are no scenes to open
        EffectRequests effect_requests;  ///< empty: effects are not measured
    };
    explicit SceneService(Parts parts) : parts_(std::move(parts)) {}

    /// Handles listScenes and openScene.
    HandlerResult request_scene(ViewerSession& session, const ClientEvent& event);
    /// Handles measureEffects.
    HandlerResult measure_effects(ViewerSession& session, const ClientEvent& event);

  private:
    Parts parts_;
};

}  // namespace raybundle
