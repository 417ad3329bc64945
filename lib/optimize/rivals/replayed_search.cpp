#include "optimize/rivals/replayed_search.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/recorded_optimizer.hpp"
#include "optimize/replay.hpp"

namespace nacre::optimize {
namespace {

/// One run of a global algorithm of NLopt, replayed; a batch is filled by what it would want if the points before were
/// as good as their nearest neighbours. Where that leads nowhere new, the batch is smaller.
class ReplayedSearch final : public RecordedOptimizer {
 public:
  ReplayedSearch(nlopt::algorithm algorithm, const BatchOptimizerSettings& settings) : RecordedOptimizer(settings) {
    const Point middle(settings_.dimension, 0.5);
    search_ = {.algorithm = algorithm,
               .start = settings_.starts.empty() ? middle : settings_.starts.front(),
               .step = 0.2,
               .smallest_step = 0.0,
               .maximum_evaluations = 10 * settings.budget + 100,
               .seed = settings.seed};
  }

 private:
  std::vector<Point> propose(int count) override {
    std::vector<Point> points;
    const std::vector<double> value = values();
    const auto known = [&](const Point& point) -> std::optional<double> {
      for (std::size_t i = 0; i < evaluations_.size(); ++i) {
        if (evaluations_[i].point == point) return value[i];
      }
      const auto pending = [&](const std::vector<Point>& others) {
        return std::find(others.begin(), others.end(), point) != others.end();
      };
      if (pending(points) || pending(asked_)) return nearest(point, value);
      return std::nullopt;
    };
    while (static_cast<int>(points.size()) < count) {
      const std::optional<Point> point = next_unknown(search_, known);
      if (!point) break;
      points.push_back(*point);
    }
    return points;
  }

  double nearest(const Point& point, const std::vector<double>& value) const {
    double nearest = HUGE_VAL, result = 0.0;
    for (std::size_t i = 0; i < evaluations_.size(); ++i) {
      double square = 0.0;
      for (std::size_t k = 0; k < point.size(); ++k) square += std::pow(point[k] - evaluations_[i].point[k], 2);
      if (square < nearest) nearest = square, result = value[i];
    }
    return result;
  }

  LocalSearch search_;
};

}  // namespace

std::unique_ptr<BatchOptimizer> make_replayed_search(nlopt::algorithm algorithm,
                                                     const BatchOptimizerSettings& settings) {
  return std::make_unique<ReplayedSearch>(algorithm, settings);
}

}  // namespace nacre::optimize
