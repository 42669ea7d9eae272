// SPDX-License-Identifier: Apache-2.0
#include "journal/session_journal.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "journal/change_sum.h"
#include "journal/request_keys.h"

namespace raybundle {
namespace {

constexpr int kSchemaVersion = 1;
constexpr std::uint64_t kPageBytes = 4096;
constexpr int kBusyMs = 1000;  ///< before a change is refused; pictures stand still meanwhile

/// What the server that was started with a scene shows.
constexpr const char* kShownTable =
    "CREATE TABLE IF NOT EXISTS shown(started_with TEXT PRIMARY KEY, scene TEXT NOT NULL)";

void write_shown(SqliteDatabase& database, const std::string& started_with,
                 const std::string& shown) {
    auto insert = database.prepare("INSERT OR REPLACE INTO shown VALUES(?, ?)");
    insert.bind(1, started_with);
    insert.bind(2, shown);
    insert.run();
}

/// Moves the database and its companions out of the way; returns the new name.
std::string move_aside(const std::string& file) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(
                             std::chrono::system_clock::now().time_since_epoch())
                             .count();
    std::string name = file + ".damaged-" + std::to_string(seconds);
    std::filesystem::rename(file, name);
    for (const char* companion : {"-wal", "-shm"}) {
        std::error_code absent;
        std::filesystem::rename(file + companion, name + companion, absent);
    }
    return name;
}

}  // namespace

SessionJournal::SessionJournal(const JournalSettings& settings) : file_(settings.file) {
    try {
        lock_.emplace(file_);
        try {
            open(settings);
        } catch (const SqliteError& error) {
            if (!error.corrupt) {
                throw;
            }
            database_.reset();
            set_aside_ = move_aside(file_);
            open(settings);
        }
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    } catch (const std::filesystem::filesystem_error& error) {
        throw JournalError(file_ + ": damaged, and " + error.code().message());
    } catch (const std::system_error& error) {
        const bool taken = error.code() == std::errc::resource_unavailable_try_again;
        throw JournalError(
            file_ + (taken ? ": another server uses it" : "-lock: " + error.code().message()));
    }
}

void SessionJournal::open(const JournalSettings& settings) {
    database_.emplace(file_);
    // A backup holds a lock for moments only.
    database_->execute("PRAGMA busy_timeout=" + std::to_string(kBusyMs));
    database_->execute("PRAGMA journal_mode=WAL");
    database_->execute("PRAGMA synchronous=FULL");
    database_->execute("PRAGMA max_page_count=" + std::to_string(settings.max_bytes / kPageBytes));
    auto check = database_->prepare("PRAGMA quick_check(1)");
    if (!check.step() || check.bytes(0) != "ok") {
        throw SqliteError("the database is damaged", true);
    }
    create_tables();
    // Additions that servers of the same version can do without.
    database_->execute(
        "CREATE TABLE IF NOT EXISTS note(session INTEGER NOT NULL REFERENCES session(id),"
        " kind INTEGER NOT NULL, number INTEGER NOT NULL, body BLOB NOT NULL,"
        " PRIMARY KEY(session, kind, number)) WITHOUT ROWID");
    database_->execute(
        // last: the highest number that a note has had, which may be gone
        "CREATE TABLE IF NOT EXISTS note_number(session INTEGER NOT NULL REFERENCES session(id),"
        " kind INTEGER NOT NULL, last INTEGER NOT NULL,"
        " PRIMARY KEY(session, kind)) WITHOUT ROWID");
    database_->execute(  // of a server that does not keep numbers yet
        "INSERT INTO note_number SELECT session, kind, max(number) FROM note WHERE true"
        " GROUP BY session, kind"
        " ON CONFLICT(session, kind) DO UPDATE SET last=max(last, excluded.last)");
    database_->execute(
        "CREATE TABLE IF NOT EXISTS past(session INTEGER NOT NULL REFERENCES session(id),"
        " epoch INTEGER NOT NULL, body BLOB NOT NULL, PRIMARY KEY(session, epoch)) WITHOUT ROWID");
    create_key_tables(*database_);
    database_->execute(kShownTable);
    find_session(settings);
}

void SessionJournal::create_tables() {
    auto query = database_->prepare("PRAGMA user_version");
    query.step();
    const std::int64_t version = query.integer(0);
    if (version > kSchemaVersion) {
        throw SqliteError("has version " + std::to_string(version) + ", this server knows " +
                              std::to_string(kSchemaVersion),
                          false);
    }
    if (version == kSchemaVersion) {
        return;
    }
    SqliteTransaction transaction(*database_);
    database_->execute(
        "CREATE TABLE session(id INTEGER PRIMARY KEY, scene_digest TEXT NOT NULL UNIQUE,"
        " scene_name TEXT NOT NULL, epoch INTEGER NOT NULL);"
        // kind: field number in SceneChanged; body: serialised SceneChanged
        "CREATE TABLE change(session INTEGER NOT NULL REFERENCES session(id),"
        " epoch INTEGER NOT NULL, kind INTEGER NOT NULL, subject INTEGER NOT NULL,"
        " body BLOB NOT NULL, PRIMARY KEY(session, epoch)) WITHOUT ROWID;"
        "CREATE UNIQUE INDEX change_subject ON change(session, kind, subject);"
        "PRAGMA user_version=" +
        std::to_string(kSchemaVersion));
    transaction.commit();
}

void SessionJournal::find_session(const JournalSettings& settings) {
    auto insert = database_->prepare(
        "INSERT INTO session(scene_digest, scene_name, epoch) VALUES(?, ?, 0)"
        " ON CONFLICT(scene_digest) DO NOTHING");
    insert.bind(1, settings.scene_digest);
    insert.bind(2, settings.scene_name);
    insert.run();
    auto select = database_->prepare("SELECT id, epoch FROM session WHERE scene_digest=?");
    select.bind(1, settings.scene_digest);
    select.step();
    session_ = select.integer(0);
    epoch_ = static_cast<std::uint32_t>(select.integer(1));
}

std::vector<v1::SceneChanged> SessionJournal::changes() {
    std::vector<v1::SceneChanged> result;
    try {
        auto select =
            database_->prepare("SELECT epoch, body FROM change WHERE session=? ORDER BY epoch");
        select.bind(1, session_);
        while (select.step()) {
            v1::SceneChanged& change = result.emplace_back();
            if (!change.ParseFromString(select.bytes(1))) {
                change.Clear();
                change.set_epoch(static_cast<std::uint32_t>(select.integer(0)));
            }
        }
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
    return result;
}

/// Removes the earlier change of the same subject and returns it, empty where there is none.
v1::SceneChanged SessionJournal::take_earlier(const v1::SceneChanged& change,
                                              std::int64_t subject) {
    v1::SceneChanged earlier;
    auto select = database_->prepare(
        "DELETE FROM change WHERE session=? AND kind=? AND subject=? RETURNING body");
    select.bind(1, session_);
    select.bind(2, std::int64_t{change.change_case()});
    select.bind(3, subject);
    while (select.step()) {
        if (!earlier.ParseFromString(select.bytes(0))) {
            earlier.Clear();
        }
    }
    return earlier;
}

void SessionJournal::keep_past(std::uint32_t epoch, const v1::SceneChanged& before) {
    if (before.change_case() != v1::SceneChanged::CHANGE_NOT_SET) {
        auto insert = database_->prepare("INSERT OR REPLACE INTO past VALUES(?, ?, ?)");
        insert.bind(1, session_);
        insert.bind(2, std::int64_t{epoch});
        insert.bind_blob(3, before.SerializeAsString());
        insert.run();
    }
    auto forget = database_->prepare("DELETE FROM past WHERE session=? AND epoch<=?");
    forget.bind(1, session_);
    forget.bind(2, std::int64_t{epoch} - std::int64_t{most_past});
    forget.run();
}

std::vector<v1::SceneChanged> SessionJournal::past() {
    std::vector<v1::SceneChanged> result;
    try {
        auto select =
            database_->prepare("SELECT epoch, body FROM past WHERE session=? ORDER BY epoch DESC");
        select.bind(1, session_);
        for (std::uint32_t epoch = epoch_; select.step() && select.integer(0) == epoch; --epoch) {
            v1::SceneChanged before;
            if (!before.ParseFromString(select.bytes(1))) {
                break;
            }
            before.set_epoch(epoch);
            result.push_back(before);
        }
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
    std::reverse(result.begin(), result.end());
    return result;
}

std::vector<KeyedChange> SessionJournal::keyed() {
    try {
        return keyed_changes(*database_, session_);
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
}

Appended SessionJournal::append(const v1::SceneChanged& change, const v1::SceneChanged& before,
                                const std::vector<RequestKey>& keys,
                                const std::string& /*traceparent*/) {
    try {
        const std::int64_t subject = subject_of(change).second;
        SqliteTransaction transaction(*database_);
        v1::SceneChanged sum = take_earlier(change, subject);
        add_change(change, sum);
        auto insert = database_->prepare("INSERT INTO change VALUES(?, ?, ?, ?, ?)");
        insert.bind(1, session_);
        insert.bind(2, std::int64_t{change.epoch()});
        insert.bind(3, std::int64_t{change.change_case()});
        insert.bind(4, subject);
        insert.bind_blob(5, sum.SerializeAsString());
        insert.run();
        auto update = database_->prepare("UPDATE session SET epoch=? WHERE id=?");
        update.bind(1, std::int64_t{change.epoch()});
        update.bind(2, session_);
        update.run();
        keep_past(change.epoch(), before);
        keep_keys(*database_, session_, change, keys, most_past);
        transaction.commit();
        epoch_ = change.epoch();
        return Appended::yes;
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
}

void SessionJournal::remember_scene(const std::string& started_with, const std::string& shown) {
    try {
        write_shown(*database_, started_with, shown);
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
}

void SessionJournal::remember_scene(const std::string& file, const std::string& started_with,
                                    const std::string& shown) {
    try {
        SqliteDatabase database(file);
        database.execute("PRAGMA busy_timeout=" + std::to_string(kBusyMs));
        database.execute(kShownTable);
        write_shown(database, started_with, shown);
    } catch (const SqliteError& error) {
        throw JournalError(file + ": " + error.what());
    }
}

std::string SessionJournal::remembered_scene(const std::string& file,
                                             const std::string& started_with) {
    std::error_code missing;
    if (!std::filesystem::exists(file, missing)) {
        return {};
    }
    try {
        SqliteDatabase database(file);
        auto select = database.prepare("SELECT scene FROM shown WHERE started_with=?");
        select.bind(1, started_with);
        return select.step() ? std::string(select.bytes(0)) : std::string();
    } catch (const SqliteError&) {
        return {};  // whoever opens it to write says what is wrong with it
    }
}

std::vector<KeyedNote> SessionJournal::keyed_notes() {
    try {
        return raybundle::keyed_notes(*database_, session_);
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
}

std::uint32_t SessionJournal::new_number(NoteKind kind, std::uint32_t free) {
    try {
        // Keys know of notes, too, that went before numbers were kept.
        auto select = database_->prepare(
            "SELECT max(last) FROM (SELECT last FROM note_number WHERE session=?1 AND kind=?2"
            " UNION ALL SELECT max(number) FROM note_key WHERE session=?1 AND kind=?2)");
        select.bind(1, session_);
        select.bind(2, static_cast<std::int64_t>(kind));
        const std::int64_t last = select.step() ? select.integer(0) : 0;
        return std::max(free, static_cast<std::uint32_t>(last) + 1);
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
}

/// So that no later note gets the number, also where this one is removed.
void SessionJournal::keep_number(NoteKind kind, std::uint32_t number) {
    auto insert = database_->prepare(
        "INSERT INTO note_number VALUES(?, ?, ?)"
        " ON CONFLICT(session, kind) DO UPDATE SET last=max(last, excluded.last)");
    insert.bind(1, session_);
    insert.bind(2, static_cast<std::int64_t>(kind));
    insert.bind(3, std::int64_t{number});
    insert.run();
}

Appended SessionJournal::keep_note(NoteKind kind, std::uint32_t number, const std::string& body,
                                   const std::string& key) {
    try {
        SqliteTransaction transaction(*database_);
        auto insert = database_->prepare("INSERT OR REPLACE INTO note VALUES(?, ?, ?, ?)");
        insert.bind(1, session_);
        insert.bind(2, static_cast<std::int64_t>(kind));
        insert.bind(3, std::int64_t{number});
        insert.bind_blob(4, body);
        insert.run();
        keep_number(kind, number);
        if (!key.empty()) {
            keep_note_key(*database_, session_, {key, kind, number});
        }
        transaction.commit();
        return Appended::yes;
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
}

void SessionJournal::drop_note(NoteKind kind, std::uint32_t number) {
    try {
        auto remove =
            database_->prepare("DELETE FROM note WHERE session=? AND kind=? AND number=?");
        remove.bind(1, session_);
        remove.bind(2, static_cast<std::int64_t>(kind));
        remove.bind(3, std::int64_t{number});
        remove.run();
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
}

std::vector<std::string> SessionJournal::notes(NoteKind kind) {
    std::vector<std::string> result;
    try {
        auto select =
            database_->prepare("SELECT body FROM note WHERE session=? AND kind=? ORDER BY number");
        select.bind(1, session_);
        select.bind(2, static_cast<std::int64_t>(kind));
        while (select.step()) {
            result.push_back(select.bytes(0));
        }
    } catch (const SqliteError& error) {
        throw JournalError(file_ + ": " + error.what());
    }
    return result;
}

std::optional<std::string> file_digest(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        return std::nullopt;
    }
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                          &EVP_MD_CTX_free);
    EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
    std::vector<char> piece(1U << 16U);
    while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())),
           stream.gcount() > 0) {
        EVP_DigestUpdate(context.get(), piece.data(), static_cast<std::size_t>(stream.gcount()));
    }
    std::array<unsigned char, 32> digest{};
    EVP_DigestFinal_ex(context.get(), digest.data(), nullptr);
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const unsigned byte : digest) {
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

}  // namespace raybundle
