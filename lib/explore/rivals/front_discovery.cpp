#include "explore/rivals/front_discovery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <nlopt.hpp>

namespace nacre::explore {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kLocalEvaluations = 20;
constexpr int kExpansionPoints = 20;
constexpr double kReach = 0.3;  ///< how far beyond a point its target lies, relative to its values

/// The buffer: points sorted into cells by their direction as seen from a point better than all.
class Buffer {
 public:
  explicit Buffer(const DiscoverySettings& settings) : settings_(settings) {}

  void add(FrontPoint point) {
    ideal_ = points_.empty() ? point.values : Vector2d(ideal_.cwiseMin(point.values));
    points_.push_back(std::move(point));
  }

  /// Sorts into cells and forgets what no cell keeps.
  void tidy() {
    std::vector<std::vector<FrontPoint>> cells(settings_.cells);
    for (FrontPoint& point : points_) cells[cell_of(point)].push_back(std::move(point));
    points_.clear();
    for (auto& cell : cells) {
      std::stable_sort(cell.begin(), cell.end(), [this](const FrontPoint& a, const FrontPoint& b) {
        return (a.values - origin()).norm() < (b.values - origin()).norm();
      });
      if (cell.size() > static_cast<std::size_t>(settings_.cell_points)) cell.resize(settings_.cell_points);
      for (const FrontPoint& point : cell) points_.push_back(point);
    }
    std::erase_if(cells, [](const auto& cell) { return cell.empty(); });
    cells_ = std::move(cells);
  }

  const std::vector<FrontPoint>& points() const { return points_; }
  std::vector<std::vector<FrontPoint>> take_cells() { return std::move(cells_); }

 private:
  Vector2d origin() const { return ideal_.array() - 0.01; }
  std::size_t cell_of(const FrontPoint& point) const {
    const Vector2d from = point.values - origin();
    const double share = std::atan2(from[1], from[0]) / (std::numbers::pi / 2.0);
    return static_cast<std::size_t>(std::clamp(static_cast<int>(share * settings_.cells), 0, settings_.cells - 1));
  }

  DiscoverySettings settings_;
  Vector2d ideal_ = Vector2d::Zero();
  std::vector<FrontPoint> points_;
  std::vector<std::vector<FrontPoint>> cells_;
};

struct Approach {
  const SmoothPair& pair;
  Vector2d target;
};

/// Half the squared distance to the target, and its gradient.
double distance_to_target(const std::vector<double>& at, std::vector<double>& gradient, void* data) {
  const Approach& approach = *static_cast<Approach*>(data);
  const Eigen::Map<const VectorXd> point(at.data(), static_cast<Index>(at.size()));
  const Vector2d apart = approach.pair.values(point) - approach.target;
  if (!gradient.empty()) {
    Eigen::Map<VectorXd>(gradient.data(), point.size()) =
        apart[0] * approach.pair.gradient(0, point) + apart[1] * approach.pair.gradient(1, point);
  }
  return 0.5 * apart.squaredNorm();
}

VectorXd approached(Approach approach, const VectorXd& start, double edge) {
  std::vector<double> at(start.data(), start.data() + start.size());
  nlopt::opt search(nlopt::LD_LBFGS, static_cast<unsigned>(at.size()));
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(edge);
  search.set_maxeval(kLocalEvaluations);
  search.set_min_objective(distance_to_target, &approach);
  try {
    double value = 0.0;
    search.optimize(at, value);
  } catch (const std::runtime_error&) {  // no progress possible any more: `at` is the best so far
  }
  return Eigen::Map<const VectorXd>(at.data(), start.size()).cwiseMax(0.0).cwiseMin(edge);
}

/// Direction in which the front goes on from a local optimum: H v = grad f_1 - grad f_2 on the coordinates that no
/// bound holds, H the Hessian of the weighted sum that the point minimises (from the conditions of Karush, Kuhn and
/// Tucker). Conjugate gradients with Hessian products by differences of gradients, stopped at negative curvature.
VectorXd tangent(const SmoothPair& pair, const VectorXd& at, double edge) {
  constexpr int kMostProducts = 10;
  const VectorXd first = pair.gradient(0, at), second = pair.gradient(1, at);
  const auto is_free = (at.array() > 1e-9 && at.array() < edge - 1e-9).cast<double>();
  const VectorXd mask = is_free.matrix();
  const VectorXd apart = (first - second).cwiseProduct(mask);
  const double square = apart.squaredNorm();
  if (square < 1e-20) return VectorXd::Zero(at.size());
  const double weight = std::clamp(-second.cwiseProduct(mask).dot(apart) / square, 0.0, 1.0);
  const VectorXd here = weight * first + (1.0 - weight) * second;
  const auto product = [&](const VectorXd& direction) -> VectorXd {
    const double step = 1e-4 * edge / direction.norm();
    const VectorXd there = at + step * direction;
    const VectorXd change = weight * pair.gradient(0, there) + (1.0 - weight) * pair.gradient(1, there) - here;
    return change.cwiseProduct(mask) / step;
  };
  VectorXd solution = VectorXd::Zero(at.size()), residual = apart, direction = apart;
  for (int i = 0; i < kMostProducts; ++i) {
    const VectorXd image = product(direction);
    const double curvature = direction.dot(image);
    if (curvature <= 0.0) break;
    const double old_square = residual.squaredNorm(), length = old_square / curvature;
    solution += length * direction;
    residual -= length * image;
    if (residual.squaredNorm() < 1e-4 * square) break;
    direction = residual + residual.squaredNorm() / old_square * direction;
  }
  return solution.squaredNorm() > 0.0 ? solution : apart;
}

/// Points on both sides of a local optimum along its tangent, as far as the box goes.
void expand(const SmoothPair& pair, const VectorXd& optimum, int family, double edge, Buffer& buffer) {
  const VectorXd direction = tangent(pair, optimum, edge);
  MatrixXd points(1 + kExpansionPoints, optimum.size());
  points.row(0) = optimum;
  const double longest = direction.cwiseAbs().maxCoeff();
  for (int i = 0; i < kExpansionPoints; ++i) {
    const double step = longest > 0.0 ? edge * (2.0 * (i + 0.5) / kExpansionPoints - 1.0) / longest : 0.0;
    points.row(i + 1) = (optimum + step * direction).cwiseMax(0.0).cwiseMin(edge);
  }
  const Eigen::MatrixX2d values = pair.values_all(points);
  for (Index i = 0; i < points.rows(); ++i) buffer.add({points.row(i), values.row(i), family});
}

VectorXd perturbed(const VectorXd& at, double edge, RandomStream& random) {
  const double size = edge * std::exp2(-random.uniform(0.0, 10.0));
  VectorXd moved = at;
  for (double& coordinate : moved) coordinate += size * random.uniform(-1.0, 1.0);
  return moved.cwiseMax(0.0).cwiseMin(edge);
}

}  // namespace

std::vector<std::vector<FrontPoint>> discover_front(const SmoothPair& pair, const std::vector<VectorXd>& start,
                                                    const DiscoverySettings& settings, RandomStream& random) {
  Buffer buffer(settings);
  int family = 0;
  for (const VectorXd& point : start) buffer.add({point, pair.values(point), family++});
  buffer.tidy();
  for (int generation = 0; generation < settings.generations; ++generation) {
    const std::vector<FrontPoint> parents = buffer.points();
    for (int i = 0; i < settings.local_searches; ++i) {
      const VectorXd& parent = parents[random.index(static_cast<int>(parents.size()))].at;
      const VectorXd from = perturbed(parent, settings.edge, random);
      const Vector2d values = pair.values(from);
      const double angle = random.uniform(0.0, std::numbers::pi / 2.0);
      const Vector2d target =
          values - kReach * std::max(values.norm(), 0.1) * Vector2d(std::cos(angle), std::sin(angle));
      expand(pair, approached({pair, target}, from, settings.edge), family++, settings.edge, buffer);
    }
    buffer.tidy();
  }
  return buffer.take_cells();
}

}  // namespace nacre::explore
