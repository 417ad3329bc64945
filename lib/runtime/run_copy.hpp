#pragma once
// A copy of a run's folder, also while its nodes write, that can be resumed.

#include <cstdint>
#include <filesystem>
#include <functional>

namespace nacre::runtime {

/// What was copied.
struct RunCopy {
  int files = 0;
  int journals = 0;
  std::int64_t bytes = 0;
};

/// Copies RUN to the new folder `to`, which can be resumed like any run. Journals are copied up to their last whole
/// record and begin a new identity in the copy: nodes are copied one after the other, so one may have acknowledged to
/// another what its own copy does not hold yet, and a new identity makes everybody offer it again. Journals come first,
/// databases (by `copy_database`) last, so that a database holds at least what its node's journal calls done. Locks,
/// unfinished files and tasks of a cluster are left out. `to` is there whole or not at all. Throws InputError: `to`
/// exists, a file cannot be read or written.
RunCopy copy_run(
    const std::filesystem::path& run, const std::filesystem::path& to,
    const std::function<void(const std::filesystem::path& from, const std::filesystem::path& to)>& copy_database);

}  // namespace nacre::runtime
