#include "diagnosis/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/bounded_least_squares.hpp"
#include "diagnosis/local_problem.hpp"

namespace nacre::diagnosis {
namespace {

/// Finite-difference step in coordinates: well above what curves of fracture tests jump by, well below the curvature of
/// log E.
constexpr double kSlopeStep = 0.01;

/// Damping of Levenberg and Marquardt, as shares of the curvature. Below the one after a failure steps are the same.
constexpr double kFirstDamping = 1e-3, kFailedDamping = 0.01;
constexpr int kAttempts = 6;  ///< of a step

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

double FittedModel::prior_chi2(const Eigen::VectorXd& at) const {
  return ((at.head(base_count).array() - 0.5) / prior_sd.array()).square().sum();
}

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

namespace {

/// Levenberg-Marquardt on the local model of what was simulated on the way.
class Descent {
 public:
  Descent(const FeatureModel& model, const CoordinateMap& map, const Observations& observations,
          const std::vector<int>& held, const Eigen::VectorXd& start, double converged)
      : model_(model),
        map_(map),
        observations_(observations),
        whitener_(observations.covariance()),
        held_(held),
        converged_(converged),
        fit_(initial_fit(model, map, start)) {
    fit_.chi2 = chi2_of(fit_.u, fit_.predicted);
    fit_.jacobian = model.slopes(map, fit_.u, fit_.predicted, kSlopeStep);
  }
  /// Whether the local model promises less than matters.
  bool is_at_end() const {
    const LocalProblem local = local_problem();
    return fit_.chi2 - local.chi2(local.minimum(0.0, tolerance())) < enough();
  }
  /// A drop of chi squared that is none: converged, and as many times that as the fit misfits.
  double enough() const { return converged_ * std::max(1.0, fit_.chi2 / static_cast<double>(fit_.predicted.size())); }
  /// One step, shorter until chi squared falls. Returns by how much; 0 where it does not.
  double step() {
    double raise = 2.0;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const LocalProblem local = local_problem();
      const Eigen::VectorXd candidate = clamped(map_, local.minimum(damping_, tolerance()));
      const double promised = fit_.chi2 - local.chi2(candidate);
      if (promised < tolerance()) return 0.0;
      const Eigen::VectorXd predicted = model_.predict(map_, candidate);
      if (const double gained = fit_.chi2 - chi2_of(candidate, predicted); gained > 0.0) {
        move_to(candidate, predicted, gained);
        damping_ *= std::max(0.1, 1.0 - std::pow(2.0 * gained / promised - 1.0, 3));
        return gained;
      }
      past_.push_back({candidate, predicted});
      damping_ = std::max(kFailedDamping, damping_ * raise);
      raise *= 2.0;
    }
    return 0.0;
  }
  FittedModel end() && {
    fit_.free = free_coordinates(fit_, map_, observations_.values, whitener_, held_);
    fit_.parameters = map_.parameters(fit_.u);
    fit_.extension_on_bound = ends_on_bound(map_, fit_.u);
    return std::move(fit_);
  }

 private:
  double tolerance() const { return 0.1 * enough(); }
  LocalProblem local_problem() const { return {fit_, observations_.values, whitener_, held_, past_}; }
  double chi2_of(const Eigen::VectorXd& u, const Eigen::VectorXd& rows) const {
    return whitener_.chi2(observations_.values - rows) + fit_.prior_chi2(u);
  }
  void move_to(const Eigen::VectorXd& u, const Eigen::VectorXd& rows, double gained) {
    past_.push_back({fit_.u, fit_.predicted});
    fit_.u = u;
    fit_.predicted = rows;
    fit_.chi2 -= gained;
    fit_.jacobian = model_.slopes(map_, u, rows, kSlopeStep);
  }

  const FeatureModel& model_;
  const CoordinateMap& map_;
  const Observations& observations_;
  Whitener whitener_;
  const std::vector<int>& held_;
  double converged_;
  FittedModel fit_;
  double damping_ = kFirstDamping;
  std::vector<KnownPoint> past_;  ///< that were simulated, the latest last
};

}  // namespace

FittedModel fit_model(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                      const std::vector<std::string>& effects, const Eigen::VectorXd& start,
                      const std::vector<int>& held) {
  const CoordinateMap map = model.map(effects);
  Descent descent(model, map, observations, held, start, rules.converged);
  for (int i = 0; i < rules.iterations && !descent.is_at_end(); ++i)
    if (descent.step() < descent.enough()) break;
  return std::move(descent).end();
}

double linear_refit(const FittedModel& fit, const Eigen::VectorXd& y, const Whitener& whitener, Eigen::VectorXd* delta,
                    const Eigen::VectorXd& effect_sd) {
  Eigen::MatrixXd a = fit.whitened_columns(whitener);
  Eigen::VectorXd b = fit.whitened_residual(y, whitener);
  const Eigen::Index rows = b.size();
  b.conservativeResizeLike(Eigen::VectorXd::Zero(rows + effect_sd.size()));
  a.conservativeResizeLike(Eigen::MatrixXd::Zero(b.size(), a.cols()));
  for (std::size_t k = 0; k < fit.free.size() && effect_sd.size() > 0; ++k)
    if (const int effect = fit.free[k] - fit.base_count; effect >= 0)
      a(rows + effect, static_cast<Eigen::Index>(k)) = 1.0 / effect_sd[effect];
  const BoundedSolution solved =
      bounded_least_squares(a, b, (fit.lower - fit.u)(fit.free), (fit.upper - fit.u)(fit.free));
  if (delta) {
    *delta = Eigen::VectorXd::Zero(fit.u.size());
    (*delta)(fit.free) = solved.x;
  }
  return solved.rest;
}

}  // namespace nacre::diagnosis
