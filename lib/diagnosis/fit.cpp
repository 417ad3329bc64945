#include "diagnosis/fit.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::diagnosis {
namespace {

/// Finite-difference step in coordinates: well above the solver's error, well below the curvature of log E.
constexpr double kStep = 0.01;
constexpr int kIterations = 12;
/// A drop of chi2 that no threshold would notice.
constexpr double kConverged = 0.02;

double prior_chi2(const Eigen::VectorXd& u) { return ((u.head(kBaseCount).array() - 0.5) / kPriorSd).square().sum(); }

double weighted_chi2(const Eigen::VectorXd& residual, const Eigen::VectorXd& variances) {
  return (residual.array().square() / variances.array()).sum();
}

/// Columns d log E / d u by one-sided differences that stay inside the bounds.
Eigen::MatrixXd jacobian_at(const ModulusModel& model, const CoordinateMap& map, const Eigen::VectorXd& u, const Eigen::VectorXd& predicted) {
  std::vector<material::ParameterSet> sets;
  std::vector<double> steps;
  for (int i = 0; i < map.size(); ++i) {
    Eigen::VectorXd moved = u;
    steps.push_back(u[i] + kStep <= map.upper(i) ? kStep : -kStep);
    moved[i] += steps.back();
    sets.push_back(map.parameters(moved));
  }
  Eigen::MatrixXd columns = model.predict(sets);
  for (int i = 0; i < map.size(); ++i) columns.col(i) = (columns.col(i) - predicted) / steps[static_cast<std::size_t>(i)];
  return columns;
}

/// Whitened system [W^1/2 J; prior] delta = [W^1/2 r; prior residual].
struct WhitenedSystem {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
};

WhitenedSystem whiten(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual, const Eigen::VectorXd& variances, const Eigen::VectorXd& u) {
  const Eigen::Index n = jacobian.rows();
  WhitenedSystem system{Eigen::MatrixXd::Zero(n + kBaseCount, jacobian.cols()), Eigen::VectorXd(n + kBaseCount)};
  const Eigen::VectorXd weight = variances.cwiseSqrt().cwiseInverse();
  system.a.topRows(n) = weight.asDiagonal() * jacobian;
  system.b.head(n) = weight.cwiseProduct(residual);
  for (int i = 0; i < kBaseCount; ++i) {
    system.a(n + i, i) = 1.0 / kPriorSd;
    system.b[n + i] = (0.5 - u[i]) / kPriorSd;
  }
  return system;
}

Eigen::VectorXd clamped(const CoordinateMap& map, Eigen::VectorXd u) {
  for (int i = 0; i < map.size(); ++i) u[i] = std::clamp(u[i], map.lower(i), map.upper(i));
  return u;
}

/// Levenberg-Marquardt step; coordinates that stand on a bound and would leave it are held.
Eigen::VectorXd damped_step(const WhitenedSystem& system, const CoordinateMap& map, const Eigen::VectorXd& u, double damping) {
  Eigen::MatrixXd normal = system.a.transpose() * system.a;
  Eigen::VectorXd gradient = system.a.transpose() * system.b;
  normal.diagonal() *= 1.0 + damping;
  for (int i = 0; i < map.size(); ++i) {
    const bool held = (u[i] <= map.lower(i) && gradient[i] < 0.0) || (u[i] >= map.upper(i) && gradient[i] > 0.0);
    if (!held) continue;
    normal.row(i).setZero();
    normal.col(i).setZero();
    normal(i, i) = 1.0;
    gradient[i] = 0.0;
  }
  return normal.ldlt().solve(gradient);
}

/// An extension that ended on a bound other than zero says that the library's range does not hold the truth.
bool ends_on_bound(const CoordinateMap& map, const Eigen::VectorXd& u) {
  for (int i = kBaseCount; i < map.size(); ++i) {
    for (const double bound : {map.lower(i), map.upper(i)}) {
      if (bound != 0.0 && std::abs(u[i] - bound) < 1e-6) return true;
    }
  }
  return false;
}

}  // namespace

Eigen::MatrixXd Fit::covariance(const Eigen::VectorXd& variances) const {
  const WhitenedSystem system = whiten(jacobian, Eigen::VectorXd::Zero(jacobian.rows()), variances, u);
  const Eigen::MatrixXd normal = system.a.transpose() * system.a;
  return normal.ldlt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
}

Fit fit_model(const ModulusModel& model, const Observations& observations, const std::vector<std::string>& effects, const Eigen::VectorXd& start) {
  const CoordinateMap map(effects);
  const Eigen::VectorXd y = observations.log_moduli(), variances = observations.variances();
  Fit fit;
  fit.effects = effects;
  fit.u = clamped(map, start);
  fit.predicted = model.predict(map.parameters(fit.u));
  fit.chi2 = weighted_chi2(y - fit.predicted, variances) + prior_chi2(fit.u);
  double damping = 1e-3;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    fit.jacobian = jacobian_at(model, map, fit.u, fit.predicted);
    const WhitenedSystem system = whiten(fit.jacobian, y - fit.predicted, variances, fit.u);
    double gained = 0.0;
    for (int attempt = 0; attempt < 6 && gained <= 0.0; ++attempt) {
      const Eigen::VectorXd candidate = clamped(map, fit.u + damped_step(system, map, fit.u, damping));
      const Eigen::VectorXd predicted = model.predict(map.parameters(candidate));
      const double chi2 = weighted_chi2(y - predicted, variances) + prior_chi2(candidate);
      gained = fit.chi2 - chi2;
      if (gained > 0.0) {
        fit.u = candidate;
        fit.predicted = predicted;
        fit.chi2 = chi2;
        damping = std::max(1e-6, damping / 10.0);
      } else {
        damping *= 10.0;
      }
    }
    if (gained < kConverged) break;
  }
  fit.jacobian = jacobian_at(model, map, fit.u, fit.predicted);
  fit.parameters = map.parameters(fit.u);
  fit.extension_on_bound = ends_on_bound(map, fit.u);
  return fit;
}

double linear_refit(const Fit& fit, const Eigen::VectorXd& y, const Eigen::VectorXd& variances, Eigen::VectorXd* delta) {
  const WhitenedSystem system = whiten(fit.jacobian, y - fit.predicted, variances, fit.u);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(system.a);
  const Eigen::VectorXd step = qr.solve(system.b);
  if (delta) *delta = step;
  return (system.b - system.a * step).squaredNorm();
}

}  // namespace nacre::diagnosis
