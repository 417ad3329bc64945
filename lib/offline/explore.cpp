#include "offline/explore.hpp"

#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "explore/batch_log.hpp"
#include "explore/mechanics.hpp"
#include "material/parameter_file.hpp"
#include "store/kept_simulation.hpp"
#include "tester/strength_field.hpp"

namespace nacre::offline {

std::string model_identity(const ExploreSettings& settings) {
  return content_hash(std::string(to_string(settings.fidelity)) + material::to_toml(settings.parameters));
}

std::string search_fault(const ExploreSettings& settings) {
  const explore::SearchSettings& search = settings.search;
  const int specimens = search.learned.specimens;
  const bool learns = search.algorithm == "learned";
  if (specimens > 1 && !learns)
    return fmt::format("specimens: `{}` tests one specimen of a pattern, expected algorithm learned", search.algorithm);
  if (!search.former.empty() && !learns)
    return fmt::format("former: `{}` cannot learn from former samples, expected algorithm learned", search.algorithm);
  if (specimens > 1 && !tester::specimens_differ(settings.parameters))
    return "specimens: without strength_cv all specimens are alike, expected 1";
  return {};
}

Explored explore_gamut(ExploreSettings settings, const ExploreEvents& events) {
  settings.search.mechanics = explore::mechanics_by_tester(settings.parameters, settings.fidelity, 0);
  const auto search = explore::make_search(settings.search);
  std::unique_ptr<store::SimulationCache> cache;
  if (!settings.cache.empty()) cache = std::make_unique<store::SimulationCache>(settings.cache);
  std::optional<explore::BatchLog> log;
  if (!settings.batches.empty()) log.emplace(settings.batches, settings.search, model_identity(settings));
  const auto ask = [&] { return log ? log->ask(*search) : search->ask(); };
  const auto stopped = [&] { return events.stopped && events.stopped(); };
  Explored explored;
  std::map<pattern::Pattern, int> specimens;  // tested so far: a pattern asked for again wants the next one
  for (const explore::Evaluated& sample : settings.search.known) specimens[sample.pattern] = sample.sampling.specimens;
  for (auto batch = ask(); !batch.empty(); batch = ask()) {
    std::vector<std::optional<optimize::Performance>> performances(batch.size());
    std::vector<int> numbers;
    for (const pattern::Pattern& pattern : batch) numbers.push_back(specimens[pattern]++);
    parallel_for(batch.size(), [&](int i) {
      const auto index = static_cast<std::size_t>(i);
      if (stopped()) return;
      performances[index] = store::kept_performance(
          {batch[index], settings.parameters, {}, settings.fidelity, numbers[index]}, cache.get());
      if (events.simulated) events.simulated();
    });
    if (stopped()) break;  // what is missing of this batch was not simulated: it must not count as failed
    for (const auto& performance : performances) explored.failed += performance ? 0 : 1;
    search->tell(performances);
    if (events.told) events.told(search->evaluated());
  }
  explored.gamut = search->evaluated();
  return explored;
}

nlohmann::ordered_json to_json(const Explored& explored, const std::string& file) {
  const std::vector<optimize::Performance> points = explore::performances_of(explored.gamut);
  return {{"evaluated", explored.gamut.size()},
          {"failed", explored.failed},
          {"front", optimize::pareto_front(points).size()},
          {"hypervolume_gpa_mpa", optimize::hypervolume_staircase_gpa_mpa(points)},
          {"gamut", file.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(file)}};
}

}  // namespace nacre::offline
