#include "explore/rivals/egbo.hpp"

#include "explore/model_search.hpp"
#include "explore/rivals/cube_beliefs.hpp"
#include "explore/surrogate_search.hpp"
#include "pattern/mutation.hpp"

namespace nacre::explore {

std::vector<pattern::Pattern> egbo_batch(const BatchRequest& batch_request) {
  constexpr std::size_t kParents = 50;
  constexpr int kOffspring = 500;
  const std::uint64_t seed = batch_seed(batch_request);
  RandomStream random(seed, "explore/egbo");
  const std::vector<ObjectiveModel> models = fit_cube_models(batch_request.evaluated, seed);
  const std::vector<optimize::Performance> points = posterior_points(models, batch_request.evaluated);
  std::vector<Evaluated> population = batch_request.evaluated;
  for (std::size_t i = 0; i < population.size(); ++i) population[i].performance = points[i];
  const std::vector<Evaluated> parents = best_by_rank(population, kParents);  // the better, the earlier
  const auto size = static_cast<int>(parents.size());
  std::vector<Evaluated> offspring;
  for (int i = 0; i < kOffspring; ++i) {
    const auto winner = static_cast<std::size_t>(std::min(random.index(size), random.index(size)));
    offspring.push_back({pattern::mutate(parents[winner].pattern, pattern::MutationKind::three_way, random), {}});
  }
  return best_by_improvement(models, unseen(std::move(offspring), batch_request), points, batch_request.count);
}

}  // namespace nacre::explore
