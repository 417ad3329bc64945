#include "explore/surrogate_search.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "explore/evolution.hpp"

namespace nacre::explore {

std::vector<Evaluated> best_by_rank(std::span<const Evaluated> samples, std::size_t count) {
  const std::vector<optimize::Performance> performances = performances_of(samples);
  const std::vector<int> ranks = optimize::non_dominated_ranks(performances);
  const std::vector<double> crowding = optimize::crowding_distances(performances, ranks);
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return ranks[a] != ranks[b] ? ranks[a] < ranks[b] : crowding[a] > crowding[b];
  });
  order.resize(std::min(order.size(), count));
  std::vector<Evaluated> best;
  for (const std::size_t i : order) best.push_back(samples[i]);
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
    const std::vector<optimize::Performance> answers = believed(batch);
    assert(answers.size() == batch.size());
    for (std::size_t i = 0; i < batch.size(); ++i) visited.push_back({batch[i], answers[i]});
    search->tell(std::vector<std::optional<optimize::Performance>>(answers.begin(), answers.end()));
  }
  return visited;
}

}  // namespace nacre::explore
