// SPDX-License-Identifier: Apache-2.0
// Keys of requests in a journal's database, so that none is carried out twice.
#pragma once

#include <cstdint>
#include <vector>

#include "journal/project_log.h"
#include "journal/sqlite_database.h"

namespace raybundle {

inline constexpr std::uint32_t most_request_keys = 16384;  ///< of all sessions of a file

void create_key_tables(SqliteDatabase& database);

/// Keeps the keys of the requests for a change, as part of the transaction that adds it, and
/// forgets those of changes that are `most_past` back. A key that has come before is of the last
/// change only. Throws SqliteError.
void keep_keys(SqliteDatabase& database, std::int64_t session, const v1::SceneChanged& change,
               const std::vector<RequestKey>& keys, std::uint32_t most_past);

/// In order of epochs. A change that cannot be read, or is only a part of what was asked for, has
/// its epoch only. Throws SqliteError.
std::vector<KeyedChange> keyed_changes(SqliteDatabase& database, std::int64_t session);

/// Keeps the key of the request for a note, as part of the transaction that keeps the note. Throws
/// SqliteError.
void keep_note_key(SqliteDatabase& database, std::int64_t session, const KeyedNote& note);

/// Newest last. Throws SqliteError.
std::vector<KeyedNote> keyed_notes(SqliteDatabase& database, std::int64_t session);

}  // namespace raybundle
