#pragma once
// logs/RUN/run.db, written: the messages of a run, with views for any SQLite tool. It can always be made anew from the
// analyser's journal (rebuild.hpp). Written by the analyser alone, read by Run.

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

namespace SQLite {
class Database;
}

namespace nacre::run {

class RunDatabase {
 public:
  /// Opens or creates the file. Throws InputError with a sentence that names the file and how to mend it; here and
  /// below NoSpace on a full disk.
  explicit RunDatabase(const std::filesystem::path& path);
  ~RunDatabase();

  /// Takes one message of the run (payload without header). The same message twice changes nothing; payloads that do
  /// not decode are ignored. Throws InputError when the file cannot be written.
  void keep(const std::string& channel, const std::string& payload);

  /// Moves everything into the one file, so that a copy of it alone is whole.
  void checkpoint();

 private:
  std::filesystem::path path_;
  std::mutex mutex_;
  std::unique_ptr<SQLite::Database> database_;
};

}  // namespace nacre::run
