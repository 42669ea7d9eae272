// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scheduling/frame_policy.h"
#include "session/live_scene.h"
#include "session/measure/error_checker.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Finds out how wrong viewers' pictures are: by what their samples say, and by path tracing some
/// pixels of those at rest.
class ErrorService {
  public:
    struct Parts {
        const LiveScene& scene;
        const Viewers& viewers;
        FramePolicy& policy;
    };
    explicit ErrorService(const Parts& parts);

    /// Has the errors of pictures estimated from their samples, of that first that has waited
    /// longest, as far as there is time.
    void refresh_statistics();

    /// Has the true error of a picture at rest measured, of that which has waited longest. Not
    /// while somebody walks: reading the picture back stops the GPU for a moment.
    void check_pictures();

  private:
    void take_result();
    void check(ViewerSession& session);

    Parts parts_;
    ErrorChecker checker_;
};

}  // namespace raybundle
