#include "run/run.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <iterator>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "base/result.hpp"
#include "game/scenario.hpp"
#include "run/run_schema.hpp"
#include "runtime/bus.hpp"
#include "store/database_care.hpp"

namespace nacre::run {
namespace {

/// Whether a file was changed within the last seconds.
bool is_young(const std::filesystem::path& file) {
  constexpr std::int64_t kYoung_us = 10'000'000;
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 &&
         runtime::now_utime() - 1'000'000 * static_cast<std::int64_t>(status.st_mtim.tv_sec) < kYoung_us;
}

std::uint64_t inode_of(const std::filesystem::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_ino : 0;
}

/// What `read` makes of the file, opened read-only.
template <class Read>
auto read_from(const std::filesystem::path& path, const Read& read) {
  try {
    SQLite::Database db(path.string(), SQLite::OPEN_READONLY, 10'000);
    store::distrust(db);
    if (const int version = db.execAndGet("PRAGMA user_version").getInt(); version != kRunSchemaVersion)
      throw InputError::format(
          "{}: has schema version {}, this program reads {}: `nacre rebuild` makes it anew from the analyser's journal",
          path.string(), version, kRunSchemaVersion);
    return read(db);
  } catch (const SQLite::Exception& error) {
    throw InputError::format("{}: cannot be read: {}", path.string(), error.what());
  }
}

std::string bytes_of(const SQLite::Column& blob) {
  return {static_cast<const char*>(blob.getBlob()), static_cast<std::size_t>(blob.getBytes())};
}

/// By key, each pattern once: of two samples of one pattern the later stands.
Gamut sorted(std::vector<explore::Evaluated> samples) {
  std::ranges::stable_sort(samples, {}, [](const explore::Evaluated& each) { return each.pattern.bits(); });
  Gamut gamut;
  for (const explore::Evaluated& sample : samples) {
    if (!gamut.patterns.empty() && gamut.patterns.back() == sample.pattern.bits()) {
      gamut.performances.back() = sample.performance;
      continue;
    }
    gamut.patterns.push_back(sample.pattern.bits());
    gamut.performances.push_back(sample.performance);
  }
  return gamut;
}

template <class Chunk>
Gamut read_gamut(const std::filesystem::path& database, const std::vector<std::int64_t>& ids) {
  return read_from(database, [&](SQLite::Database& db) {
    std::vector<explore::Evaluated> samples;
    SQLite::Statement query(db, "SELECT payload FROM messages WHERE id = ?");
    for (const std::int64_t id : ids) {
      query.reset();
      query.bind(1, id);
      if (!query.executeStep()) continue;
      if (const auto chunk = wire::read<Chunk>(bytes_of(query.getColumn(0))))
        samples.insert(samples.end(), chunk->samples.begin(), chunk->samples.end());
    }
    return sorted(std::move(samples));
  });
}

/// Whether the game of a folder is diagnosed: true where its scenario cannot be read.
bool is_diagnosed(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "scenario.toml";
  try {
    return !std::filesystem::exists(file) || game::read_scenario(file).diagnosis.enabled;
  } catch (const InputError&) {
    return true;  // of another version: whoever plays it says what is wrong
  }
}

}  // namespace

Run::Run(const std::filesystem::path& folder, const std::string& database)
    : database_(folder / database), is_diagnosed_(is_diagnosed(folder)) {}

Run::~Run() = default;

std::string Run::version() {
  const std::lock_guard lock(mutex_);
  return version_now();
}

/// Asks SQLite alone: a process that opened the files by other means would lose its locks when it closed them
/// (sqlite.org/howtocorrupt.html, 2.2), and the analyser, which reads its own run for the report, is the writer.
std::string Run::version_now() {
  const std::uint64_t file = inode_of(database_);
  if (file == 0) return {};
  try {
    if (!watching_ || watched_ != file) {
      watched_ = file;
      watching_ = std::make_unique<SQLite::Database>(database_.string(), SQLite::OPEN_READONLY, 10'000);
      store::distrust(*watching_);
      ++watches_;
    }
    const std::int64_t writes = watching_->execAndGet("PRAGMA data_version").getInt64();
    return fmt::format("{:x}-{}-{}", file, watches_, writes);
  } catch (const SQLite::Exception& error) {
    watching_.reset();
    return fmt::format("{:x} {}", file, error.what());
  }
}

void Run::read_new_messages() {
  const std::uint64_t file = inode_of(database_);
  if (file != std::exchange(file_, file)) {  // made anew
    last_id_ = 0;
    recording_ = {};
    gamuts_.clear();
    variants_.clear();
  }
  read_from(database_, [&](SQLite::Database& db) {
    SQLite::Statement query(db, "SELECT id, channel, payload FROM messages WHERE id > ? ORDER BY id");
    query.bind(1, last_id_);
    while (query.executeStep()) {
      last_id_ = query.getColumn(0).getInt64();
      recording_.take(last_id_, query.getColumn(1).getString(), bytes_of(query.getColumn(2)));
    }
  });
}

void Run::refresh() {
  // The version is taken before reading, so that a write in between is read once more, never missed.
  const std::string now = version_now();
  if (now == read_version_ || !std::filesystem::exists(database_)) return;
  try {
    read_new_messages();
  } catch (const InputError&) {
    if (read_version_.empty() && is_young(database_)) return;  // the analyser is still creating the file
    throw;
  }
  auto record = std::make_shared<RunRecord>(recording_.record());
  record->is_diagnosed = is_diagnosed_;
  record_ = std::move(record);
  read_version_ = now;
}

std::shared_ptr<const RunRecord> Run::record() {
  const std::lock_guard lock(mutex_);
  refresh();
  return record_;
}

template <class Chunk>
std::shared_ptr<const Gamut> Run::kept_gamut(std::map<int, Kept>& kept, int number, const Ids& ids) {
  constexpr std::size_t kMostKept = 16;
  if (ids.empty()) return std::make_shared<const Gamut>();
  Kept& known = kept[number];
  if (known.ids != ids) known = {ids, std::make_shared<const Gamut>(read_gamut<Chunk>(database_, ids))};
  const auto gamut = known.gamut;
  while (kept.size() > kMostKept) kept.erase(kept.begin()->first == number ? std::prev(kept.end()) : kept.begin());
  return gamut;
}

std::shared_ptr<const Gamut> Run::gamut(int round) {
  const std::lock_guard lock(mutex_);
  refresh();
  return kept_gamut<wire::GamutChunk>(gamuts_, round, recording_.gamut_messages(round));
}

std::shared_ptr<const Gamut> Run::variants(int family) {
  const std::lock_guard lock(mutex_);
  refresh();
  return kept_gamut<wire::FamilyGamut>(variants_, family, recording_.variant_messages(family));
}

RunRecord Run::record_with_gamuts(const std::optional<std::set<int>>& rounds) {
  RunRecord record = *this->record();
  for (auto& [number, round] : record.rounds)
    if (!rounds || rounds->contains(number)) round.gamut = gamut(number);
  for (FamilyRecord& family : record.families) family.gamut = variants(family.stated.number);
  return record;
}

std::vector<std::string> Run::payloads(const std::string& channel, std::optional<int> round) {
  return read_from(database_, [&](SQLite::Database& db) {
    std::vector<std::string> payloads;
    SQLite::Statement query(
        db, "SELECT payload FROM messages WHERE channel = ?1 AND (?2 IS NULL OR round = ?2) ORDER BY id");
    query.bind(1, channel);
    if (round) query.bind(2, *round);
    while (query.executeStep()) payloads.push_back(bytes_of(query.getColumn(0)));
    return payloads;
  });
}

}  // namespace nacre::run
