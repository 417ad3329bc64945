#include "diagnosis/condition_laws.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/factors.hpp"
#include "diagnosis/gain.hpp"
#include "diagnosis/joined_sets.hpp"
#include "diagnosis/misfit.hpp"
#include "diagnosis/pairs.hpp"
#include "material/effect_library.hpp"

namespace nacre::diagnosis {
namespace {

/// Whether a law says less than the levels that it replaces: there is a value of its condition more than it has numbers
/// for each material, beside the level of that. Laws of machines say less where there are several materials, and that
/// of temperature where there are several rates.
bool says_less_than_levels(const material::Effect& law, const Observations& observations) {
  if (law.law_of == "machine" || law.law_of == "temperature") return true;
  const std::size_t numbers = law.parameters.size() - (law.is_by_phase ? 2 : 0);
  return most_values(observations, std::string(law.law_of)) >= numbers + 2;
}

/// Laws of a condition that levels of it may be told by. The one of temperature shifts the rate: there must be a law of
/// that.
std::vector<std::string> laws_of(std::string_view condition, const Observations& observations,
                                 const FittedModel& decided) {
  if (condition == "machine" && !machines_are_compared(observations)) return {};
  if (condition == "temperature" && !have_rate_law(decided.effects)) return {};
  std::vector<std::string> laws;
  for (const material::Effect& law : material::condition_laws())
    if (law.law_of == condition && says_less_than_levels(law, observations)) laws.emplace_back(law.name);
  return laws;
}

/// Where descents to a law begin: every one of these sizes, of either sign, with every one of a few values of each of
/// its further parameters. A law with two times has several local minima; one with a number for each machine or
/// material is nearly linear in them.
std::vector<Eigen::VectorXd> starts_of(const CoordinateMap& map, const FittedModel& decided,
                                       std::span<const double> sizes) {
  constexpr std::array kShares = {0.2, 0.5, 0.8};
  const auto own = static_cast<int>(decided.u.size());
  std::vector<Eigen::VectorXd> starts;
  for (const double size : sizes) {
    for (const double signed_size : {size, -size}) {
      if (signed_size < map.lower(own)) continue;
      starts.push_back(widened_start(decided, map));
      starts.back()[own] = signed_size;
    }
  }
  if (!material::find_effect(map.effects().back())->one_for_each.empty()) return starts;
  for (int further = own + 1; further < map.size(); ++further) {
    const std::vector<Eigen::VectorXd> so_far = std::exchange(starts, {});
    for (const Eigen::VectorXd& start : so_far) {
      for (const double share : kShares) {
        starts.push_back(start);
        starts.back()[further] = map.lower(further) + share * (map.upper(further) - map.lower(further));
      }
    }
  }
  return starts;
}

/// Those of the starts from which most is explained once the other constants are refitted linearly.
std::vector<Eigen::VectorXd> best_of(std::vector<Eigen::VectorXd> starts, const CoordinateMap& map,
                                     const FeatureModel& model, const Observations& observations,
                                     const FittedModel& decided) {
  constexpr std::size_t kDescents = 5;
  if (starts.size() <= kDescents) return starts;
  const Whitener whitener(observations.covariance());
  const Eigen::MatrixXd predicted = model.predict(map, starts);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    FittedModel shifted = decided;
    shifted.predicted = predicted.col(static_cast<Eigen::Index>(i));
    order.emplace_back(linear_refit(shifted, observations.values, whitener), i);
  }
  std::ranges::sort(order);
  std::vector<Eigen::VectorXd> best;
  for (std::size_t k = 0; k < kDescents; ++k) best.push_back(std::move(starts[order[k].second]));
  return best;
}

/// The model with a law more, by the best of descents from the best starts.
FittedModel fitted_with(const Evidence& evidence, const Observations& observations, const FittedModel& decided,
                        const std::string& law) {
  const FitRules& rules = evidence.settings.procedure.fit;
  std::vector<std::string> effects = decided.effects;
  effects.push_back(law);
  const CoordinateMap map = evidence.model.map(effects);
  std::vector<FittedModel> fits;
  for (const Eigen::VectorXd& start :
       best_of(starts_of(map, decided, rules.sizes), map, evidence.model, observations, decided))
    fits.push_back(fit_model(evidence.model, observations, rules, effects, start));
  return *std::ranges::min_element(fits, {}, &FittedModel::chi2);
}

/// Levels of the conditions without a law, and, of a law of the rate in free form, exponents.
FreeLevels free_beside(const Observations& observations, const std::vector<std::string>& factors,
                       bool has_free_exponents) {
  if (has_free_exponents) return {factors_but_rate(observations, factors), true};
  return {without_law(factors), false};
}

/// With these free in place of others.
Observations freed(Observations observations, const FreeLevels& beside, const NoiseRules& rules) {
  observations.levels = free_directions(observations, beside, rules);
  return observations;
}

/// Chi squared, and what an effect has to be worth for each that the model holds.
double cost_of(const FittedModel& model, const NameRules& rules) {
  return model.chi2 + rules.lead * static_cast<double>(model.effects.size());
}

/// A model, and a law that it is tried with.
struct Trial {
  FittedModel model;
  std::string law;
};

/// Those of the trials that explain the data, the best first; none that costs more by what a name needs.
std::vector<FittedModel> laws_that_fit(const Evidence& evidence, const Observations& observations,
                                       const std::vector<Trial>& trials) {
  const Procedure& rules = evidence.settings.procedure;
  std::vector<FittedModel> fitting;
  for (const auto& [model, law] : trials) {
    FittedModel fit = fitted_with(evidence, observations, model, law);
    const double p = chance_of_misfit(observations, fit, evidence.settings);
    if (is_usable(fit, p, rules.levels.unexplained)) fitting.push_back(std::move(fit));
  }
  const auto cost = [&](const FittedModel& model) { return cost_of(model, rules.names); };
  std::ranges::stable_sort(fitting, {}, cost);
  if (fitting.empty()) return fitting;
  std::erase_if(fitting, [&, least = cost(fitting.front())](const FittedModel& model) {
    return cost(model) - least >= rules.names.lead;
  });
  return fitting;
}

/// Of models with the same law the first.
std::vector<FittedModel> one_of_each_law(const std::vector<FittedModel>& models) {
  std::vector<FittedModel> first;
  for (const FittedModel& model : models)
    if (std::ranges::none_of(first,
                             [&](const FittedModel& other) { return other.effects.back() == model.effects.back(); }))
      first.push_back(model);
  return first;
}

/// The decision for models with a law (several: forms of another effect), on observations without the levels that it
/// replaces. Its gain is that over the base without these levels.
Decision named_with(const Evidence& evidence, Decision decision, std::vector<FittedModel> models,
                    Observations observations, const std::vector<std::string>& left) {
  const Procedure& rules = evidence.settings.procedure;
  const Observations before =
      freed(evidence.observations, free_beside(evidence.observations, left, false), rules.noise);
  const ExactRefits refits{evidence.model, rules.fit};
  decision.gain = held_out_gain(before, evidence.base.fit,
                                {.models = {models.front()}, .observations = &observations, .refits = &refits},
                                models.front().effects, rules.gain, evidence.settings.seed);
  Evidence within = evidence;
  within.observations = std::move(observations);
  decision.freed = std::make_shared<const Evidence>(std::move(within));
  decision.verdict = Verdict::named;
  decision.partial.reset();
  decision.possible = std::move(models);
  return decision;
}

/// Every law of the rate by itself: where levels of temperature stay free none of them may explain the data, since each
/// temperature shifts it.
std::vector<FittedModel> rate_laws(const Evidence& evidence) {
  std::vector<FittedModel> laws;
  for (const FittedModel& single : evidence.singles)
    if (have_rate_law(single.effects)) laws.push_back(single);
  return laws;
}

/// Each of these models with each law of the strain rate that is none of the library.
std::vector<Trial> rate_laws_beside(const std::vector<FittedModel>& models) {
  std::vector<Trial> trials;
  for (const FittedModel& model : models)
    for (const material::Effect& law : material::condition_laws())
      if (law.law_of == kStrainRate) trials.push_back({model, std::string(law.name)});
  return trials;
}

/// Mean error on held-out specimens where levels stay free.
double error_with_levels(const Evidence& evidence, const Decision& decision) {
  if (decision.gain) return decision.gain->held_out_error_after;
  const Procedure& rules = evidence.settings.procedure;
  return held_out_gain(evidence.observations, evidence.base.fit, {}, {}, rules.gain, evidence.settings.seed)
      .held_out_error_before;
}

}  // namespace

bool machines_are_compared(const Observations& observations) {
  if (observations.machines.size() < 2) return false;
  std::map<int, std::set<std::string>> tested;
  for (const Observation& group : observations.groups) {
    std::set<std::string>& own = tested[group.machine];
    for (const std::string& piece : group.pieces) own.insert("piece " + piece);
    for (const auto& [batch, pieces] : group.batches) own.insert("batch " + batch);
  }
  return joined(tested).size() == 1;
}

std::vector<FittedModel> rate_laws_of_curves(const Evidence& evidence) {
  const Observations& observations = evidence.observations;
  if (has_layouts(observations) || !observations.has(tester::TestKind::tensile)) return {};
  std::vector<FittedModel> fitting = laws_that_fit(evidence, observations, rate_laws_beside({evidence.base.fit}));
  if (!fitting.empty() || !is_noticed(evidence)) return fitting;
  std::vector<FittedModel> beside;
  for (const std::size_t k : pair_anchors(evidence))
    if (!have_rate_law(evidence.singles[k].effects)) beside.push_back(evidence.singles[k]);
  return laws_that_fit(evidence, observations, rate_laws_beside(beside));
}

Decision with_condition_laws(const Evidence& evidence, Decision decision) {
  if (evidence.factors.empty()) return decision;
  const Procedure& rules = evidence.settings.procedure;
  std::vector<std::string> left = evidence.factors.front();
  for (const std::string& condition : told_factors(evidence.factors)) {
    const bool is_free = decision.finding.reason == Reason::free_form, is_rate = condition == kStrainRate;
    if (is_rate && !is_free) continue;  // a law of the library explains the data, or nothing depends on it
    // What effects explain beside levels may be what the law explains: without them first.
    std::vector<FittedModel> beside;
    if (is_rate || !is_free) beside.push_back(evidence.base.fit);
    if (!is_rate) beside.insert(beside.end(), decision.possible.begin(), decision.possible.end());
    if (is_free && condition == "temperature") beside = rate_laws(evidence);
    std::vector<std::string> others = left;
    std::erase(others, condition);
    // Laws of the rate and of temperature say how it goes with the rate: free exponents would take their place.
    const bool stays_free = is_free && !is_rate && condition != "temperature";
    const FreeLevels free = free_beside(evidence.observations, others, stays_free);
    Observations observations = freed(evidence.observations, free, rules.noise);
    std::vector<Trial> trials;
    for (const FittedModel& model : beside)
      for (const std::string& law : laws_of(condition, observations, model)) trials.push_back({model, law});
    std::vector<FittedModel> fitting = laws_that_fit(evidence, observations, trials);
    if (fitting.empty()) continue;
    if (std::vector<FittedModel> rivals = one_of_each_law(fitting); rivals.size() > 1) {
      decision.rivals = std::move(rivals);
      decision.beside_rivals = free;
      continue;
    }
    std::erase_if(fitting, [count = fitting.front().effects.size()](const FittedModel& model) {
      return model.effects.size() != count;
    });
    const double with_levels = error_with_levels(evidence, decision);
    Decision with_law = named_with(evidence, decision, std::move(fitting), std::move(observations), others);
    const double without = with_law.gain->held_out_error_before, after = with_law.gain->held_out_error_after;
    if (without - after < rules.gain.law_share * (without - with_levels)) continue;
    if (is_rate && after >= with_levels) continue;  // free exponents say as much, and differ between materials
    decision = std::move(with_law);
    decision.beside = free;
    if (!stays_free)
      decision.finding = {.reason =
                              decision.possible.front().effects.size() > 1 ? Reason::two_effects : Reason::one_effect};
    left = others;
  }
  return decision;
}

}  // namespace nacre::diagnosis
