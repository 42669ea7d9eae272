// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "net/server.h"
#include "session/animation/animation_service.h"
#include "session/changes/change_queue.h"
#include "session/live_scene.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Numbers and saves the changes whose turn has come, and applies them to the scene; what becomes
/// of the light is ChangeCoordinator's. Answers the requests for those that cannot be made.
class ChangeRecorder {
  public:
    struct Parts {
        LiveScene& scene;
        const Viewers& viewers;
        AnimationService& animations;
        Server& server;
    };
    explicit ChangeRecorder(const Parts& parts) : parts_(parts) {}

    /// Keeps of `pending` what is in the log now and applied. Returns those that other servers'
    /// changes come before: they are to be tried again.
    [[nodiscard]] std::vector<PendingChange> record(std::vector<PendingChange>& pending);

    /// False where what other servers have done since a change was asked for stands against it, or
    /// where a change of theirs cannot be made here: it is to be refused.
    [[nodiscard]] bool fits_scene(const PendingChange& pending) const;
    /// Answers the requests for one that does not fit, or cannot be made; one of another server
    /// keeps its number, and what stands for several has failed in part.
    void refuse_unfit(const PendingChange& pending);
    void refuse(const PendingChange& pending, v1::Error::Code code, const std::string& reason);
    /// Another server may have given out the number of what is to be added.
    void renumber(PendingChange& pending) const;

    /// Answers a request that has been carried out before, under its key. False: it has not.
    [[nodiscard]] bool answer_made(const ClientEvent& request) const;
    /// Answers one that stood for several changes, or for none.
    void answer_all_made(const ClientEvent& request) const;
    /// Answers those requests that have been carried out meanwhile. True: none is left.
    [[nodiscard]] bool drop_made(PendingChange& pending) const;
    /// Answers one for a change that could not be saved.
    void refuse_unsaved(const ClientEvent& request) const;

    /// The changes that one request stands for begin.
    void begin_several() { some_failed_ = false; }
    /// Some since then could not be saved.
    [[nodiscard]] bool some_failed() const { return some_failed_; }

  private:
    Recorded record_one(PendingChange& pending);
    Recorded number(PendingChange& pending, const v1::SceneChanged& before);
    [[nodiscard]] v1::Error problem_now(const PendingChange& pending) const;
    [[nodiscard]] bool part_is_over(const PendingChange& pending) const;
    void sign(PendingChange& pending) const;
    void note_recorded(const PendingChange& pending) const;

    Parts parts_;
    bool some_failed_ = false;
};

}  // namespace raybundle
