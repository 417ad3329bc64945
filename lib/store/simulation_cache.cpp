#include "store/simulation_cache.hpp"

#include <cstring>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>

#include "base/result.hpp"
#include "store/database_care.hpp"

namespace nacre::store {
namespace {

constexpr int kSchemaVersion = 2;
constexpr int kBusyTimeoutMs = 30'000;  // another run may be writing
constexpr const char* kSchema = R"sql(
  CREATE TABLE simulation (
    key            TEXT PRIMARY KEY,
    failure        TEXT NOT NULL,
    modulus_pa     REAL NOT NULL,
    toughness_pa   REAL NOT NULL,
    peak_stress_pa REAL NOT NULL,
    failure_strain REAL NOT NULL,
    curve          BLOB NOT NULL
  ) STRICT, WITHOUT ROWID;
)sql";
// Version 2: elements that failed, for simulations whose crack was asked for; pairs of int32 and float32.
constexpr const char* kBreakSchema = R"sql(
  CREATE TABLE breaks (key TEXT PRIMARY KEY, pairs BLOB NOT NULL) STRICT, WITHOUT ROWID;
)sql";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw InputError::format(
      "the simulation cache {} cannot be used: {}. Nothing else depends on it: move the file (and its -wal and -shm "
      "companions) "
      "away and start again, and the simulations are done anew",
      path.string(), reason);
}

// Runs `body` and turns SQLite's exceptions into a sentence.
template <class Body>
auto guarded(const std::filesystem::path& path, const Body& body) {
  try {
    return body();
  } catch (const SQLite::Exception& error) {
    refuse(path, error.what());
  }
}

void prepare_schema(SQLite::Database& database, const std::filesystem::path& path) {
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  if (version == 0 && !database.tableExists("simulation")) {
    database.exec(kSchema);
    database.exec(kBreakSchema);
    database.exec("PRAGMA user_version = " + std::to_string(kSchemaVersion));
  } else if (version == 1) {  // nothing that was simulated is lost
    database.exec(kBreakSchema);
    database.exec("PRAGMA user_version = " + std::to_string(kSchemaVersion));
  } else if (version != kSchemaVersion) {
    refuse(path, "it has schema version " + std::to_string(version) + ", this program expects " +
                     std::to_string(kSchemaVersion));
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

SimulationCache::SimulationCache(const std::filesystem::path& path) : path_(path) {
  std::error_code ignored;  // the database's own message is clearer
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
  guarded(path_, [&] {
    database_ =
        std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kBusyTimeoutMs);
    distrust(*database_);
    database_->exec("PRAGMA journal_mode = WAL");
    // A power cut may lose the newest answers, never the file; they would be simulated again.
    database_->exec("PRAGMA synchronous = NORMAL");
    prepare_schema(*database_, path_);
    const std::string verdict = database_->execAndGet("PRAGMA quick_check(1)").getString();
    if (verdict != "ok") refuse(path_, "it is damaged (" + verdict + ")");
  });
}

SimulationCache::~SimulationCache() = default;

std::optional<CachedSimulation> SimulationCache::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  return guarded(path_, [&]() -> std::optional<CachedSimulation> {
    SQLite::Statement query(
        *database_,
        "SELECT failure, modulus_pa, toughness_pa, peak_stress_pa, failure_strain, curve FROM simulation "
        "WHERE key = ?");
    query.bind(1, key);
    if (!query.executeStep()) return std::nullopt;
    CachedSimulation answer;
    answer.failure = query.getColumn(0).getString();
    answer.modulus_pa = query.getColumn(1).getDouble();
    answer.toughness_pa = query.getColumn(2).getDouble();
    answer.peak_stress_pa = query.getColumn(3).getDouble();
    answer.failure_strain = query.getColumn(4).getDouble();
    const SQLite::Column curve = query.getColumn(5);
    answer.curve = unpack_curve(curve.getBlob(), curve.getBytes());
    return answer;
  });
}

bool SimulationCache::insert(const std::string& key, const CachedSimulation& answer) {
  const std::vector<float> curve = pack_curve(answer.curve);
  const std::lock_guard lock(mutex_);
  return guarded(path_, [&] {
    SQLite::Statement insertion(*database_,
                                "INSERT INTO simulation VALUES (?, ?, ?, ?, ?, ?, ?) ON CONFLICT (key) DO NOTHING");
    insertion.bind(1, key);
    insertion.bind(2, answer.failure);
    insertion.bind(3, answer.modulus_pa);
    insertion.bind(4, answer.toughness_pa);
    insertion.bind(5, answer.peak_stress_pa);
    insertion.bind(6, answer.failure_strain);
    // A null pointer would be stored as NULL, not as an empty curve.
    const void* bytes = curve.empty() ? "" : static_cast<const void*>(curve.data());
    insertion.bind(7, bytes, static_cast<int>(curve.size() * sizeof(float)));
    return insertion.exec() == 1;
  });
}

std::optional<std::vector<tester::Break>> SimulationCache::find_breaks(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  return guarded(path_, [&]() -> std::optional<std::vector<tester::Break>> {
    SQLite::Statement query(*database_, "SELECT pairs FROM breaks WHERE key = ?");
    query.bind(1, key);
    if (!query.executeStep()) return std::nullopt;
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
    SQLite::Statement insertion(*database_, "INSERT INTO breaks VALUES (?, ?) ON CONFLICT (key) DO NOTHING");
    insertion.bind(1, key);
    const void* bytes = packed.empty() ? "" : static_cast<const void*>(packed.data());
    insertion.bind(2, bytes, static_cast<int>(packed.size() * sizeof(PackedBreak)));
    insertion.exec();
  });
}

std::int64_t SimulationCache::size() const {
  const std::lock_guard lock(mutex_);
  return guarded(path_, [&] { return database_->execAndGet("SELECT count(*) FROM simulation").getInt64(); });
}

}  // namespace nacre::store
