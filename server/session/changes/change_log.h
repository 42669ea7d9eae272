// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "journal/session_journal.h"
#include "raybundle.pb.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "session/changes/change_records.h"
#include "session/changes/scene_history.h"

namespace raybundle {

/// The one ordered log of scene changes: gives each its epoch and, where a journal is configured,
/// puts it on disk before anybody hears of it.
class ChangeLog {
  public:
    ChangeLog() = default;  ///< without a journal

    /// With a journal. A journal that cannot be used is reported in the log and refuses changes;
    /// viewing does not depend on it. Each change looks again whether it can be used now, as after
    /// another server has given it free: with changes in it that this scene lacks it cannot.
    explicit ChangeLog(const JournalSettings& settings);

    [[nodiscard]] std::uint32_t epoch() const { return epoch_; }

    /// Closes the journal, so that another log can use it, and opens it again. No change may be
    /// recorded meanwhile.
    void suspend() { journal_.reset(); }
    void resume();

    /// Brings a scene as read from its file to the state of the journal.
    void restore(Scene& scene, PatchMesh& mesh);

    /// Numbers the change and stores it, with what its subject is like before it, and who makes it
    /// when. False: it could not be stored and must not be made.
    [[nodiscard]] bool record(v1::SceneChanged& change, const v1::SceneChanged& before);

    /// Stores a note that a viewer leaves, or forgets it where `body` is empty. False: it could not
    /// be stored.
    [[nodiscard]] bool keep_note(NoteKind kind, std::uint32_t number, const std::string& body);
    /// Bodies of the notes that the journal holds, by number.
    [[nodiscard]] std::vector<std::string> notes(NoteKind kind);
    /// What the subject of a recorded change was before it and is after it.
    void note_states(const v1::SceneChanged& before, const v1::SceneChanged& after) {
        history_.note(before, after);
    }
    [[nodiscard]] const SceneHistory& history() const { return history_; }
    /// Who has changed what; before a restart, too, where there is a journal.
    [[nodiscard]] const ChangeRecords& records() const { return records_; }

    /// As SessionJournal::remember_scene(); a failure is logged.
    void remember_scene(const std::string& started_with, const std::string& shown);

    [[nodiscard]] std::uint64_t failures() const { return failures_; }
    /// Whether what is changed now is there again after a restart. Any thread.
    [[nodiscard]] v1::Saving saving() const {
        return !required_ ? v1::NOT_SAVED : working_ ? v1::SAVED : v1::FAILING;
    }
    /// The journal; empty: there is none.
    [[nodiscard]] const std::string& file() const { return settings_.file; }
    /// Whether the next change is expected to be stored. Any thread.
    [[nodiscard]] bool working() const { return working_; }

  private:
    void open();
    void open_again();
    void restore_history(const Scene& scene);

    JournalSettings settings_;
    std::string problem_;  ///< why the journal cannot be used, as last logged
    bool required_ = false;
    std::atomic<bool> working_{true};
    std::optional<SessionJournal> journal_;
    std::uint32_t epoch_ = 0;
    SceneHistory history_;
    ChangeRecords records_;
    std::uint64_t failures_ = 0;
};

}  // namespace raybundle
