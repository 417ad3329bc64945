#include "diagnosis/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nacre::diagnosis {
namespace {

/// Finite-difference step in coordinates: well above what curves of fracture tests jump by, well below the curvature of
/// log E.
constexpr double kSlopeStep = 0.01;

double prior_chi2(const FittedModel& fit, const Eigen::VectorXd& u) {
  return ((u.head(fit.base_count).array() - 0.5) / fit.prior_sd.array()).square().sum();
}

Eigen::VectorXd clamped(const CoordinateMap& map, Eigen::VectorXd u) {
  for (int i = 0; i < map.size(); ++i) u[i] = std::clamp(u[i], map.lower(i), map.upper(i));
  return u;
}

/// Coordinates that may move at all, and are not at a bound which the descent direction would leave.
std::vector<int> free_coordinates(const FittedModel& fit, const CoordinateMap& map, const Eigen::VectorXd& y,
                                  const Whitener& whitener, const std::vector<int>& held) {
  FittedModel whole = fit;
  whole.free_all();
  const Eigen::VectorXd descent = whole.whitened_columns(whitener).transpose() * whole.whitened_residual(y, whitener);
  std::vector<int> free;
  for (int i = 0; i < map.size(); ++i) {
    const bool leaves =
        (fit.u[i] <= map.lower(i) && descent[i] < 0.0) || (fit.u[i] >= map.upper(i) && descent[i] > 0.0);
    if (!leaves && std::ranges::find(held, i) == held.end()) free.push_back(i);
  }
  return free;
}

/// Levenberg-Marquardt step over the free coordinates.
Eigen::VectorXd damped_step(const FittedModel& fit, const Eigen::VectorXd& y, const Whitener& whitener,
                            double damping) {
  const Eigen::MatrixXd a = fit.whitened_columns(whitener);
  Eigen::MatrixXd normal = a.transpose() * a;
  normal.diagonal() *= 1.0 + damping;
  const Eigen::VectorXd step = normal.ldlt().solve(a.transpose() * fit.whitened_residual(y, whitener));
  Eigen::VectorXd full = Eigen::VectorXd::Zero(fit.u.size());
  full(fit.free) = step;
  return full;
}

/// A share ends at the whole: that bound is physics, not a choice.
bool is_share(const material::EffectParameter& parameter) {
  return parameter.unit == "1" && parameter.minimum == 0.0 && parameter.maximum == 1.0;
}

/// An extension at a bound other than zero: its range does not hold the truth.
bool ends_on_bound(const CoordinateMap& map, const Eigen::VectorXd& u) {
  for (std::size_t k = 0; k < map.effects().size(); ++k) {
    const material::Effect& effect = *material::find_effect(map.effects()[k]);
    for (int p = 0; p < map.count_of(effect); ++p) {
      const int i = map.first_coordinate(k) + p;
      if (is_share(effect.parameter(p))) continue;
      for (const double bound : {map.lower(i), map.upper(i)}) {
        if (bound != 0.0 && std::abs(u[i] - bound) < 1e-6) return true;
      }
    }
  }
  return false;
}

}  // namespace

void FittedModel::free_all() {
  free.resize(u.size());
  std::iota(free.begin(), free.end(), 0);
}

Eigen::MatrixXd FittedModel::whitened_columns(const Whitener& whitener) const {
  const Eigen::Index n = jacobian.rows();
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n + base_count, static_cast<Eigen::Index>(free.size()));
  columns.topRows(n) = whitener(jacobian(Eigen::all, free));
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (free[k] < base_count) columns(n + free[k], static_cast<Eigen::Index>(k)) = 1.0 / prior_sd[free[k]];
  }
  return columns;
}

Eigen::VectorXd FittedModel::whitened_residual(const Eigen::VectorXd& y, const Whitener& whitener) const {
  Eigen::VectorXd residual(y.size() + base_count);
  residual.head(y.size()) = whitener(y - predicted);
  for (int i = 0; i < base_count; ++i) residual[y.size() + i] = (0.5 - u[i]) / prior_sd[i];
  return residual;
}

FittedModel FittedModel::restricted(const std::vector<Eigen::Index>& rows) const {
  FittedModel part = *this;
  part.predicted = predicted(rows);
  part.jacobian = jacobian(rows, Eigen::all);
  return part;
}

double FittedModel::variance(int coordinate, const Whitener& whitener) const {
  const auto place = std::find(free.begin(), free.end(), coordinate);
  if (place == free.end()) return 0.0;
  const Eigen::MatrixXd a = whitened_columns(whitener);
  const Eigen::Index k = place - free.begin();
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(a.cols(), k);
  return (a.transpose() * a).ldlt().solve(unit)[k];
}

namespace {

/// A fit at its initial guess, with bounds, prior and predictions.
FittedModel initial_fit(const FeatureModel& model, const CoordinateMap& map, const Eigen::VectorXd& start) {
  FittedModel fit;
  fit.effects = map.effects();
  fit.base_count = map.base_count();
  fit.prior_sd.resize(fit.base_count);
  for (int i = 0; i < fit.base_count; ++i) fit.prior_sd[i] = map.prior_sd(i);
  fit.u = clamped(map, start);
  fit.lower = fit.upper = fit.u;
  for (int i = 0; i < map.size(); ++i) fit.lower[i] = map.lower(i), fit.upper[i] = map.upper(i);
  fit.predicted = model.predict(map, fit.u);
  return fit;
}

}  // namespace

Eigen::VectorXd widened_start(const FittedModel& fit, const CoordinateMap& map) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(map.size());
  u.head(fit.u.size()) = fit.u;
  for (int i = static_cast<int>(fit.u.size()) + 1; i < map.size(); ++i) u[i] = map.usual(i);
  return u;
}

FittedModel linearised(const FeatureModel& model, const std::vector<std::string>& effects, const Eigen::VectorXd& u) {
  const CoordinateMap map = model.map(effects);
  FittedModel fit = initial_fit(model, map, u);
  fit.jacobian = model.slopes(map, fit.u, fit.predicted, kSlopeStep);
  fit.free_all();
  fit.parameters = map.parameters(fit.u);
  return fit;
}

FittedModel fit_model(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                      const std::vector<std::string>& effects, const Eigen::VectorXd& start,
                      const std::vector<int>& held) {
  const CoordinateMap map = model.map(effects);
  const Eigen::VectorXd& y = observations.values;
  const Whitener whitener(observations.covariance());
  FittedModel fit = initial_fit(model, map, start);
  fit.chi2 = whitener.chi2(y - fit.predicted) + prior_chi2(fit, fit.u);
  double damping = 1e-3;
  for (int iteration = 0; iteration < rules.iterations; ++iteration) {
    fit.jacobian = model.slopes(map, fit.u, fit.predicted, kSlopeStep);
    fit.free = free_coordinates(fit, map, y, whitener, held);
    double gained = 0.0;
    for (int attempt = 0; attempt < 6 && gained <= 0.0; ++attempt) {
      const Eigen::VectorXd candidate = clamped(map, fit.u + damped_step(fit, y, whitener, damping));
      const Eigen::VectorXd predicted = model.predict(map, candidate);
      const double chi2 = whitener.chi2(y - predicted) + prior_chi2(fit, candidate);
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
    if (gained < rules.converged) break;
  }
  fit.jacobian = model.slopes(map, fit.u, fit.predicted, kSlopeStep);
  fit.free = free_coordinates(fit, map, y, whitener, held);
  fit.parameters = map.parameters(fit.u);
  fit.extension_on_bound = ends_on_bound(map, fit.u);
  return fit;
}

double linear_refit(const FittedModel& fit, const Eigen::VectorXd& y, const Whitener& whitener, Eigen::VectorXd* delta,
                    const Eigen::VectorXd& effect_sd) {
  // Data that no longer determine a coordinate would send it out of its range: it is put at its bound, and the others
  // are solved for again.
  FittedModel part = fit;
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(fit.u.size());
  Eigen::VectorXd b = fit.whitened_residual(y, whitener);
  const Eigen::Index rows = b.size();
  b.conservativeResizeLike(Eigen::VectorXd::Zero(rows + effect_sd.size()));
  while (!part.free.empty()) {
    Eigen::MatrixXd a = part.whitened_columns(whitener);
    a.conservativeResizeLike(Eigen::MatrixXd::Zero(b.size(), a.cols()));
    for (std::size_t k = 0; k < part.free.size() && effect_sd.size() > 0; ++k)
      if (const int effect = part.free[k] - fit.base_count; effect >= 0)
        a(rows + effect, static_cast<Eigen::Index>(k)) = 1.0 / effect_sd[effect];
    const Eigen::VectorXd step = a.householderQr().solve(b);
    Eigen::Index worst = -1;
    double excess = 1e-9, bounded = 0.0;
    for (Eigen::Index k = 0; k < step.size(); ++k) {
      const int i = part.free[k];
      const double inside = std::clamp(fit.u[i] + step[k], fit.lower[i], fit.upper[i]) - fit.u[i];
      if (std::abs(step[k] - inside) > excess) excess = std::abs(step[k] - inside), worst = k, bounded = inside;
    }
    if (worst < 0) {
      for (Eigen::Index k = 0; k < step.size(); ++k) moved[part.free[k]] = step[k];
      b -= a * step;
      break;
    }
    moved[part.free[worst]] = bounded;
    b -= a.col(worst) * bounded;
    part.free.erase(part.free.begin() + worst);
  }
  if (delta) *delta = moved;
  return b.squaredNorm();
}

}  // namespace nacre::diagnosis
