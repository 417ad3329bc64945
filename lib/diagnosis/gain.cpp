#include "diagnosis/gain.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace nacre::diagnosis {
namespace {

constexpr int kFolds = 5;
constexpr int kIntervalDraws = 2000;

/// The rows of a fit that belong to `rows`.
Fit restricted(const Fit& fit, const std::vector<Eigen::Index>& rows) {
  Fit part = fit;
  part.predicted = fit.predicted(rows);
  part.jacobian = fit.jacobian(rows, Eigen::all);
  return part;
}

/// Errors of one design before and after.
struct DesignErrors {
  double before = 0.0, after = 0.0;
  int groups = 0;
};

struct Refit {
  double chi2 = 0.0;
  Eigen::VectorXd delta;
};

Refit refit(const Fit& fit, const std::vector<Eigen::Index>& rows, const Eigen::VectorXd& y, const Whitener& whitener) {
  Refit result;
  result.chi2 = linear_refit(restricted(fit, rows), y(rows), whitener, &result.delta);
  return result;
}

/// log E of all groups by a model refitted to `rows`, with what those rows say of the numerics that all layouts share.
Eigen::VectorXd predicted_from(const Observations& observations, const Fit& fit, const Refit& refit, const std::vector<Eigen::Index>& rows) {
  const Eigen::VectorXd model = fit.predicted + fit.jacobian * refit.delta;
  const Eigen::VectorXd residuals = observations.log_moduli() - model;
  return model + observations.shared_numerics(residuals(rows), rows);
}

double reduction(const std::vector<DesignErrors>& errors, const std::vector<std::size_t>& picks) {
  double before = 0.0, after = 0.0;
  for (const std::size_t i : picks) before += errors[i].before, after += errors[i].after;
  return before > 0.0 ? 1.0 - after / before : 0.0;
}

}  // namespace

Gain held_out_gain(const Observations& observations, const Fit& base, const std::vector<Fit>& models, double drop_needed, std::uint64_t seed) {
  const Eigen::VectorXd y = observations.log_moduli();
  const Eigen::MatrixXd covariance = observations.covariance();
  // Folds of whole designs, dealt by a seeded shuffle.
  std::map<std::string, std::vector<Eigen::Index>> rows_of;
  for (int i = 0; i < observations.size(); ++i) rows_of[observations.groups[static_cast<std::size_t>(i)].design.name()].push_back(i);
  std::vector<std::vector<Eigen::Index>> designs;
  for (const auto& [name, rows] : rows_of) designs.push_back(rows);
  RandomStream random(seed, "gain/folds");
  for (std::size_t i = designs.size(); i > 1; --i) std::swap(designs[i - 1], designs[static_cast<std::size_t>(random.index(static_cast<int>(i)))]);

  std::vector<DesignErrors> errors(designs.size());
  for (int fold = 0; fold < kFolds; ++fold) {
    std::vector<Eigen::Index> train;
    for (std::size_t d = 0; d < designs.size(); ++d) {
      if (static_cast<int>(d) % kFolds != fold) train.insert(train.end(), designs[d].begin(), designs[d].end());
    }
    std::sort(train.begin(), train.end());
    const Whitener whitener(covariance(train, train));
    const Refit plain = refit(base, train, y, whitener);
    const Fit* chosen = &base;
    Refit chosen_refit = plain;
    for (const Fit& model : models) {
      const Refit own = refit(model, train, y, whitener);
      if (own.chi2 < chosen_refit.chi2 && own.chi2 < plain.chi2 - drop_needed) chosen = &model, chosen_refit = own;
    }
    const Eigen::VectorXd before = y - predicted_from(observations, base, plain, train), after = y - predicted_from(observations, *chosen, chosen_refit, train);
    for (std::size_t d = static_cast<std::size_t>(fold); d < designs.size(); d += kFolds) {
      for (const Eigen::Index row : designs[d]) {
        errors[d].before += std::abs(before[row]);
        errors[d].after += std::abs(after[row]);
        ++errors[d].groups;
      }
    }
  }

  Gain gain;
  int groups = 0;
  std::vector<std::size_t> all(errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    all[i] = i;
    gain.held_out_error_before += errors[i].before;
    gain.held_out_error_after += errors[i].after;
    groups += errors[i].groups;
  }
  gain.held_out_error_before /= groups;
  gain.held_out_error_after /= groups;
  gain.relative_reduction = reduction(errors, all);
  RandomStream draws(seed, "gain/interval");
  std::vector<double> reductions;
  for (int i = 0; i < kIntervalDraws; ++i) {
    std::vector<std::size_t> picks(errors.size());
    for (std::size_t& pick : picks) pick = static_cast<std::size_t>(draws.index(static_cast<int>(errors.size())));
    reductions.push_back(reduction(errors, picks));
  }
  std::sort(reductions.begin(), reductions.end());
  gain.interval_low = reductions[kIntervalDraws / 20];
  gain.interval_high = reductions[kIntervalDraws - 1 - kIntervalDraws / 20];
  return gain;
}

}  // namespace nacre::diagnosis
