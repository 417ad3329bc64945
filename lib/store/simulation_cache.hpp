#pragma once
// What the testers answered, by simulation_key(): the farm's memory over crashes, runs and studies.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tester/tester.hpp"

namespace SQLite {
class Database;
}

namespace nacre::store {

/// Answer to one question (one design, one test). Fields of the test that was not run are 0.
struct CachedSimulation {
  std::string failure;  ///< empty, or why the simulation gave no number: a failure is an answer, too
  double modulus_pa = 0.0;
  double toughness_pa = 0.0;
  double peak_stress_pa = 0.0;
  double failure_strain = 0.0;
  tester::Curve curve;  ///< stored as pairs of float
  bool operator==(const CachedSimulation&) const = default;
};

/// The cache cannot be used now and may be later, as it is: another program writes it, its disk is full. Nothing is to
/// be rebuilt or moved away.
class CacheUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A cache file shared by all threads of a process, and by several processes (WAL; a busy file is waited for).
class SimulationCache {
 public:
  /// Opens or creates the file. Throws InputError with a sentence that names the file and how to mend it: not a
  /// database, damaged, written by another version, not writable. CacheUnavailable here and below where time or room
  /// is what lacks: a file that another program writes is waited for `busy_timeout_ms`.
  explicit SimulationCache(const std::filesystem::path& path, int busy_timeout_ms = 30'000);
  ~SimulationCache();

  std::optional<CachedSimulation> find(const std::string& key) const;
  /// Keeps the first answer when the key is already there, and returns false then.
  bool insert(const std::string& key, const CachedSimulation& answer);
  /// Elements that failed in a toughness test, strains as float; nothing when they were not kept.
  std::optional<std::vector<tester::Break>> find_breaks(const std::string& key) const;
  void insert_breaks(const std::string& key, const std::vector<tester::Break>& breaks);
  std::int64_t size() const;  ///< answers

 private:
  std::filesystem::path path_;
  mutable std::mutex mutex_;
  std::unique_ptr<SQLite::Database> database_;
};

}  // namespace nacre::store
