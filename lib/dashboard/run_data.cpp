#include "dashboard/run_data.hpp"

#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "base/result.hpp"
#include "runtime/bus.hpp"

namespace nacre::dashboard {
namespace {

/// Whether a file was changed within the last seconds.
bool is_young(const std::filesystem::path& file) {
  constexpr std::int64_t kYoung_us = 10'000'000;
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 &&
         runtime::now_utime() - 1'000'000 * static_cast<std::int64_t>(status.st_mtim.tv_sec) < kYoung_us;
}

/// The first copy of the header of SQLite's WAL index (sqlite.org/walformat.html), which every write changes.
std::string wal_index_header(const std::filesystem::path& database) {
  std::string header(48, '\0');
  std::ifstream(database.string() + "-shm", std::ios::binary).read(header.data(), std::ssize(header));
  return header;
}

}  // namespace

std::string RunData::version() const {
  // Without SQLite. Times of files are not enough: two writes within a tick of the kernel's clock have the same.
  std::string version;
  struct stat status {};
  if (::stat(database_.c_str(), &status) == 0)
    version = fmt::format("{:x}-{:x}-{:x}", status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
  return fmt::format("{}.{:x}", version, std::hash<std::string>()(wal_index_header(database_)));
}

void RunData::refresh() {
  // The version is taken before reading, so that a write in between is read once more, never missed.
  const std::string now = version();
  if (now == read_version_ || !std::filesystem::exists(database_)) return;
  std::map<int, int> before;
  try {
    record_ = std::make_shared<const store::RunRecord>(store::read_run_record(database_, false));
    before = std::exchange(gamut_sizes_, store::read_gamut_sizes(database_));
  } catch (const InputError&) {
    if (read_version_.empty() && is_young(database_)) return;  // the analyser is still creating the file
    throw;
  }
  std::erase_if(gamuts_, [&](const auto& kept) {
    return !before.contains(kept.first) || before.at(kept.first) != gamut_sizes_[kept.first];
  });
  read_version_ = now;
}

std::shared_ptr<const store::RunRecord> RunData::record() {
  const std::lock_guard lock(mutex_);
  refresh();
  return record_;
}

std::map<int, int> RunData::gamut_sizes() {
  const std::lock_guard lock(mutex_);
  refresh();
  return gamut_sizes_;
}

std::shared_ptr<const store::RecordedGamut> RunData::gamut(int round) {
  constexpr std::size_t kMostKept = 16;
  const std::lock_guard lock(mutex_);
  refresh();
  if (!gamut_sizes_.contains(round)) return std::make_shared<const store::RecordedGamut>();
  auto& kept = gamuts_[round];
  if (!kept) kept = std::make_shared<const store::RecordedGamut>(store::read_gamut(database_, round));
  const auto gamut = kept;
  while (gamuts_.size() > kMostKept)
    gamuts_.erase(gamuts_.begin()->first == round ? std::prev(gamuts_.end()) : gamuts_.begin());
  return gamut;
}

}  // namespace nacre::dashboard
