#include "store/simulation_cache.hpp"

#include <cstring>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "store/row_checksum.hpp"

namespace nacre::store {
namespace {

constexpr const char* kSchema = R"sql(
  CREATE TABLE simulation (
    key            TEXT PRIMARY KEY,
    failure        TEXT NOT NULL,
    modulus_pa     REAL NOT NULL,
    toughness_pa   REAL NOT NULL,
    peak_stress_pa REAL NOT NULL,
    failure_strain REAL NOT NULL,
    curve          BLOB NOT NULL,
    checksum       INTEGER NOT NULL
  ) STRICT, WITHOUT ROWID;
)sql";
// Version 2: elements that failed, for simulations whose crack was asked for; pairs of int32 and float32.
constexpr const char* kBreakSchema = R"sql(
  CREATE TABLE breaks (key TEXT PRIMARY KEY, pairs BLOB NOT NULL, checksum INTEGER NOT NULL) STRICT, WITHOUT ROWID;
)sql";
// Version 3: a checksum per row (row_checksum.hpp).
constexpr const char* kBreakSchemaOfVersion2 = R"sql(
  CREATE TABLE breaks (key TEXT PRIMARY KEY, pairs BLOB NOT NULL) STRICT, WITHOUT ROWID;
)sql";

[[noreturn]] void refuse_cache(const std::filesystem::path& path, const std::string& reason) {
  throw InputError::format(
      "the simulation cache {} cannot be used: {}. `nacre rebuild --cache {}` saves what is sound. Nothing else "
      "depends on it: or move the file (and its -wal and -shm companions) away and start again, and the simulations "
      "are done anew",
      path.string(), reason, shell_word(path));
}

[[noreturn]] void refuse_cache(const std::filesystem::path& path, const SQLite::Exception& error) {
  constexpr int kPrimary = 0xff;  // of a code that may be extended
  switch (error.getErrorCode() & kPrimary) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw DatabaseUnavailable(
          fmt::format("the simulation cache {} is in use: another program has been writing it for long ({}). Wait for "
                      "it, or end it; the file is sound",
                      path.string(), error.what()));
    case SQLITE_FULL:
    case SQLITE_IOERR:
      throw DatabaseUnavailable(
          fmt::format("the simulation cache {} cannot be read or written: {}. Make room on its disk and start again; "
                      "nothing that it holds is lost",
                      path.string(), error.what()));
    default:
      refuse_cache(path, error.what());
  }
}

// Runs `body` and turns SQLite's exceptions into a sentence.
template <class Body>
auto guarded(const std::filesystem::path& path, const Body& body) {
  try {
    return body();
  } catch (const SQLite::Exception& error) {
    refuse_cache(path, error);
  }
}

void add_checksums(SQLite::Database& database) {
  for (const char* table : {"simulation", "breaks"}) {
    database.exec(fmt::format("ALTER TABLE {} ADD COLUMN checksum INTEGER NOT NULL DEFAULT 0", table));
  }
  const auto each = [&](const char* select, const char* update, const auto& checksum) {
    SQLite::Statement rows(database, select), change(database, update);
    std::vector<std::pair<std::string, std::int64_t>> checksums;
    while (rows.executeStep()) checksums.emplace_back(rows.getColumn(0).getString(), checksum(rows));
    for (const auto& [key, value] : checksums) {
      change.reset();
      change.bind(1, value);
      change.bind(2, key);
      change.exec();
    }
  };
  each("SELECT key, failure, modulus_pa, toughness_pa, peak_stress_pa, failure_strain, curve FROM simulation",
       "UPDATE simulation SET checksum = ? WHERE key = ?", checksum_of_simulation);
  each("SELECT key, pairs FROM breaks", "UPDATE breaks SET checksum = ? WHERE key = ?", [](SQLite::Statement& row) {
    return breaks_checksum(row.getColumn(0).getString(), bytes_in(row.getColumn(1)));
  });
}

void prepare_schema(SQLite::Database& database, const std::filesystem::path& path) {
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  if (version == 0 && !database.tableExists("simulation")) {
    database.exec(kSchema);
    database.exec(kBreakSchema);
    database.exec("PRAGMA user_version = " + std::to_string(kCacheSchemaVersion));
  } else if (version == 1 || version == 2) {  // nothing that was simulated is lost
    if (version == 1) database.exec(kBreakSchemaOfVersion2);
    add_checksums(database);
    database.exec("PRAGMA user_version = " + std::to_string(kCacheSchemaVersion));
  } else if (version != kCacheSchemaVersion) {
    refuse_cache(path, "it has schema version " + std::to_string(version) + ", this program expects " +
                           std::to_string(kCacheSchemaVersion));
  }
  transaction.commit();
}

std::vector<float> pack_curve(const tester::Curve& curve) {
  std::vector<float> pairs;
  pairs.reserve(2 * curve.size());
  for (std::size_t point = 0; point < curve.size(); ++point) {
    pairs.push_back(static_cast<float>(curve.strain[point]));
    pairs.push_back(static_cast<float>(curve.stress_pa[point]));
  }
  return pairs;
}

/// An element that failed, as it lies in the file.
struct PackedBreak {
  std::int32_t element;
  float strain;
};
static_assert(sizeof(PackedBreak) == 8);

tester::Curve unpack_curve(const void* bytes, int size) {
  std::vector<float> pairs(static_cast<std::size_t>(size) / sizeof(float));
  if (!pairs.empty()) std::memcpy(pairs.data(), bytes, pairs.size() * sizeof(float));
  tester::Curve curve;
  for (std::size_t point = 0; point + 1 < pairs.size(); point += 2) {
    curve.strain.push_back(pairs[point]);
    curve.stress_pa.push_back(pairs[point + 1]);
  }
  return curve;
}

}  // namespace

SimulationCache::SimulationCache(const std::filesystem::path& path, int busy_timeout_ms) : path_(path) {
  std::error_code ignored;  // the database's own message is clearer
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
  guarded(path_, [&] {
    database_ = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                                                   busy_timeout_ms);
    distrust(*database_);
    database_->exec("PRAGMA journal_mode = WAL");
    // A power cut may lose the newest results, never the file; they would be simulated again.
    database_->exec("PRAGMA synchronous = NORMAL");
    prepare_schema(*database_, path_);
    const std::string verdict = database_->execAndGet("PRAGMA quick_check(1)").getString();
    if (verdict != "ok") refuse_cache(path_, "it is damaged (" + verdict + ")");
  });
}

SimulationCache::~SimulationCache() = default;

std::optional<CachedSimulation> SimulationCache::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  return guarded(path_, [&]() -> std::optional<CachedSimulation> {
    SQLite::Statement query(*database_,
                            "SELECT key, failure, modulus_pa, toughness_pa, peak_stress_pa, failure_strain, curve, "
                            "checksum FROM simulation "
                            "WHERE key = ?");
    query.bind(1, key);
    if (!query.executeStep()) return std::nullopt;
    if (checksum_of_simulation(query) != query.getColumn(7).getInt64()) {
      refuse_cache(path_, fmt::format("it is damaged (the row {} does not fit its checksum)", key));
    }
    CachedSimulation simulation;
    simulation.failure = query.getColumn(1).getString();
    simulation.modulus_pa = query.getColumn(2).getDouble();
    simulation.toughness_pa = query.getColumn(3).getDouble();
    simulation.peak_stress_pa = query.getColumn(4).getDouble();
    simulation.failure_strain = query.getColumn(5).getDouble();
    const SQLite::Column curve = query.getColumn(6);
    simulation.curve = unpack_curve(curve.getBlob(), curve.getBytes());
    return simulation;
  });
}

bool SimulationCache::insert(const std::string& key, const CachedSimulation& simulation) {
  const std::vector<float> curve = pack_curve(simulation.curve);
  const std::lock_guard lock(mutex_);
  return guarded(path_, [&] {
    SQLite::Statement insertion(*database_,
                                "INSERT INTO simulation VALUES (?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT (key) DO NOTHING");
    insertion.bind(1, key);
    insertion.bind(2, simulation.failure);
    insertion.bind(3, simulation.modulus_pa);
    insertion.bind(4, simulation.toughness_pa);
    insertion.bind(5, simulation.peak_stress_pa);
    insertion.bind(6, simulation.failure_strain);
    // A null pointer would be stored as NULL, not as an empty curve.
    const void* bytes = curve.empty() ? "" : static_cast<const void*>(curve.data());
    insertion.bind(7, bytes, static_cast<int>(curve.size() * sizeof(float)));
    const double numbers[4] = {simulation.modulus_pa, simulation.toughness_pa, simulation.peak_stress_pa,
                               simulation.failure_strain};
    const std::string_view points(static_cast<const char*>(bytes), curve.size() * sizeof(float));
    insertion.bind(8, simulation_checksum(key, simulation.failure, numbers, points));
    return insertion.exec() == 1;
  });
}

std::optional<std::vector<tester::Break>> SimulationCache::find_breaks(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  return guarded(path_, [&]() -> std::optional<std::vector<tester::Break>> {
    SQLite::Statement query(*database_, "SELECT pairs, checksum FROM breaks WHERE key = ?");
    query.bind(1, key);
    if (!query.executeStep()) return std::nullopt;
    if (breaks_checksum(key, bytes_in(query.getColumn(0))) != query.getColumn(1).getInt64()) {
      refuse_cache(path_, fmt::format("it is damaged (the cracks of {} do not fit their checksum)", key));
    }
    const SQLite::Column pairs = query.getColumn(0);
    std::vector<PackedBreak> packed(static_cast<std::size_t>(pairs.getBytes()) / sizeof(PackedBreak));
    if (!packed.empty()) std::memcpy(packed.data(), pairs.getBlob(), packed.size() * sizeof(PackedBreak));
    std::vector<tester::Break> breaks;
    for (const PackedBreak& broken : packed) breaks.push_back({broken.element, broken.strain});
    return breaks;
  });
}

void SimulationCache::insert_breaks(const std::string& key, const std::vector<tester::Break>& breaks) {
  std::vector<PackedBreak> packed;
  for (const tester::Break& broken : breaks) packed.push_back({broken.element, static_cast<float>(broken.strain)});
  const std::lock_guard lock(mutex_);
  guarded(path_, [&] {
    SQLite::Statement insertion(*database_, "INSERT INTO breaks VALUES (?, ?, ?) ON CONFLICT (key) DO NOTHING");
    insertion.bind(1, key);
    const void* bytes = packed.empty() ? "" : static_cast<const void*>(packed.data());
    insertion.bind(2, bytes, packed.size() * sizeof(PackedBreak));
    const std::string_view pairs(static_cast<const char*>(bytes), packed.size() * sizeof(PackedBreak));
    insertion.bind(3, breaks_checksum(key, pairs));
    insertion.exec();
  });
}

std::int64_t SimulationCache::size() const {
  const std::lock_guard lock(mutex_);
  return guarded(path_, [&] { return database_->execAndGet("SELECT count(*) FROM simulation").getInt64(); });
}

}  // namespace nacre::store
