#include "diagnosis/bounded_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nacre::diagnosis {
namespace {

constexpr double kOutside = 1e-9;  ///< of its bounds: rounding

/// Solves for the open unknowns; the way there ends where the first reaches a bound, which is closed, and so on.
void solve_for_open(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& low,
                    const Eigen::VectorXd& high, std::vector<Eigen::Index>& open, Eigen::VectorXd& x) {
  while (!open.empty()) {
    const Eigen::MatrixXd columns = a(Eigen::all, open);
    const Eigen::VectorXd step = columns.householderQr().solve(b - a * x);
    double share = 1.0;
    std::size_t first = open.size();
    for (std::size_t k = 0; k < open.size(); ++k) {
      const Eigen::Index i = open[k];
      const double end = x[i] + step[static_cast<Eigen::Index>(k)];
      if (end >= low[i] - kOutside && end <= high[i] + kOutside) continue;
      const double to_bound = ((end < low[i] ? low[i] : high[i]) - x[i]) / (end - x[i]);
      if (first == open.size() || to_bound < share) share = to_bound, first = k;
    }
    x(open) += share * step;
    if (first == open.size()) return;
    const Eigen::Index closed = open[first];
    x[closed] = step[static_cast<Eigen::Index>(first)] < 0.0 ? low[closed] : high[closed];
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

/// The unknown at a bound that would lower the sum most inside it; -1 where none does.
Eigen::Index to_open(const Eigen::MatrixXd& a, const Eigen::VectorXd& rest, const Eigen::VectorXd& low,
                     const Eigen::VectorXd& high, const std::vector<Eigen::Index>& open, const Eigen::VectorXd& x) {
  constexpr double kFlat = 1e-10;
  const Eigen::VectorXd descent = a.transpose() * rest;
  Eigen::Index best = -1;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const bool leads_inside = descent[i] > 0.0 ? x[i] < high[i] - kOutside : x[i] > low[i] + kOutside;
    if (!leads_inside || std::ranges::find(open, i) != open.end()) continue;
    if (std::abs(descent[i]) <= kFlat * a.col(i).norm() * rest.norm()) continue;
    if (best < 0 || std::abs(descent[i]) > std::abs(descent[best])) best = i;
  }
  return best;
}

}  // namespace

BoundedSolution bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& low,
                                      const Eigen::VectorXd& high) {
  constexpr int kMostOpened = 50;
  BoundedSolution solved{Eigen::VectorXd::Zero(a.cols())};
  std::vector<Eigen::Index> open;
  for (Eigen::Index k = 0; k < a.cols(); ++k)
    if (!a.col(k).isZero(0.0)) open.push_back(k);
  for (int opened = 0; opened < kMostOpened; ++opened) {
    solve_for_open(a, b, low, high, open, solved.x);
    const Eigen::VectorXd rest = b - a * solved.x;
    solved.rest = rest.squaredNorm();
    const Eigen::Index next = to_open(a, rest, low, high, open, solved.x);
    if (next < 0) break;
    open.push_back(next);
  }
  return solved;
}

}  // namespace nacre::diagnosis
