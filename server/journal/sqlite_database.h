// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace raybundle {

/// SQLite has refused something. `corrupt`: the file is no database, or a damaged one.
class SqliteError : public std::runtime_error {
  public:
    SqliteError(const std::string& text, bool is_corrupt)
        : std::runtime_error(text), corrupt(is_corrupt) {}
    const bool corrupt;
};

/// One statement; parameters count from 1, columns from 0.
class SqliteStatement {
  public:
    SqliteStatement(sqlite3* database, std::string_view sql);

    void bind(int parameter, std::int64_t value);
    void bind(int parameter, std::string_view text);
    void bind_blob(int parameter, std::string_view bytes);

    /// True: a row can be read. Throws SqliteError.
    bool step();
    void run();  ///< for statements without rows

    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] std::string bytes(int column) const;  ///< of a text or blob

  private:
    struct Finalizer {
        void operator()(sqlite3_stmt* statement) const;
    };
    sqlite3* database_;
    std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
};

/// A SQLite database file.
class SqliteDatabase {
  public:
    /// Opens or creates. Throws SqliteError.
    explicit SqliteDatabase(const std::string& file);

    void execute(const std::string& sql);
    SqliteStatement prepare(std::string_view sql) { return {database_.get(), sql}; }

  private:
    struct Closer {
        void operator()(sqlite3* database) const;
    };
    std::unique_ptr<sqlite3, Closer> database_;
};

/// A transaction that is undone unless commit() is reached.
class SqliteTransaction {
  public:
    explicit SqliteTransaction(SqliteDatabase& database) : database_(database) {
        database_.execute("BEGIN IMMEDIATE");
    }
    ~SqliteTransaction();
    SqliteTransaction(const SqliteTransaction&) = delete;
    SqliteTransaction& operator=(const SqliteTransaction&) = delete;

    void commit();

  private:
    SqliteDatabase& database_;
    bool open_ = true;
};

}  // namespace raybundle
