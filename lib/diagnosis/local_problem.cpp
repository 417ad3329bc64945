#include "diagnosis/local_problem.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/bounded_least_squares.hpp"

namespace nacre::diagnosis {
namespace {

/// What a step of 1 along every coordinate does to the whitened rows and the prior.
Eigen::VectorXd scale_of(FittedModel fit, const Whitener& whitener) {
  constexpr double kLeast = 1e-6;
  fit.free_all();
  return fit.whitened_columns(whitener).colwise().norm().cwiseMax(kLeast);
}

std::vector<int> all_but(const std::vector<int>& held, Eigen::Index count) {
  std::vector<int> free;
  for (int i = 0; i < count; ++i)
    if (std::ranges::find(held, i) == held.end()) free.push_back(i);
  return free;
}

}  // namespace

LocalProblem::LocalProblem(const FittedModel& fit, const Eigen::VectorXd& values, const Whitener& whitener,
                           const std::vector<int>& held, const std::vector<KnownPoint>& past)
    : fit_(fit),
      values_(values),
      whitener_(whitener),
      scale_(scale_of(fit, whitener)),
      local_({fit.u, fit.predicted}, fit.jacobian, scale_, past),
      free_(all_but(held, fit.u.size())) {}

Eigen::VectorXd LocalProblem::minimum(double damping, double tolerance) const {
  constexpr int kSteps = 20;
  constexpr double kShortest = 0.02;
  Eigen::VectorXd u = fit_.u;
  double least = objective(u, damping);
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::VectorXd step = step_from(u, damping);
    double gained = 0.0;
    for (double share = 1.0; gained <= 0.0 && share > kShortest; share *= 0.5) {
      const Eigen::VectorXd candidate = u + share * step;
      gained = least - objective(candidate, damping);
      if (gained > 0.0) u = candidate;
    }
    least -= gained;
    if (gained < tolerance) break;
  }
  return u;
}

double LocalProblem::chi2(const Eigen::VectorXd& u) const {
  return whitener_.chi2(values_ - local_.rows(u)) + fit_.prior_chi2(u);
}

double LocalProblem::objective(const Eigen::VectorXd& u, double damping) const {
  return chi2(u) + damping * (u - fit_.u).cwiseProduct(scale_).squaredNorm();
}

Eigen::VectorXd LocalProblem::step_from(const Eigen::VectorXd& u, double damping) const {
  FittedModel at = fit_;
  at.u = u;
  at.predicted = local_.rows(u);
  at.jacobian = local_.slopes(u);
  at.free = free_;
  const Eigen::MatrixXd columns = at.whitened_columns(whitener_);
  const Eigen::VectorXd damped = std::sqrt(damping) * scale_(free_);
  const Eigen::Index rows = columns.rows(), count = columns.cols();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows + count, count);
  a.topRows(rows) = columns;
  a.bottomRows(count).diagonal() = damped;
  Eigen::VectorXd b(rows + count);
  b << at.whitened_residual(values_, whitener_), damped.cwiseProduct((fit_.u - u)(free_));
  Eigen::VectorXd step = Eigen::VectorXd::Zero(u.size());
  step(free_) = bounded_least_squares(a, b, (fit_.lower - u)(free_), (fit_.upper - u)(free_)).x;
  return step;
}

}  // namespace nacre::diagnosis
