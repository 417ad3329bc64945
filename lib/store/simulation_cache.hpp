#pragma once
// Results of the testers, by simulation_key(): the farm's memory over crashes, runs and studies.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "store/database_care.hpp"
#include "tester/toughness.hpp"

namespace nacre::store {

/// Result of one test of one design. Fields of the test that was not run are 0.
struct CachedSimulation {
  std::string failure;  ///< empty, or why the simulation gave no number: a failure is a result, too
  double modulus_pa = 0.0;
  double toughness_pa = 0.0;
  double peak_stress_pa = 0.0;
  double failure_strain = 0.0;
  tester::Curve curve;  ///< stored as pairs of float
  bool operator==(const CachedSimulation&) const = default;
};

/// What this program writes; it takes older ones over.
inline constexpr int kCacheSchemaVersion = 3;

/// Files in the folder of runs, which share them: of threads, and of a CUDA device, which rounds otherwise.
inline constexpr const char* kCacheName = "simulations.db";
inline constexpr const char* kDeviceCacheName = "simulations-cuda.db";

/// A cache file shared by all threads of a process, and by several processes (WAL; a busy file is waited for).
class SimulationCache {
 public:
  /// Opens or creates the file. Throws InputError with a sentence that names the file and how to mend it: not a
  /// database, damaged, written by another version, not writable. DatabaseUnavailable here and below where time or room
  /// is what lacks: a file that another program writes is waited for `busy_timeout_ms`.
  explicit SimulationCache(const std::filesystem::path& path, int busy_timeout_ms = 30'000);
  ~SimulationCache();

  std::optional<CachedSimulation> find(const std::string& key) const;
  /// Keeps the first result when the key is already there, and returns false then.
  bool insert(const std::string& key, const CachedSimulation& simulation);
  /// Elements that failed in a toughness test, strains as float; nothing when they were not kept.
  std::optional<std::vector<tester::Break>> find_breaks(const std::string& key) const;
  void insert_breaks(const std::string& key, const std::vector<tester::Break>& breaks);
  std::int64_t size() const;  ///< results

 private:
  std::filesystem::path path_;
  mutable std::mutex mutex_;
  std::unique_ptr<SQLite::Database> database_;
};

}  // namespace nacre::store
