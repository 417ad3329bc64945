#include "store/database_care.hpp"

#include <functional>
#include <optional>

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "store/row_checksum.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::store {

namespace fs = std::filesystem;

namespace {

constexpr int kBusyTimeoutMs = 30'000;

bool is_busy(const SQLite::Exception& error) {
  constexpr int kPrimary = 0xff;  // of a code that may be extended
  const int code = error.getErrorCode() & kPrimary;
  return code == SQLITE_BUSY || code == SQLITE_LOCKED;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError::format("{}: cannot be used as a database: {}", path.string(), reason);
}

SQLite::Database opened(const fs::path& path, int busy_timeout_ms = kBusyTimeoutMs) {
  SQLite::Database database(path.string(), SQLite::OPEN_READONLY, busy_timeout_ms);
  distrust(database);
  return database;
}

void expect_new(const fs::path& to) {
  if (fs::exists(to)) throw InputError::format("{}: exists already, expected a new file", to.string());
}

/// Throws InputError, SQLite::Exception.
void copy_pages(const fs::path& from, const fs::path& to) {
  SQLite::Database source = opened(from);
  SQLite::Database copy(to.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  SQLite::Backup backup(copy, source);
  // All pages in one step: a copy in several begins anew whenever somebody writes between.
  const int end = backup.executeStep(-1);
  if (end != SQLITE_DONE)  // a lock is no exception there, and no pages at all would pass for a whole database
    throw InputError::format("{}: could not be copied whole: {}; try again", from.string(), sqlite3_errstr(end));
}

/// The next row, where one can be read. What lies beyond a page that cannot is reached from the other end.
bool step(std::optional<SQLite::Statement>& query, SQLite::Database& from, const std::string& sql) {
  try {
    if (!query) query.emplace(from, sql);
    return query->executeStep();
  } catch (const SQLite::Exception&) {
    return false;
  }
}

/// Rows of a query until they end or cannot be read; what `take` throws passes through.
void take_rows(SQLite::Database& from, const std::string& sql, const std::function<void(SQLite::Statement&)>& take) {
  for (std::optional<SQLite::Statement> query; step(query, from, sql);) take(*query);
}

/// Copies the rows that fit their checksum (the last column), first from one end, then from the other.
void salvage_table(SQLite::Database& from, SQLite::Database& to, const std::string& table,
                   const std::function<std::int64_t(SQLite::Statement&)>& checksum_of) {
  const int columns = table == "simulation" ? 8 : 3;
  std::string places = "?";
  for (int i = 1; i < columns; ++i) places += ",?";
  SQLite::Statement insertion(to, "INSERT OR IGNORE INTO " + table + " VALUES (" + places + ")");
  for (const char* direction : {"ASC", "DESC"}) {
    take_rows(from, fmt::format("SELECT * FROM {} ORDER BY key {}", table, direction), [&](SQLite::Statement& row) {
      if (checksum_of(row) != row.getColumn(columns - 1).getInt64()) return;
      insertion.reset();
      for (int i = 0; i < columns; ++i) {
        const SQLite::Column value = row.getColumn(i);
        if (value.isFloat()) insertion.bind(i + 1, value.getDouble());
        if (value.isInteger()) insertion.bind(i + 1, value.getInt64());
        if (value.isText()) insertion.bind(i + 1, value.getString());
        // A null pointer would be stored as NULL, not as an empty blob.
        if (value.isBlob()) insertion.bind(i + 1, value.getBytes() > 0 ? value.getBlob() : "", value.getBytes());
      }
      insertion.exec();
    });
  }
}

}  // namespace

void distrust(SQLite::Database& database) {
  constexpr int kLongestValue = 64 << 20;
  sqlite3_limit(database.getHandle(), SQLITE_LIMIT_LENGTH, kLongestValue);
  database.exec("PRAGMA trusted_schema = OFF");
  database.exec("PRAGMA cell_size_check = ON");
  const int strange =
      database
          .execAndGet(
              "SELECT count(*) FROM sqlite_schema WHERE type NOT IN ('table', 'index', 'view') OR "
              "type = 'view' AND name NOT IN "
              "('rounds', 'specimens', 'designs', 'gamut', 'fronts', 'effects') OR "
              "type = 'table' AND (sql LIKE '%VIRTUAL%' OR sql LIKE '%GENERATED%' OR sql LIKE '% AS (%')")
          .getInt();
  if (strange != 0) throw SQLite::Exception("it holds views, triggers or computed columns that nacre does not make");
}

Result<void> check_database(const fs::path& path, int busy_timeout_ms) {
  if (!fs::exists(path)) return fail("{}: there is no such file", path.string());
  try {
    SQLite::Database database = opened(path, busy_timeout_ms);
    const std::string verdict = database.execAndGet("PRAGMA integrity_check(1)").getString();
    if (verdict != "ok") return fail("{}: is damaged: {}", path.string(), verdict);
    return {};
  } catch (const SQLite::Exception& error) {
    if (is_busy(error)) {
      throw DatabaseUnavailable(fmt::format(
          "{}: is in use: another program has been writing it for long ({}). Wait for it, or end it; the file "
          "is sound",
          path.string(), error.what()));
    }
    return fail("{}: is damaged or no database: {}", path.string(), error.what());
  }
}

int schema_version(const fs::path& path) {
  try {
    return opened(path).execAndGet("PRAGMA user_version").getInt();
  } catch (const SQLite::Exception& error) {
    refuse(path, error.what());
  }
}

void remove_database(const fs::path& path) {
  std::error_code ignored;
  for (const char* companion : {"", "-wal", "-shm"}) fs::remove(path.string() + companion, ignored);
}

void copy_database(const fs::path& from, const fs::path& to) {
  expect_new(to);
  const fs::path aside = to.string() + ".part";
  remove_database(aside);
  remove_database(to);  // a log of a file that is gone would be played into the copy by whoever opens it first
  try {
    copy_pages(from, aside);
    // The copy says WAL like its source; alone it is whole without a -wal file.
    if (const auto whole = check_database(aside); !whole) refuse(from, whole.error().message);
    fs::rename(aside, to);
  } catch (const SQLite::Exception& error) {
    remove_database(aside);
    refuse(from, error.what());
  } catch (...) {
    remove_database(aside);
    throw;
  }
  remove_database(aside);  // companions that looking at it made
}

fs::path move_aside(const fs::path& path) {
  fs::path aside = path.string() + ".damaged";
  for (int i = 2; fs::exists(aside); ++i) aside = fmt::format("{}.damaged-{}", path.string(), i);
  std::error_code problem;
  fs::rename(path, aside, problem);
  if (problem) throw InputError::format("{}: cannot be moved aside: {}", path.string(), problem.message());
  for (const char* companion : {"-wal", "-shm"})
    fs::rename(path.string() + companion, aside.string() + companion, problem);
  return aside;
}

Salvage salvage_simulations(const fs::path& from, const fs::path& to) {
  expect_new(to);
  return add_simulations(from, to);
}

Salvage add_simulations(const fs::path& from, const fs::path& to) {
  constexpr int kFirstWithChecksums = 3;
  if (const int version = schema_version(from); version < kFirstWithChecksums) {
    throw InputError::format(
        "{}: its rows carry no checksums (schema version {}): what can be read might be wrong. Move it "
        "away: the farm begins a new one",
        from.string(), version);
  }
  { const SimulationCache makes_the_tables(to); }
  try {
    SQLite::Database source = opened(from);
    SQLite::Database saved(to.string(), SQLite::OPEN_READWRITE, kBusyTimeoutMs);
    SQLite::Transaction transaction(saved, SQLite::TransactionBehavior::IMMEDIATE);
    salvage_table(source, saved, "simulation", checksum_of_simulation);
    salvage_table(source, saved, "breaks", [](SQLite::Statement& row) {
      return breaks_checksum(row.getColumn(0).getString(), bytes_in(row.getColumn(1)));
    });
    transaction.commit();
    return {saved.execAndGet("SELECT count(*) FROM simulation").getInt64(),
            saved.execAndGet("SELECT count(*) FROM breaks").getInt64()};
  } catch (const SQLite::Exception& error) {
    refuse(from, error.what());
  }
}

}  // namespace nacre::store
