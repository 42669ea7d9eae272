// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/changes/change_coordinator.h"
#include "session/changes/lighting_service.h"
#include "session/measure/measure_service.h"
#include "session/review/review_service.h"
#include "session/viewers/view_service.h"

namespace raybundle {

/// Hands what other servers of the project have added to its log to who it concerns. Does nothing
/// where the log is this server's alone.
class ProjectFollower {
  public:
    struct Parts {
        LiveScene& scene;
        ChangeCoordinator& changes;
        LightingService& lighting;
        ReviewService& review;
        ViewService& views;
        MeasureService& measurements;
    };
    explicit ProjectFollower(const Parts& parts) : parts_(parts) {}

    void step();

  private:
    Parts parts_;
};

}  // namespace raybundle
