#include "optimize/ensemble_sampler.hpp"

#include <cassert>
#include <cmath>

namespace nacre::optimize {
namespace {

constexpr double kStretch = 2.0;

/// From the density that is proportional to 1 / sqrt(z) between 1 / kStretch and kStretch.
double draw_stretch(RandomStream& random) {
  const double root = (std::sqrt(kStretch) - 1.0 / std::sqrt(kStretch)) * random.uniform() + 1.0 / std::sqrt(kStretch);
  return root * root;
}

}  // namespace

std::vector<Eigen::VectorXd> sample_ensemble(const std::function<double(const Eigen::VectorXd&)>& cost,
                                             std::vector<Eigen::VectorXd> walkers, int burn_in, int steps,
                                             RandomStream random) {
  assert(!walkers.empty() && walkers.size() % 2 == 0);
  const auto dimension = static_cast<double>(walkers.front().size());
  const std::size_t half = walkers.size() / 2;
  std::vector<double> costs;
  for (const Eigen::VectorXd& walker : walkers) costs.push_back(cost(walker));
  std::vector<Eigen::VectorXd> draws;
  for (int step = 0; step < burn_in + steps; ++step) {
    for (std::size_t k = 0; k < walkers.size(); ++k) {
      // Partners come from the other half, whose places do not depend on this move.
      const std::size_t partner =
          (k < half ? half : 0) + static_cast<std::size_t>(random.index(static_cast<int>(half)));
      const double stretch = draw_stretch(random), chance = random.uniform();
      const Eigen::VectorXd moved = walkers[partner] + stretch * (walkers[k] - walkers[partner]);
      const double moved_cost = cost(moved);
      if (std::log(chance) < (dimension - 1.0) * std::log(stretch) + costs[k] - moved_cost) {
        walkers[k] = moved;
        costs[k] = moved_cost;
      }
    }
    if (step >= burn_in) draws.insert(draws.end(), walkers.begin(), walkers.end());
  }
  return draws;
}

}  // namespace nacre::optimize
