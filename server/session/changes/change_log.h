// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "journal/project_log.h"
#include "journal/session_journal.h"
#include "raybundle.pb.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "session/changes/change_records.h"
#include "session/changes/scene_history.h"
#include "session/messages/made_requests.h"

namespace raybundle {

/// What has become of a change that was to be recorded.
enum class Recorded : std::uint8_t {
    yes,
    later,  ///< other servers' changes come first: take_entries() has them
    no,     ///< it could not be stored and must not be made; refusal() says why
};

/// The one ordered log of scene changes: gives each its epoch and, where a journal is configured,
/// puts it there before anybody hears of it.
class ChangeLog {
  public:
    using Opener = std::function<std::unique_ptr<ProjectLog>()>;

    ChangeLog() = default;  ///< without a journal

    /// With a journal. A journal that cannot be used is reported in the log and refuses changes;
    /// viewing does not depend on it. Each change looks again whether it can be used now, as after
    /// another server has given it free: with changes in it that this scene lacks it cannot.
    explicit ChangeLog(const JournalSettings& settings);
    /// With any log. place: what to call it, for people. open: throws JournalError.
    ChangeLog(std::string place, Opener open);

    [[nodiscard]] std::uint32_t epoch() const { return epoch_; }

    /// Closes a journal that one log alone may have, so that another one can use it, and opens it
    /// again. No change may be recorded meanwhile.
    void suspend();
    void resume();

    /// Brings a scene as read from its file to the state of the journal.
    void restore(Scene& scene, PatchMesh& mesh);

    /// Numbers the change and stores it, with what its subject is like before it, who makes it
    /// when, the keys of the requests for it, and the trace that other servers go on with.
    [[nodiscard]] Recorded record(v1::SceneChanged& change, const v1::SceneChanged& before,
                                  const std::vector<RequestKey>& keys = {},
                                  const std::string& traceparent = {});
    /// What other servers of the project have added, in order.
    [[nodiscard]] std::vector<LogEntry> take_entries();
    /// Takes up the next change that is in the log already, of another server. False: it is not
    /// the next one.
    [[nodiscard]] bool accept(const v1::SceneChanged& change, const v1::SceneChanged& before,
                              const std::vector<RequestKey>& keys);
    /// Notes what a change is announced as; it answers its requests also when they come again.
    void note_answer(const std::vector<RequestKey>& keys, const v1::SceneChanged& change) {
        made_.note(keys, change);
    }
    /// Whether other servers have it, too.
    [[nodiscard]] bool shared() const { return journal_ && journal_->shared(); }
    /// A change that is in the log could not be made here.
    void note_lost() { lost_ = true; }
    /// Whether other servers of the log have the scene as it is here, as far as is known.
    [[nodiscard]] bool agrees() const { return shared() && working_ && !lost_; }
    /// See ProjectLog; nothing where nobody else has the log.
    void publish(const v1::ServerMessage& message, bool lasting);
    [[nodiscard]] std::vector<PeerNews> take_news();
    /// What was made of a request with that key; null where it is not known.
    [[nodiscard]] const MadeRequest* made(const std::string& key) const {
        return made_.change(key);
    }
    /// Which note a request with that key has left; null where it is not known.
    [[nodiscard]] const KeyedNote* kept(const std::string& key) const { return made_.kept(key); }
    /// Why nothing was stored, for who asked: what is answered in place of `text`.
    [[nodiscard]] v1::Error refusal(const std::string& text) const;

    /// A number for a new note; `free` is one that no known one has. Nothing where the log cannot
    /// be used.
    [[nodiscard]] std::optional<std::uint32_t> new_number(NoteKind kind, std::uint32_t free);
    /// Stores a note that a viewer leaves, or forgets it where `body` is empty. key: of the request
    /// for it; empty: none. False: it could not be stored, or another server has changed it
    /// meanwhile; refusal() says which.
    [[nodiscard]] bool keep_note(NoteKind kind, std::uint32_t number, const std::string& body,
                                 const std::string& key = {});
    /// Bodies of the notes that the journal holds, by number.
    [[nodiscard]] std::vector<std::string> notes(NoteKind kind);
    /// What the subject of a recorded change was before it and is after it.
    /// run: as for SceneHistory::note().
    void note_states(const v1::SceneChanged& before, const v1::SceneChanged& after,
                     std::uint32_t run) {
        history_.note(before, after, run);
    }
    [[nodiscard]] const SceneHistory& history() const { return history_; }
    /// Who has changed what; before a restart, too, where there is a journal.
    [[nodiscard]] const ChangeRecords& records() const { return records_; }

    /// Of each animation the last change that it has made, in their order, as restored.
    [[nodiscard]] const std::vector<v1::AnimationStep>& animation_steps() const {
        return animation_steps_;
    }

    /// As SessionJournal::remember_scene(); a failure is logged.
    void remember_scene(const std::string& started_with, const std::string& shown);

    [[nodiscard]] std::uint64_t failures() const { return failures_; }
    /// Whether what is changed now is there again after a restart. Any thread.
    [[nodiscard]] v1::Saving saving() const {
        return !required_ ? v1::NOT_SAVED : working_ ? v1::SAVED : v1::FAILING;
    }
    /// What the journal is called; empty: there is none.
    [[nodiscard]] const std::string& place() const { return place_; }
    /// Whether the next change is expected to be stored. Any thread.
    [[nodiscard]] bool working() const { return working_; }

  private:
    void open();
    bool usable();
    void open_again();
    void refused(const std::string& what, const std::string& reason);
    void restore_history(const Scene& scene);
    void restore_keys();
    void note_animation(const v1::SceneChanged& change);

    std::string place_;
    Opener open_;
    std::string problem_;  ///< why the journal cannot be used, as last logged
    bool required_ = false;
    std::atomic<bool> working_{true};
    std::unique_ptr<ProjectLog> journal_;
    std::string outage_;      ///< why the last attempt failed, of a log that others share
    bool overtaken_ = false;  ///< another server has changed the note of the last keep_note()
    std::uint32_t epoch_ = 0;
    SceneHistory history_;
    ChangeRecords records_;
    std::vector<v1::AnimationStep> animation_steps_;
    std::uint64_t failures_ = 0;
    bool lost_ = false;  ///< some change of the log
    MadeRequests made_;
};

}  // namespace raybundle
