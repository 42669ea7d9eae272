// SPDX-License-Identifier: Apache-2.0
#include "journal/request_keys.h"

#include <algorithm>
#include <string>

namespace raybundle {
namespace {

void keep_change(SqliteDatabase& database, std::int64_t session, const v1::SceneChanged& change) {
    auto insert = database.prepare("INSERT OR REPLACE INTO keyed VALUES(?, ?, ?)");
    insert.bind(1, session);
    insert.bind(2, std::int64_t{change.epoch()});
    insert.bind_blob(3, change.SerializeAsString());
    insert.run();
}

void keep_key(SqliteDatabase& database, std::int64_t session, std::uint32_t epoch,
              const RequestKey& key) {
    auto insert = database.prepare(
        "INSERT OR REPLACE INTO request_key(session, text, epoch, part, parts)"
        " VALUES(?, ?, ?, ?, ?)");
    insert.bind(1, session);
    insert.bind(2, key.text);
    insert.bind(3, std::int64_t{epoch});
    insert.bind(4, std::int64_t{key.part});
    insert.bind(5, std::int64_t{key.parts});
    insert.run();
}

void forget(SqliteDatabase& database, std::int64_t session, std::int64_t epoch) {
    for (const char* old : {"DELETE FROM request_key WHERE session=? AND epoch<=?",
                            "DELETE FROM keyed WHERE session=? AND epoch<=?"}) {
        auto remove = database.prepare(old);
        remove.bind(1, session);
        remove.bind(2, epoch);
        remove.run();
    }
}

}  // namespace

void create_key_tables(SqliteDatabase& database) {
    database.execute(
        // number: counts up
        "CREATE TABLE IF NOT EXISTS request_key(number INTEGER PRIMARY KEY,"
        " session INTEGER NOT NULL REFERENCES session(id), text TEXT NOT NULL,"
        " epoch INTEGER NOT NULL, part INTEGER NOT NULL, parts INTEGER NOT NULL,"
        " UNIQUE(session, text));"
        "CREATE INDEX IF NOT EXISTS request_key_epoch ON request_key(session, epoch);"
        // body: serialised SceneChanged
        "CREATE TABLE IF NOT EXISTS keyed(session INTEGER NOT NULL REFERENCES session(id),"
        " epoch INTEGER NOT NULL, body BLOB NOT NULL, PRIMARY KEY(session, epoch)) WITHOUT ROWID;"
        // position: counts up
        "CREATE TABLE IF NOT EXISTS note_key(position INTEGER PRIMARY KEY,"
        " session INTEGER NOT NULL REFERENCES session(id), text TEXT NOT NULL,"
        " kind INTEGER NOT NULL, number INTEGER NOT NULL, UNIQUE(session, text))");
}

void keep_keys(SqliteDatabase& database, std::int64_t session, const v1::SceneChanged& change,
               const std::vector<RequestKey>& keys, std::uint32_t most_past) {
    for (const RequestKey& key : keys) {
        keep_key(database, session, change.epoch(), key);
    }
    if (std::any_of(keys.begin(), keys.end(), [](const auto& key) { return key.parts == 0; })) {
        keep_change(database, session, change);
    }
    if (!keys.empty()) {
        auto most = database.prepare(
            "DELETE FROM request_key WHERE number<=(SELECT max(number) FROM request_key)-?");
        most.bind(1, std::int64_t{most_request_keys});
        most.run();
    }
    forget(database, session, std::int64_t{change.epoch()} - std::int64_t{most_past});
}

std::vector<KeyedChange> keyed_changes(SqliteDatabase& database, std::int64_t session) {
    auto select = database.prepare(
        "SELECT k.epoch, k.text, k.part, k.parts, keyed.body, past.body FROM request_key AS k"
        " LEFT JOIN keyed ON keyed.session=k.session AND keyed.epoch=k.epoch"
        " LEFT JOIN past ON past.session=k.session AND past.epoch=k.epoch"
        " WHERE k.session=? ORDER BY k.epoch, k.number");
    select.bind(1, session);
    std::vector<KeyedChange> result;
    while (select.step()) {
        const auto epoch = static_cast<std::uint32_t>(select.integer(0));
        if (result.empty() || result.back().change.epoch() != epoch) {
            KeyedChange& keyed = result.emplace_back();
            if (!keyed.change.ParseFromString(select.bytes(4)) ||
                !keyed.before.ParseFromString(select.bytes(5))) {
                keyed = {};
            }
            keyed.change.set_epoch(epoch);
        }
        result.back().keys.push_back({select.bytes(1),
                                      static_cast<std::uint32_t>(select.integer(2)),
                                      static_cast<std::uint32_t>(select.integer(3))});
    }
    return result;
}

void keep_note_key(SqliteDatabase& database, std::int64_t session, const KeyedNote& note) {
    auto insert = database.prepare(
        "INSERT OR REPLACE INTO note_key(session, text, kind, number) VALUES(?, ?, ?, ?)");
    insert.bind(1, session);
    insert.bind(2, note.key);
    insert.bind(3, static_cast<std::int64_t>(note.kind));
    insert.bind(4, std::int64_t{note.number});
    insert.run();
    auto most = database.prepare(
        "DELETE FROM note_key WHERE position<=(SELECT max(position) FROM note_key)-?");
    most.bind(1, std::int64_t{most_request_keys});
    most.run();
}

std::vector<KeyedNote> keyed_notes(SqliteDatabase& database, std::int64_t session) {
    auto select = database.prepare(
        "SELECT text, kind, number FROM note_key WHERE session=? ORDER BY position");
    select.bind(1, session);
    std::vector<KeyedNote> result;
    while (select.step()) {
        result.push_back({std::string(select.bytes(0)), static_cast<NoteKind>(select.integer(1)),
                          static_cast<std::uint32_t>(select.integer(2))});
    }
    return result;
}

}  // namespace raybundle
