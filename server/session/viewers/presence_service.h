// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "net/server.h"
#include "scheduling/frame_policy.h"
#include "session/changes/change_log.h"
#include "session/handler_result.h"
#include "session/viewers/peer_viewers.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Tells viewers who else is here and where they look, and lets them follow each other.
class PresenceService {
  public:
    struct Parts {
        const Viewers& viewers;
        const FramePolicy& policy;
        ChangeLog& log;
        Server& server;
    };
    explicit PresenceService(const Parts& parts) : parts_(parts) {}

    /// Handles follow.
    HandlerResult follow(ViewerSession& session, const ClientEvent& event);
    /// The followers of a viewer, and theirs, see what it sees.
    void lead(const ViewerSession& leader);
    /// Somebody has come.
    void note_arrival() { changed_ = true; }
    /// A viewer has left: nobody follows it any more.
    void forget(ViewerId viewer);
    /// What other servers of the project tell of their viewers.
    void hear_peers();
    /// Tells everybody who is here, where that has changed and not too often.
    void send();

  private:
    void follow_peers();
    void tell_peers(const v1::Presence& own, TimePoint now);

    Parts parts_;
    PeerViewers peers_;
    TimePoint told_;  ///< the other servers
    bool changed_ = false;
    TimePoint last_sent_;
};

}  // namespace raybundle
