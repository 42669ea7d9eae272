// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "net/server.h"
#include "session/animation/animation_player.h"
#include "session/changes/change_traces.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/viewers/viewer_session.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Plays the animations of the file for everybody: handles playAnimation and tells all viewers what
/// plays. ChangeCoordinator makes the changes.
class AnimationService {
  public:
    struct Parts {
        LiveScene& scene;
        const Viewers& viewers;
        const ChangeTraces& traces;
        Server& server;
    };
    AnimationService(const Parts& parts, const Clock& clock);

    HandlerResult play(ViewerSession& session, const ClientEvent& event);

    /// What is to be changed next; see AnimationPlayer::step().
    std::vector<v1::SceneChanged> step();
    /// That of the request whose first changes step() has given; null where nobody wants it.
    [[nodiscard]] std::shared_ptr<Trace> take_trace() { return std::exchange(trace_, nullptr); }
    /// A change of step() gets this number.
    void number(v1::SceneChanged& change, std::uint32_t epoch) const {
        player_.number(change, epoch);
    }
    /// It is in the log under that number.
    void note_recorded(const v1::SceneChanged& change, std::uint32_t epoch) {
        player_.note_recorded(change, epoch);
    }
    /// A change of another server is made next: what plays here gives way to hands there.
    void note_foreign(const v1::SceneChanged& change);
    /// A viewer asks for a change, or for what stands for several.
    void note_request(const ClientEvent& event, const v1::SceneChanged& change);
    void note_undo(std::uint32_t epoch);
    /// A change of step() could not be saved.
    void note_failure();

    void describe(v1::Scene* message) const { player_.describe(message); }

  private:
    bool answer_kept(const ClientEvent& event);
    void tell(const std::vector<std::size_t>& animations, std::uint32_t by,
              std::size_t but_not_first = 0);
    [[nodiscard]] v1::ServerMessage message_of(std::size_t animation, std::uint32_t by) const;

    Parts parts_;
    AnimationPlayer player_;
    std::shared_ptr<Trace> trace_;  ///< of the request whose changes are to come
};

}  // namespace raybundle
