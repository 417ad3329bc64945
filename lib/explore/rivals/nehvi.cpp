#include "explore/rivals/nehvi.hpp"

#include <algorithm>

#include "explore/model_search.hpp"
#include "explore/rivals/cube_beliefs.hpp"
#include "explore/surrogate_search.hpp"
#include "pattern/constraints.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::explore {
namespace {

constexpr std::size_t kBestStarts = 6;
constexpr int kRandomStarts = 2, kMostSteps = 12;

/// Patterns one flip away that lie in the design space.
std::vector<pattern::Pattern> neighbours_of(const pattern::Pattern& pattern) {
  std::vector<pattern::Pattern> neighbours;
  for (int pixel = 0; pixel < pattern::kFreePixels; ++pixel) {
    const pattern::Pattern neighbour(pattern.bits() ^ (std::uint64_t{1} << pixel));
    if (pattern::is_feasible(neighbour)) neighbours.push_back(neighbour);
  }
  return neighbours;
}

/// Steepest ascent from a pattern; appends the few best neighbours of every step to `met`.
void climb(pattern::Pattern at, const std::vector<ObjectiveModel>& models, std::span<const optimize::Performance> front,
           std::vector<Evaluated>& met) {
  constexpr std::size_t kKept = 5;
  double reached = -1.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const std::vector<pattern::Pattern> neighbours = neighbours_of(at);
    if (neighbours.empty()) return;
    const std::vector<Belief> beliefs = cube_beliefs(models, neighbours);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < beliefs.size(); ++i) order.emplace_back(-expected_improvement(beliefs[i], front), i);
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < std::min(kKept, order.size()); ++k) met.push_back({neighbours[order[k].second], {}});
    if (-order.front().first <= reached) return;
    reached = -order.front().first;
    at = neighbours[order.front().second];
  }
}

}  // namespace

std::vector<pattern::Pattern> nehvi_batch(const BatchRequest& batch_request) {
  const std::uint64_t seed = batch_seed(batch_request);
  RandomStream random(seed, "explore/nehvi");
  const std::vector<ObjectiveModel> models = fit_cube_models(batch_request.evaluated, seed);
  const std::vector<optimize::Performance> points = posterior_points(models, batch_request.evaluated);
  const std::vector<optimize::Performance> front = optimize::pareto_front(points);
  std::vector<Evaluated> met;
  for (const Evaluated& best : best_by_rank(batch_request.evaluated, kBestStarts))
    climb(best.pattern, models, front, met);
  for (int i = 0; i < kRandomStarts; ++i) climb(pattern::random_pattern(random), models, front, met);
  while (static_cast<int>(met.size()) < 10 * batch_request.count) met.push_back({pattern::random_pattern(random), {}});
  return best_by_improvement(models, unseen(std::move(met), batch_request), points, batch_request.count);
}

}  // namespace nacre::explore
