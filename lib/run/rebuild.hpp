#pragma once
// run.db and the analyser's journal: the database can always be made anew.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "run/run_database.hpp"

namespace nacre::run {

/// What a database was made anew from.
struct Rebuilt {
  std::int64_t messages = 0;
  std::int64_t unread = 0;      ///< further ones, of another version of nacre
  std::int64_t torn_bytes = 0;  ///< of a record that was being written when the analyser ended
};

/// Makes RUN/run.db anew from RUN/nodes/analyser/journal.lcm; what stood there before is renamed to
/// run.db.damaged, unless it and the journal are whole. Nobody may be writing it. Throws InputError, and then leaves
/// everything as it was.
Rebuilt rebuild_run_database(const std::filesystem::path& run_dir);

/// Opens RUN/run.db. Where a journal tells that messages were kept before and the file is missing, damaged or of
/// another version, it is made anew first, which `report` is told. Throws InputError.
std::unique_ptr<RunDatabase> open_run_database(const std::filesystem::path& run_dir,
                                               const std::function<void(const std::string&)>& report);

}  // namespace nacre::run
