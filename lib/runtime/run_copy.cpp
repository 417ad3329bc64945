#include "runtime/run_copy.hpp"

#include <unistd.h>

#include <string>
#include <vector>

#include "base/file_aside.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "runtime/bus.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"

namespace nacre::runtime {

namespace fs = std::filesystem;

namespace {

/// A journal up to its last whole record, with a new identity.
void copy_journal(const fs::path& from, const fs::path& to) {
  LogReader reader(from);
  LogWriter writer(to);
  Result<void> written;
  const auto add = [&](std::int64_t utime, std::string_view channel, std::string_view data) {
    written = writer.append(utime, channel, data);
    if (!written) throw InputError(written.error().message);
  };
  while (const auto record = reader.next()) add(record->utime, record->channel, record->data);
  add(now_utime(), kJournalChannel, pack({std::to_string(now_utime())}));
  if (written = writer.flush(); written) written = writer.sync();
  if (!written) throw InputError(written.error().message);
}

void copy_plain_file(const fs::path& from, const fs::path& to) {
  std::error_code problem;
  fs::copy_file(from, to, problem);
  if (problem)
    throw InputError::format("{}: cannot be copied to {}: {}", from.string(), to.string(), problem.message());
}

enum class Kind { journal, database, file, none };

Kind kind_of(const fs::path& relative) {
  const std::string name = relative.filename().string(), extension = relative.extension().string();
  const bool is_of_cluster = relative.begin() != relative.end() && *relative.begin() == "slurm";
  if (is_of_cluster || name == "lock" || name == "launcher.lock" || extension == ".part" || name.ends_with(".db-wal") ||
      name.ends_with(".db-shm")) {
    return Kind::none;
  }
  if (name == "journal.lcm") return Kind::journal;
  return extension == ".db" ? Kind::database : Kind::file;
}

using CopyDatabase = std::function<void(const fs::path& from, const fs::path& to)>;

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && !entry.is_symlink()) files.push_back(fs::relative(entry.path(), folder));
  }
  return files;
}

RunCopy copy_files(const fs::path& run, const fs::path& to, const CopyDatabase& copy_database) {
  const std::vector<fs::path> files = files_below(run);
  RunCopy copy;
  for (const Kind kind : {Kind::journal, Kind::file, Kind::database}) {
    for (const fs::path& file : files) {
      if (kind_of(file) != kind || !fs::exists(run / file)) continue;  // a file that was replaced meanwhile
      make_folder((to / file).parent_path());
      if (kind == Kind::journal) {
        copy_journal(run / file, to / file);
      } else if (kind == Kind::database) {
        copy_database(run / file, to / file);
      } else {
        copy_plain_file(run / file, to / file);
      }
      ++copy.files;
      copy.journals += kind == Kind::journal;
      copy.bytes += fs::file_size(to / file);
    }
  }
  return copy;
}

}  // namespace

RunCopy copy_run(const fs::path& run, const fs::path& to, const CopyDatabase& copy_database) {
  if (fs::exists(to)) throw InputError::format("{}: exists already, expected a new folder", to.string());
  const fs::path aside = name_aside(to);
  try {
    const RunCopy copy = copy_files(run, aside, copy_database);
    ::sync();  // a copy that a power cut takes is none
    fs::rename(aside, to);
    sync_folder(fs::absolute(to).parent_path());
    return copy;
  } catch (...) {
    std::error_code left_behind;
    fs::remove_all(aside, left_behind);
    throw;
  }
}

}  // namespace nacre::runtime
