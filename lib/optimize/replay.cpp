#include "optimize/replay.hpp"

#include <algorithm>
#include <mutex>
#include <stdexcept>

namespace nacre::optimize {
namespace {

/// Passed through NLopt to its callback.
struct Replay {
  const KnownValues& known;
  nlopt::opt& optimizer;
  std::optional<Point> wanted;
};

/// NLopt stops at the first unknown point; what it is told for that point, and for any that it still visits on its way
/// out, is of no consequence.
double recorded_value(const Point& point, Point& /*gradient*/, void* data) {
  Replay& replay = *static_cast<Replay*>(data);
  if (replay.wanted) return 0.0;
  Point inside = point;  // rounding can carry a point an ulp past its bound
  for (double& coordinate : inside) coordinate = std::clamp(coordinate, 0.0, 1.0);
  if (const auto value = replay.known(inside)) return *value;
  replay.wanted = std::move(inside);
  replay.optimizer.force_stop();
  return 0.0;
}

}  // namespace

std::optional<Point> next_unknown(const LocalSearch& search, const KnownValues& known) {
  static std::mutex random_state;
  const std::lock_guard lock(random_state);
  nlopt::srand(static_cast<unsigned long>(search.seed));
  nlopt::opt optimizer(search.algorithm, static_cast<unsigned>(search.start.size()));
  Replay replay{known, optimizer, std::nullopt};
  optimizer.set_min_objective(recorded_value, &replay);
  optimizer.set_lower_bounds(0.0);
  optimizer.set_upper_bounds(1.0);
  optimizer.set_initial_step(search.step);
  optimizer.set_xtol_abs(search.smallest_step);
  optimizer.set_maxeval(search.maximum_evaluations);
  Point point = search.start;
  double value = 0.0;
  try {
    optimizer.optimize(point, value);
  } catch (const nlopt::forced_stop&) {       // an unknown point
  } catch (const nlopt::roundoff_limited&) {  // no progress possible any more: an end like any other
  } catch (const std::runtime_error&) {       // NLopt's "generic failure", such as a degenerate model: an end, too
  }
  return replay.wanted;
}

}  // namespace nacre::optimize
