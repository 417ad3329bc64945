#include "optimize/rivals/random_search.hpp"

#include "base/random.hpp"
#include "optimize/recorded_optimizer.hpp"

namespace nacre::optimize {
namespace {

class RandomSearch final : public RecordedOptimizer {
 public:
  explicit RandomSearch(const BatchOptimizerSettings& settings)
      : RecordedOptimizer(settings), random_(settings.seed, "optimize/random") {}

 private:
  std::vector<Point> propose(int count) override {
    std::vector<Point> points(count, Point(settings_.dimension));
    for (Point& point : points) {
      for (double& coordinate : point) coordinate = random_.uniform();
    }
    return points;
  }

  RandomStream random_;
};

}  // namespace

std::unique_ptr<BatchOptimizer> make_random_search(const BatchOptimizerSettings& settings) {
  return std::make_unique<RandomSearch>(settings);
}

}  // namespace nacre::optimize
