// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "net/server.h"
#include "session/animation/animation_service.h"
#include "session/changes/lighting_scenes.h"
#include "session/light/light_service.h"
#include "session/live_scene.h"
#include "session/loop_metrics.h"
#include "session/measure/measure_service.h"
#include "session/review/review_service.h"
#include "session/viewers/presence_service.h"
#include "session/viewers/view_service.h"
#include "session/viewers/viewer_admission.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// What viewers are told of the machine and of what this server can do.
struct ServerTraits {
    std::string renderer;             ///< name of what draws
    bool software_rendering = false;  ///< it is no GPU
    bool can_open_scenes = false;
};

/// Lets viewers in: answers `hello` with `welcome`, or refuses them.
class ArrivalService {
  public:
    struct Parts {
        const LiveScene& scene;
        Viewers& viewers;
        const ViewerAdmission& admission;
        const ViewService& views;
        const ReviewService& review;
        const MeasureService& measurements;
        const LightingScenes& lighting;
        const AnimationService& animations;
        PresenceService& presence;
        LightService& light;
        Server& server;
        LoopMetrics& metrics;
        ServerTraits traits;
        const Clock& clock;
    };
    explicit ArrivalService(Parts parts) : parts_(std::move(parts)) {}

    void join(const ClientEvent& event);

  private:
    void join_caller(const ClientEvent& event);
    /// All but the viewport.
    void fill_welcome(const ClientEvent& event, v1::Welcome* welcome) const;

    Parts parts_;
};

}  // namespace raybundle
