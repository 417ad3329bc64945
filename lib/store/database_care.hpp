#pragma once
// What every SQLite file of nacre needs: is it whole, a copy of it while others write, and what can still be read of a
// damaged one.

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "base/result.hpp"

namespace SQLite {
class Database;
}

namespace nacre::store {

/// The file cannot be used now and may be later, as it is: another program writes it, its disk is full. Nothing is to
/// be rebuilt or moved away.
class DatabaseUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// To be called on every file that is opened: it may come from elsewhere. Its schema is not trusted to call functions,
/// values are at most 64 MiB, and triggers, virtual tables, generated columns and views, which could run for ever, are
/// refused, but for views with the names of those in run.db, which are for people: no program of ours asks them. Throws
/// SQLite::Exception.
void distrust(SQLite::Database& database);

/// Reads every page of a database and every entry of its indices, without changing it. The error says what is wrong: no
/// such file, no database, damaged. Throws DatabaseUnavailable where another program keeps it to itself for longer than
/// `busy_timeout_ms`.
Result<void> check_database(const std::filesystem::path& path, int busy_timeout_ms = 30'000);

/// PRAGMA user_version: which of our schemas the file has. Throws InputError when it cannot be read.
int schema_version(const std::filesystem::path& path);

/// Removes a database with its -wal and -shm, whichever of them there are.
void remove_database(const std::filesystem::path& path);

/// Writes the database as it is at one moment to `to` while others go on using it. Throws InputError, as where `to`
/// exists; nothing is left at `to` then.
void copy_database(const std::filesystem::path& from, const std::filesystem::path& to);

/// Renames a damaged file, with its -wal and -shm, to FILE.damaged, FILE.damaged-2 ... and returns the new name. Throws
/// InputError.
std::filesystem::path move_aside(const std::filesystem::path& path);

/// What a cache of simulations holds that was saved of another.
struct Salvage {
  std::int64_t simulations = 0;
  std::int64_t breaks = 0;
};

/// Copies every row that can still be read of a cache of simulations to a new cache. Throws InputError when `from` is
/// no database at all or `to` exists; an empty cache may be left at `to` then.
Salvage salvage_simulations(const std::filesystem::path& from, const std::filesystem::path& to);

/// Adds to the cache `to`, which is made where there is none and may be in use, what `from` knows beyond it. Throws
/// InputError; `to` holds what it held then, or nothing yet.
Salvage add_simulations(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace nacre::store
