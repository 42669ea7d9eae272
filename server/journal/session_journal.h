// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "journal/file_lock.h"
#include "journal/project_log.h"
#include "journal/sqlite_database.h"
#include "raybundle.pb.h"

namespace raybundle {

struct JournalSettings {
    std::string file;
    std::string scene_name;    ///< for people who look into the file
    std::string scene_digest;  ///< of the scene file: another one is another session
    std::uint64_t max_bytes = 64U << 20U;
};

/// The session's scene changes on disk, so that a server that is killed goes on where it was. A
/// change that append() has returned from survives the process and the machine (SQLite, WAL,
/// synchronous=FULL). Of the changes to one object, light or material only the sum is kept, and of
/// what was before them as many states as are kept for undo, so the file does not grow with time.
/// Others may read the file meanwhile, as `sqlite3 FILE '.backup COPY'` does; one server at a time
/// writes it. One thread only.
class SessionJournal final : public ProjectLog {
  public:
    static constexpr std::uint32_t most_past = 16384;

    /// Opens the journal, or begins one. A damaged file is set aside under another name, which
    /// set_aside() gives, and a new journal begins. Throws JournalError where that fails: a folder
    /// that is missing, a file of a newer version, a journal in use by another server.
    explicit SessionJournal(const JournalSettings& settings);

    /// Changes applied in this session, 0 in a new one.
    [[nodiscard]] std::uint32_t epoch() const override { return epoch_; }

    [[nodiscard]] std::vector<v1::SceneChanged> changes() override;
    /// Without `before` nobody can go back beyond this change after a restart. Always `yes`; where
    /// it throws, nothing is written, and a later attempt may succeed.
    Appended append(const v1::SceneChanged& change, const v1::SceneChanged& before = {},
                    const std::vector<RequestKey>& keys = {},
                    const std::string& traceparent = {}) override;
    /// most_past at most.
    [[nodiscard]] std::vector<v1::SceneChanged> past() override;
    /// The last most_request_keys of the last most_past changes.
    [[nodiscard]] std::vector<KeyedChange> keyed() override;

    [[nodiscard]] std::uint32_t new_number(NoteKind kind, std::uint32_t free) override;
    [[nodiscard]] Appended keep_note(NoteKind kind, std::uint32_t number, const std::string& body,
                                     const std::string& key = {}) override;
    /// The last most_request_keys.
    [[nodiscard]] std::vector<KeyedNote> keyed_notes() override;
    void drop_note(NoteKind kind, std::uint32_t number) override;
    [[nodiscard]] std::vector<std::string> notes(NoteKind kind) override;

    void remember_scene(const std::string& started_with, const std::string& shown) override;
    /// The same in a file that holds no session. Throws JournalError.
    static void remember_scene(const std::string& file, const std::string& started_with,
                               const std::string& shown);
    /// What a journal that nobody has open remembers for a server started with that scene; empty
    /// where it remembers nothing or cannot be read.
    static std::string remembered_scene(const std::string& file, const std::string& started_with);

    [[nodiscard]] std::optional<std::string> set_aside() const override { return set_aside_; }

  private:
    void open(const JournalSettings& settings);
    void create_tables();
    void find_session(const JournalSettings& settings);
    void keep_number(NoteKind kind, std::uint32_t number);
    void keep_past(std::uint32_t epoch, const v1::SceneChanged& before);
    v1::SceneChanged take_earlier(const v1::SceneChanged& change, std::int64_t subject);

    std::string file_;
    std::optional<FileLock> lock_;
    std::optional<SqliteDatabase> database_;
    std::optional<std::string> set_aside_;
    std::int64_t session_ = 0;
    std::uint32_t epoch_ = 0;
};

/// SHA-256 of a file as hexadecimal digits; nothing where it cannot be read.
std::optional<std::string> file_digest(const std::string& file);

}  // namespace raybundle
