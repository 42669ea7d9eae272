// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "gpu/egl_context.h"
#include "net/server.h"
#include "session/live_scene.h"
#include "session/receiver_list.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Makes viewers' pictures and takes them away. Newcomers share one, so that a connection that
/// never acknowledges a frame costs no picture of its own.
class ViewerPictures {
  public:
    struct Parts {
        const LiveScene& scene;
        const Viewers& viewers;
        ReceiverList& receivers;
        Server& server;
    };
    explicit ViewerPictures(const Parts& parts) : parts_(parts) {}

    /// The viewer's own picture shows what it wants to see. Where it has none, it gets the shared
    /// one if that shows its first frame, or a new one. Throws GpuError.
    void prepare(ViewerSession& session);
    /// The shared picture, which shows this viewer's first frame next. Throws GpuError.
    [[nodiscard]] ViewerImage& first_look(const ViewerSession& session);
    void drop(ViewerSession& session);
    /// A picture cannot be made: the viewer is told and sent away.
    void refuse(ViewerSession& session, const GpuError& error);
    /// A viewer leaves.
    void forget(ViewerSession& session);

    /// The scene has changed: no first frame shows it.
    void note_change() { first_look_of_ = 0; }
    /// Replaces all pictures by ones of another solver.
    void renew(const Solver& solver, const ViewPrograms& programs);

    /// On the GPU, of all pictures.
    [[nodiscard]] std::size_t bytes() const;

  private:
    Parts parts_;
    std::unique_ptr<ViewerImage> first_look_;
    ViewerId first_look_of_ = 0;  // whose first frame it shows; 0: of nobody it still fits
};

}  // namespace raybundle
