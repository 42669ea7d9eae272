// SPDX-License-Identifier: Apache-2.0
#include "journal/sqlite_database.h"

#include <sqlite3.h>

namespace raybundle {
namespace {

void check(sqlite3* database, int result) {
    if (result == SQLITE_OK || result == SQLITE_ROW || result == SQLITE_DONE) {
        return;
    }
    const int kind = result & 0xFF;
    throw SqliteError(database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(result),
                      kind == SQLITE_CORRUPT || kind == SQLITE_NOTADB);
}

}  // namespace

void SqliteStatement::Finalizer::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

void SqliteDatabase::Closer::operator()(sqlite3* database) const {
    sqlite3_close(database);
}

SqliteStatement::SqliteStatement(sqlite3* database, std::string_view sql) : database_(database) {
    sqlite3_stmt* statement = nullptr;
    const int result =
        sqlite3_prepare_v2(database, sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
    statement_.reset(statement);
    check(database, result);
}

void SqliteStatement::bind(int parameter, std::int64_t value) {
    check(database_, sqlite3_bind_int64(statement_.get(), parameter, value));
}

void SqliteStatement::bind(int parameter, std::string_view text) {
    check(database_, sqlite3_bind_text(statement_.get(), parameter, text.data(),
                                       static_cast<int>(text.size()), SQLITE_TRANSIENT));
}

void SqliteStatement::bind_blob(int parameter, std::string_view bytes) {
    check(database_, sqlite3_bind_blob(statement_.get(), parameter, bytes.data(),
                                       static_cast<int>(bytes.size()), SQLITE_TRANSIENT));
}

bool SqliteStatement::step() {
    const int result = sqlite3_step(statement_.get());
    check(database_, result);
    return result == SQLITE_ROW;
}

void SqliteStatement::run() {
    while (step()) {
    }
}

std::int64_t SqliteStatement::integer(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteStatement::bytes(int column) const {
    const void* const data = sqlite3_column_blob(statement_.get(), column);
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return data == nullptr
               ? std::string()
               : std::string(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

SqliteDatabase::SqliteDatabase(const std::string& file) {
    sqlite3* database = nullptr;
    const int result =
        sqlite3_open_v2(file.c_str(), &database,
                        SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
    database_.reset(database);
    check(database, result);
    sqlite3_extended_result_codes(database, 1);
}

void SqliteDatabase::execute(const std::string& sql) {
    check(database_.get(), sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr));
}

SqliteTransaction::~SqliteTransaction() {
    if (open_) {
        try {
            database_.execute("ROLLBACK");
        } catch (const SqliteError&) {
            open_ = false;  // SQLite has rolled back by itself, as it does on a full disk
        }
    }
}

void SqliteTransaction::commit() {
    database_.execute("COMMIT");
    open_ = false;
}

}  // namespace raybundle
