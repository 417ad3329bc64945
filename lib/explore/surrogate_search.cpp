#include "explore/surrogate_search.hpp"

#include <cassert>

#include "explore/evolution.hpp"
#include "optimize/best_by_rank.hpp"

namespace nacre::explore {

std::vector<Evaluated> best_by_rank(std::span<const Evaluated> samples, std::size_t count) {
  std::vector<Evaluated> best;
  for (const std::size_t i : optimize::best_by_rank(performances_of(samples), count)) best.push_back(samples[i]);
  return best;
}

std::vector<Evaluated> search_believed(const Believed& believed, std::span<const Evaluated> start,
                                       const SurrogateSearchSettings& settings) {
  SearchSettings evolution;
  evolution.budget = settings.generations * settings.population;
  evolution.population = evolution.batch = settings.population;
  evolution.seed = settings.seed;
  evolution.known.assign(start.begin(), start.end());
  const auto search = make_evolution(evolution, Variation::three_way);
  std::vector<Evaluated> visited;
  for (auto batch = search->ask(); !batch.empty(); batch = search->ask()) {
    const std::vector<optimize::Performance> predicted = believed(batch);
    assert(predicted.size() == batch.size());
    for (std::size_t i = 0; i < batch.size(); ++i) visited.push_back({batch[i], predicted[i]});
    search->tell(std::vector<std::optional<optimize::Performance>>(predicted.begin(), predicted.end()));
  }
  return visited;
}

}  // namespace nacre::explore
