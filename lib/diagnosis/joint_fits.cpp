#include "diagnosis/joint_fits.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/contrasts.hpp"

namespace nacre::diagnosis {
namespace {

const FitRules& rules_of(const Evidence& evidence) { return evidence.settings.procedure.fit; }

/// The base model with signatures and contrasts on top of it.
void put_base(Evidence& evidence, FittedModel base) {
  evidence.base.fit = std::move(base);
  evidence.base.signatures =
      signatures_on(evidence.model, evidence.base.fit, evidence.effects, rules_of(evidence).sizes);
  evidence.base.directions = contrast_directions(evidence.observations, evidence.base.fit.predicted);
}

/// Base and one effect, from the best initial guess.
FittedModel fit_single(const Evidence& evidence, std::size_t effect) {
  return fit_model(evidence.model, evidence.observations, rules_of(evidence), {evidence.effects[effect]},
                   best_initial_guess(evidence.model, evidence.observations, evidence.base.fit,
                                      evidence.base.signatures[effect], rules_of(evidence)));
}

/// First constants, with the effect size of the smallest chi squared there.
Eigen::VectorXd promising_initial_guess(const Evidence& evidence, const FittedModel& fit) {
  const Eigen::VectorXd first = at_first_constants(evidence, fit.u);
  const Eigen::Index own = evidence.base.fit.u.size();
  const CoordinateMap map = evidence.model.map(fit.effects);
  const Whitener whitener(evidence.observations.covariance());
  std::vector<Eigen::VectorXd> starts;
  for (const double size : rules_of(evidence).restart_sizes) {
    starts.push_back(first);
    starts.back()[own] = size;
  }
  const Eigen::MatrixXd predicted = evidence.model.predict(map, starts);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double chi2 = whitener.chi2(evidence.observations.values - predicted.col(static_cast<Eigen::Index>(i)));
    if (chi2 < least) least = chi2, best = i;
  }
  return starts[best];
}

/// The base is restarted from where the best extended fit ended: a gain must not be better optimisation. Where that
/// helps it, every effect is restarted from there.
void restart_base(Evidence& evidence) {
  const auto best = std::min_element(evidence.singles.begin(), evidence.singles.end(),
                                     [](const FittedModel& a, const FittedModel& b) { return a.chi2 < b.chi2; });
  if (best == evidence.singles.end() || best->chi2 > evidence.base.fit.chi2 - rules_of(evidence).base_behind) return;
  FittedModel again =
      fit_model(evidence.model, evidence.observations, rules_of(evidence), {}, best->u.head(best->base_count));
  if (again.chi2 >= evidence.base.fit.chi2 - rules_of(evidence).better) return;
  put_base(evidence, std::move(again));
  for (std::size_t k = 0; k < evidence.singles.size(); ++k)
    evidence.singles[k] = better_of(std::move(evidence.singles[k]), fit_single(evidence, k));
}

/// An effect of larger chi squared than the base is caught in a local minimum, since at size 0 it is the base:
/// restarted there.
void restart_at_the_base(Evidence& evidence) {
  for (FittedModel& single : evidence.singles) {
    if (single.chi2 <= evidence.base.fit.chi2 + rules_of(evidence).converged) continue;
    const CoordinateMap map = evidence.model.map(single.effects);
    single = better_of(std::move(single), fit_model(evidence.model, evidence.observations, rules_of(evidence),
                                                    single.effects, widened_start(evidence.base.fit, map)));
  }
}

}  // namespace

FittedModel better_of(FittedModel a, FittedModel b) { return a.chi2 <= b.chi2 ? std::move(a) : std::move(b); }

Eigen::VectorXd at_first_constants(const Evidence& evidence, Eigen::VectorXd u) {
  const Eigen::VectorXd first = evidence.model.base_map().coordinates(evidence.model.basis().centre);
  u.head(first.size()) = first;
  return u;
}

FittedModel restarted(const Evidence& evidence, FittedModel fit) {
  const FitRules& rules = rules_of(evidence);
  const double found = evidence.base.fit.chi2 - fit.chi2;
  const auto again_from = [&](const Eigen::VectorXd& u) {
    FittedModel again = fit_model(evidence.model, evidence.observations, rules_of(evidence), fit.effects, u);
    return better_of(std::move(fit), std::move(again));
  };
  if (found >= rules.far_behind) fit = again_from(at_first_constants(evidence, fit.u));
  // A further fit of every effect to moduli of layouts would double the work; effects of a machine on curves need it.
  const bool is_far_off = fit.chi2 > evidence.observations.size() + rules.far_behind;
  const bool is_of_curves =
      material::acts_in_measurement(fit.effects.front()) && evidence.observations.has(tester::TestKind::tensile);
  if (fit.effects.size() > 1 || !is_far_off || !is_of_curves) return fit;
  const bool found_nothing = std::abs(fit.u[evidence.base.fit.u.size()]) < rules.nothing;
  if (found >= rules.far_behind || found_nothing) fit = again_from(promising_initial_guess(evidence, fit));
  return fit;
}

Evidence with_fits(Evidence evidence, const Eigen::VectorXd& start, Stretch stretch) {
  const auto report = [&](double share, std::string_view phase) {
    if (evidence.settings.progress)
      evidence.settings.progress(stretch.begin + share * (stretch.end - stretch.begin), phase);
  };
  report(0.0, "fitting the base model");
  FittedModel base = fit_model(evidence.model, evidence.observations, rules_of(evidence), {}, start);
  report(0.3, "signatures of the effects");
  put_base(evidence, std::move(base));
  std::vector<FittedModel> singles;
  for (std::size_t k = 0; k < evidence.effects.size(); ++k) {
    report(0.5 + 0.5 * static_cast<double>(k) / static_cast<double>(evidence.effects.size()),
           "fitting base and " + evidence.effects[k]);
    // An earlier fit of some size is the initial guess under another covariance or emulator.
    const bool found = k < evidence.singles.size() &&
                       std::abs(evidence.singles[k].u[evidence.singles[k].base_count]) > rules_of(evidence).nothing;
    singles.push_back(found ? fit_model(evidence.model, evidence.observations, rules_of(evidence),
                                        {evidence.effects[k]}, evidence.singles[k].u)
                            : fit_single(evidence, k));
  }
  evidence.singles = std::move(singles);
  for (FittedModel& single : evidence.singles) single = restarted(evidence, std::move(single));
  restart_base(evidence);
  restart_at_the_base(evidence);
  return evidence;
}

}  // namespace nacre::diagnosis
