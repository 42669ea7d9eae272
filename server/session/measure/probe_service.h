// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "net/server.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/viewers/viewer_pictures.h"

namespace raybundle {

/// Measures light for viewers: at a pixel, where a ray ends, or at the points of a grid.
class ProbeService {
  public:
    struct Parts {
        const LiveScene& scene;
        ViewerPictures& pictures;
        Server& server;
    };
    explicit ProbeService(const Parts& parts) : parts_(parts) {}

    /// Handles probe.
    HandlerResult probe(ViewerSession& session, const ClientEvent& event);
    /// Handles probeGrid.
    HandlerResult probe_grid(ViewerSession& session, const ClientEvent& event);

  private:
    void answer(const ClientEvent& event, const std::optional<PixelProbe>& hit);
    void fill_result(const PixelProbe& hit, v1::ProbeResult* result) const;

    Parts parts_;
};

}  // namespace raybundle
