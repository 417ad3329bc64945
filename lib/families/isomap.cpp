#include "families/isomap.hpp"

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <vector>

#include "base/parallel.hpp"
#include "base/result.hpp"

namespace nacre::families {
namespace {

constexpr double kFarAway = 10.0;  // times the largest finite distance
constexpr Eigen::Index kDenseSize = 200, kLanczosVectors = 20;

struct Edge {
  std::size_t to = 0;
  double length = 0.0;
};
using Graph = std::vector<std::vector<Edge>>;

Graph neighbour_graph(const DistanceMatrix& distances, std::size_t neighbours, double far) {
  const std::size_t count = distances.count();
  Graph graph(count);
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t near = std::min(neighbours + 1, count);  // itself is one of them
    std::partial_sort(order.begin(), order.begin() + static_cast<long>(near), order.end(),
                      [&](std::size_t a, std::size_t b) {
                        const double to_a = distances(i, a), to_b = distances(i, b);
                        return std::tuple(to_a, a != i, a) < std::tuple(to_b, b != i, b);
                      });
    for (std::size_t k = 0; k < near; ++k) {
      const double length = std::min(distances(i, order[k]), far);
      if (order[k] == i) continue;
      graph[i].push_back({order[k], length});
      graph[order[k]].push_back({i, length});
    }
  }
  return graph;
}

/// Number of the connected part that every node belongs to.
std::vector<std::size_t> parts_of(const Graph& graph, std::size_t& count) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> part(graph.size(), kNone), open;
  count = 0;
  for (std::size_t start = 0; start < graph.size(); ++start) {
    if (part[start] != kNone) continue;
    part[start] = count;
    open = {start};
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      for (const Edge& edge : graph[node]) {
        if (part[edge.to] != kNone) continue;
        part[edge.to] = count;
        open.push_back(edge.to);
      }
    }
    ++count;
  }
  return part;
}

/// Joins the two parts that lie nearest to each other until one is left. Returns the bridges built.
int bridge_parts(Graph& graph, const DistanceMatrix& distances, double far) {
  for (int bridges = 0;; ++bridges) {
    std::size_t parts = 0;
    const std::vector<std::size_t> part = parts_of(graph, parts);
    if (parts <= 1) return bridges;
    std::size_t from = 0, to = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < graph.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (part[i] != part[j] && std::min(distances(i, j), far) < shortest)
          shortest = std::min(distances(i, j), far), from = i, to = j;
    graph[from].push_back({to, shortest});
    graph[to].push_back({from, shortest});
  }
}

/// Dijkstra's shortest paths from one node.
void shortest_paths(const Graph& graph, std::size_t source, Eigen::Ref<Eigen::VectorXd> lengths) {
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  lengths.setConstant(std::numeric_limits<double>::infinity());
  lengths[source] = 0.0;
  queue.emplace(0.0, source);
  while (!queue.empty()) {
    const auto [length, node] = queue.top();
    queue.pop();
    if (length > lengths[node]) continue;
    for (const Edge& edge : graph[node]) {
      double& known = lengths[edge.to];
      if (length + edge.length >= known) continue;
      known = length + edge.length;
      queue.emplace(known, edge.to);
    }
  }
}

struct LeadingAxes {
  Eigen::Vector2d values;
  Eigen::MatrixX2d vectors;
};

/// The two leading eigenpairs by Lanczos' method; nothing when it breaks down, as it does where the rank is one.
std::optional<LeadingAxes> leading_axes(const Eigen::MatrixXd& matrix) {
  Spectra::DenseSymMatProd<double> operation(matrix);
  Spectra::SymEigsSolver<Spectra::DenseSymMatProd<double>> solver(operation, 2, kLanczosVectors);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
  const LeadingAxes axes{solver.eigenvalues(), solver.eigenvectors(2)};
  const Eigen::MatrixX2d residual = matrix * axes.vectors - axes.vectors * axes.values.asDiagonal();
  const bool right = residual.allFinite() && residual.norm() < 1e-6 * std::abs(axes.values[0]);
  return right ? std::optional(axes) : std::nullopt;
}

LeadingAxes leading_axes_dense(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues().tail<2>().reverse(), solver.eigenvectors().rightCols<2>().rowwise().reverse()};
}

/// The two leading coordinates of classical scaling.
Eigen::MatrixX2d scaled(const Eigen::MatrixXd& geodesics) {
  Eigen::MatrixXd products = -0.5 * geodesics.cwiseAbs2();
  const Eigen::VectorXd row_means = products.rowwise().mean();
  products.colwise() -= row_means;
  products.rowwise() -= products.colwise().mean().eval();
  std::optional<LeadingAxes> axes;
  if (products.cols() > kDenseSize) axes = leading_axes(products);
  if (!axes) axes = leading_axes_dense(products);
  Eigen::MatrixX2d points = axes->vectors;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    points.col(axis) *= std::sqrt(std::max(0.0, axes->values[axis]));
    Eigen::Index farthest = 0;  // an axis has no direction of its own: its farthest point lies on the positive side
    points.col(axis).cwiseAbs().maxCoeff(&farthest);
    if (points(farthest, axis) < 0.0) points.col(axis) *= -1.0;
  }
  return points;
}

double residual_variance(const Eigen::MatrixXd& geodesics, const Eigen::MatrixX2d& points) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (Eigen::Index i = 0; i < geodesics.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const double along = geodesics(i, j), straight = (points.row(i) - points.row(j)).norm();
      n += 1.0, x += along, y += straight, xx += along * along, yy += straight * straight, xy += along * straight;
    }
  const double covariance = xy - x * y / n, variances = (xx - x * x / n) * (yy - y * y / n);
  return variances > 0.0 ? 1.0 - covariance * covariance / variances : 0.0;
}

}  // namespace

Embedding isomap(const DistanceMatrix& distances, int neighbours) {
  if (distances.count() < 4 || neighbours < 1)
    throw InputError::format("isomap: expected at least four patterns and one neighbour, not {} and {}",
                             distances.count(), neighbours);
  const double far = kFarAway * std::max(largest_finite(distances), 1e-6);
  Graph graph = neighbour_graph(distances, neighbours, far);
  Embedding embedding;
  embedding.bridges = bridge_parts(graph, distances, far);
  const Eigen::Index count = distances.count();
  Eigen::MatrixXd geodesics(count, count);
  parallel_for(count, [&](int i) { shortest_paths(graph, i, geodesics.col(i)); });
  embedding.points = scaled(geodesics);
  embedding.residual_variance = residual_variance(geodesics, embedding.points);
  return embedding;
}

}  // namespace nacre::families
