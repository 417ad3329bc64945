#include "sysid/eta_moves.hpp"

#include <algorithm>
#include <nlopt.hpp>

#include "sysid/emulator.hpp"

namespace nacre::sysid {
namespace {

constexpr double kScaleReach = 3.0;  // radii that the common scales may move
constexpr int kScaleSteps = 9;       // of the grid over them
constexpr int kSearchEvaluations = 600;

double cost_for_nlopt(const std::vector<double>& at, std::vector<double>&, void* cost) {
  Move move{};
  std::copy(at.begin(), at.end(), move.begin());
  return (*static_cast<const std::function<double(const Move&)>*>(cost))(move);
}

}  // namespace

Point moved(const Point& from, const Move& move, std::span<const double> spans) {
  std::array<double, kEtaCount> shift{};
  const auto group = [&](int first, double scale, double soft, double interface) {
    shift[first] = scale + soft;
    shift[first + 1] = scale;
    shift[first + 2] = scale + interface;
  };
  group(kE0, move[0], move[2], move[3]);
  group(kW0, move[1], move[4], move[5]);
  shift[kGamma] = move[6];
  Point point = from;
  for (std::size_t j = 0; j < point.size(); ++j) point[j] = std::clamp(point[j] + shift[j] / spans[j], 0.0, 1.0);
  return point;
}

Move best_scales(const std::function<double(const Move&)>& cost, double reach, int steps) {
  Move best{};
  double smallest = cost(best);
  for (int i = 0; i < steps * steps; ++i) {
    Move move{};
    move[0] = reach * (2.0 * (i / steps) / (steps - 1) - 1.0);
    move[1] = reach * (2.0 * (i % steps) / (steps - 1) - 1.0);
    const double here = cost(move);
    if (here < smallest) smallest = here, best = move;
  }
  return best;
}

Move best_move(const std::function<double(const Move&)>& cost, double radius) {
  const Move start = best_scales(cost, kScaleReach * radius, kScaleSteps);
  nlopt::opt search(nlopt::LN_SBPLX, kMoveCount);
  std::vector<double> bound(kMoveCount, radius), step(kMoveCount, 0.3 * radius);
  bound[0] = bound[1] = kScaleReach * radius;
  search.set_upper_bounds(bound);
  for (double& value : bound) value = -value;
  search.set_lower_bounds(bound);
  search.set_initial_step(step);
  search.set_maxeval(kSearchEvaluations);
  std::function<double(const Move&)> objective = cost;
  search.set_min_objective(cost_for_nlopt, &objective);
  std::vector<double> at(start.begin(), start.end());
  try {
    double smallest = 0.0;
    search.optimize(at, smallest);
  } catch (const nlopt::roundoff_limited&) {  // the point reached is the best that doubles can tell
  }
  Move result{};
  std::copy(at.begin(), at.end(), result.begin());
  return result;
}

}  // namespace nacre::sysid
