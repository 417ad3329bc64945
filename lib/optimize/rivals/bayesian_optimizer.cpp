#include "optimize/rivals/bayesian_optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <string>

#include "base/random.hpp"
#include "optimize/recorded_optimizer.hpp"
#include "optimize/rivals/acquisition.hpp"
#include "optimize/rivals/unit_cube.hpp"
#include "optimize/sobol.hpp"

namespace nacre::optimize {
namespace {

using Eigen::VectorXd;

constexpr double kMargin =
    1e-3;  // of improvement, in signal deviations: a hundredth, as is usual, keeps the search off the bottom
constexpr int kGlobalPoints = 1000;    // of the search for the most promising point
constexpr int kNearbyPoints = 200;     // around the best points known
constexpr int kRefined = 4;            // of those, searched from locally
constexpr int kRefinements = 80;       // evaluations of each local search
constexpr double kRefitGrowth = 1.05;  // the kernel is fitted anew when the data have grown by this factor
constexpr int kAlwaysRefitBelow = 60;  // evaluations
constexpr int kRestarts = 1;           // of the kernel's fit
constexpr double kSamePoint = 1e-6;

std::uint64_t numbered(std::uint64_t seed, std::string_view what, int number) {
  return RandomStream(seed, std::string(what) + std::to_string(number)).bits();
}

class BayesianOptimizer final : public RecordedOptimizer {
 public:
  explicit BayesianOptimizer(const BatchOptimizerSettings& settings)
      : RecordedOptimizer(settings), first_points_(settings.dimension, settings.seed) {}

  /// Nothing but the evaluations and the place in the Sobol sequence is remembered between batches.
  void resume(const std::vector<Evaluation>& told) override {
    restore(told);
    const auto known = static_cast<std::size_t>(std::min(told_count(), first_count()));
    for (std::size_t i = 0; i < known; ++i) {
      const Point asked = i < settings_.starts.size() ? settings_.starts[i] : first_points_.next();
      if (told[i].point != asked) throw another_search(i);
    }
  }

 private:
  int first_count() const {
    const int filling = settings_.first_points > 0 ? settings_.first_points : 2 * settings_.dimension + 1;
    return filling + static_cast<int>(settings_.starts.size());
  }

  std::vector<Point> propose(int count) override {
    std::vector<Point> points;
    while (static_cast<int>(points.size()) < count) {
      // A first model needs values: until there are enough, and while the first batch is under way, the cube is filled.
      const int asked = told_count() + static_cast<int>(asked_.size() + points.size());
      if (asked >= first_count() && told_count() >= 3) break;
      points.push_back(first_points_.next());
    }
    const int more = count - static_cast<int>(points.size());
    if (more > 0) add_promising(points, more);
    return points;
  }

  RegressionData observations(int count) const {
    std::vector<Point> known;
    const std::vector<double> value = values(count);
    for (int i = 0; i < count; ++i) known.push_back(evaluations_[i].point);
    return {to_rows(known, settings_.dimension), Eigen::Map<const VectorXd>(value.data(), count),
            VectorXd::Constant(count, settings_.value_deviation * settings_.value_deviation)};
  }

  /// How many of the evaluations the kernel is fitted to: a number that depends on told_count() alone, so that a
  /// resumed search goes on as an uninterrupted one would.
  int fitted_count() const {
    const int told = told_count();
    if (told < kAlwaysRefitBelow) return told;
    int count = kAlwaysRefitBelow;
    while (static_cast<int>(std::ceil(kRefitGrowth * count)) <= told)
      count = static_cast<int>(std::ceil(kRefitGrowth * count));
    return count;
  }

  void add_promising(std::vector<Point>& points, int count) {
    if (const int fitted = fitted_count(); fitted != kernel_fitted_to_) {
      kernel_ = fit_kernel(observations(fitted), kRestarts, numbered(settings_.seed, "kernel/", fitted));
      kernel_fitted_to_ = fitted;
    }
    const GaussianProcess process(observations(told_count()), kernel_);
    double incumbent = HUGE_VAL;
    for (const auto& predicted : process.predict_all(process.observations().inputs))
      incumbent = std::min(incumbent, predicted.mean);
    PenalisedImprovement worth(process, incumbent, kMargin, numbered(settings_.seed, "slope/", told_count()));
    for (const Point& pending : asked_) worth.add_pending(to_vector(pending));
    for (const Point& pending : points) worth.add_pending(to_vector(pending));
    for (int k = 0; k < count; ++k) {
      points.push_back(most_promising(process, worth, numbered(settings_.seed, "search/", told_count() + k)));
      worth.add_pending(to_vector(points.back()));
    }
  }

  /// Sobol points, points near the best ones known, then local searches from the best of all these.
  Point most_promising(const GaussianProcess& process, const PenalisedImprovement& worth, std::uint64_t seed) const {
    std::vector<Point> candidates;
    SobolPoints everywhere(settings_.dimension, seed);
    for (int k = 0; k < kGlobalPoints; ++k) candidates.push_back(everywhere.next());
    RandomStream random(seed, "nearby");
    const std::vector<double> value = values();
    std::vector<std::size_t> order(value.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return value[a] < value[b]; });
    for (int k = 0; k < kNearbyPoints; ++k) {
      Point near = evaluations_[order[static_cast<std::size_t>(k) % std::min<std::size_t>(3, order.size())]].point;
      const double reach = std::pow(10.0, random.uniform(-2.5, -0.5));
      for (double& coordinate : near) coordinate = std::clamp(coordinate + reach * random.normal(), 0.0, 1.0);
      candidates.push_back(std::move(near));
    }
    const auto predicted = process.predict_all(to_rows(candidates, settings_.dimension));
    std::vector<std::pair<double, std::size_t>> ranked;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      ranked.emplace_back(-worth(to_vector(candidates[i]), predicted[i]), i);
    std::partial_sort(ranked.begin(), ranked.begin() + kRefined, ranked.end());
    Point best;
    double largest = -HUGE_VAL;
    for (int k = 0; k < kRefined; ++k) {
      const auto& [negative, index] = ranked[k];
      const auto [point, refined] = climb(worth, candidates[index], -negative);
      if (refined > largest && is_new(point)) largest = refined, best = point;
    }
    return best.empty() ? candidates.front() : best;
  }

  bool is_new(const Point& point) const {
    return std::none_of(evaluations_.begin(), evaluations_.end(), [&](const Evaluation& known) {
      return (to_vector(known.point) - to_vector(point)).norm() < kSamePoint;
    });
  }

  static std::pair<Point, double> climb(const PenalisedImprovement& worth, const Point& from, double value) {
    nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(from.size()));
    search.set_lower_bounds(0.0);
    search.set_upper_bounds(1.0);
    search.set_initial_step(0.05);
    search.set_xtol_abs(1e-4);
    search.set_maxeval(kRefinements);
    const auto asked = [](const std::vector<double>& at, std::vector<double>&, void* data) {
      return (*static_cast<const PenalisedImprovement*>(data))(to_vector(at));
    };
    search.set_max_objective(asked, const_cast<PenalisedImprovement*>(&worth));
    Point point = from;
    double reached = value;
    try {
      search.optimize(point, reached);
    } catch (const std::runtime_error&) {  // no progress possible any more
    }
    return reached > value ? std::pair(point, reached) : std::pair(from, value);
  }

  SobolPoints first_points_;
  MaternKernel kernel_;
  int kernel_fitted_to_ = -1;
};

}  // namespace

std::unique_ptr<BatchOptimizer> make_bayesian_optimizer(const BatchOptimizerSettings& settings) {
  return std::make_unique<BayesianOptimizer>(settings);
}

}  // namespace nacre::optimize
