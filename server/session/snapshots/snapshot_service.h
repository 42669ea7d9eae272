// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "net/server.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/receiver_list.h"
#include "session/snapshots/snapshot_queue.h"
#include "session/viewers/viewer_session.h"

namespace raybundle {

/// Handles requests for pictures that are rendered apart.
class SnapshotService {
  public:
    struct Parts {
        const LiveScene& scene;
        SnapshotQueue& queue;
        ReceiverList& receivers;
        Server& server;
    };
    explicit SnapshotService(const Parts& parts) : parts_(parts) {}

    /// Handles snapshot: the request is answered when the picture is done.
    HandlerResult add(ViewerSession& session, const ClientEvent& event);
    /// Handles cancelSnapshot.
    HandlerResult cancel(ViewerSession& session, const ClientEvent& event);
    /// A viewer has left.
    void forget(ViewerId viewer);

  private:
    Parts parts_;
};

/// The scene as it was right after a change; null where that is not known any more.
std::unique_ptr<EarlierScene> make_earlier_scene(const LiveScene& scene, std::uint32_t epoch);

}  // namespace raybundle
