#pragma once
// A search by conversation: JSON lines in, JSON lines out (docs/FORMATS.md), so that an optimiser of somebody's own
// drives nacre's testers, nacre's searches drive a tester of somebody's own, or both.

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "explore/batch_log.hpp"
#include "offline/explore.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::offline {

/// One conversation, and the log by which it goes on after an end of any kind: what was told and what was tested, line
/// by line, beside the batches that were asked for.
class AskTell {
 public:
  /// Begins `log` and settings.batches, or goes on with them. `stopped` (may be empty) ends a running test early.
  /// Throws InputError for settings out of range, files of another search, and a faulty line of the log.
  AskTell(const ExploreSettings& settings, const std::filesystem::path& log, std::function<bool()> stopped);

  /// Where the conversation stands: evaluated, asks_left, tests_left, awaited, hypervolume_gpa_mpa (of what was told).
  nlohmann::ordered_json standing() const;
  /// Response to the request in line `number`; {"error": ...} names the line of one that cannot be understood or met,
  /// and nothing has changed.
  nlohmann::ordered_json respond(std::string_view line, std::size_t number);

  /// All that was told, then patterns that were tested only, T the mean over their specimens.
  std::vector<explore::Evaluated> gamut() const;

 private:
  using Specimen = std::pair<pattern::Pattern, int>;  ///< of a pattern, its number
  /// What was told of a pattern; nothing where its test failed.
  using Told = std::optional<explore::Evaluated>;

  nlohmann::ordered_json ask();
  nlohmann::ordered_json tell(const nlohmann::json& request);
  nlohmann::ordered_json test(const nlohmann::json& request);
  void test_specimens(const std::vector<Specimen>& wanted);
  nlohmann::ordered_json sample_of(const pattern::Pattern& pattern, int first, int count) const;
  void ask_search();
  void take(const pattern::Pattern& pattern, const Told& told);
  bool awaits(const pattern::Pattern& pattern) const;
  std::vector<pattern::Pattern> awaited() const;
  void read_log(const std::filesystem::path& log);
  void keep(const nlohmann::ordered_json& line);

  ExploreSettings settings_;
  std::function<bool()> stopped_;
  std::unique_ptr<explore::Search> search_;
  std::unique_ptr<store::SimulationCache> cache_;
  explore::BatchLog batches_;
  int asked_ = 0;
  std::vector<pattern::Pattern> batch_;                             ///< asked for, and not all of it told
  std::map<pattern::Pattern, Told> told_;                           ///< of that batch
  std::map<Specimen, std::optional<optimize::Performance>> tests_;  ///< nothing: no result
  std::mutex mutex_;  ///< of tests_ and the log while specimens are tested
  std::ofstream log_;
};

}  // namespace nacre::offline
