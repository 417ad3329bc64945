#include "diagnosis/explanations.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/condition_laws.hpp"
#include "diagnosis/misfit.hpp"
#include "diagnosis/words.hpp"

namespace nacre::diagnosis {
namespace {

/// Every effect at its usual size on top of the base.
std::vector<FittedModel> usual_effects(const Evidence& evidence) {
  const FitRules& rules = evidence.settings.procedure.fit;
  std::vector<FittedModel> models;
  for (const std::string& effect : evidence.effects) {
    const CoordinateMap map = evidence.model.map({{effect}});
    Eigen::VectorXd u = widened_start(evidence.base.fit, map);
    u[map.base_count()] = std::min(rules.sizes[rules.typical], map.upper(map.base_count()));
    models.push_back(linearised(evidence.model, {effect}, u));
  }
  return models;
}

/// Where no condition is in question.
std::vector<FittedModel> models_to_separate(const Evidence& evidence, const Decision& decision) {
  if (decision.verdict == Verdict::ambiguous) return decision.possible;
  if (decision.verdict == Verdict::base_sufficient) return {};
  std::vector<FittedModel> models =
      decision.verdict == Verdict::insufficient ? usual_effects(evidence) : evidence.singles;
  std::stable_sort(models.begin(), models.end(),
                   [](const FittedModel& a, const FittedModel& b) { return a.chi2 < b.chi2; });
  if (decision.verdict == Verdict::unexplained) models.resize(std::min<std::size_t>(models.size(), 3));
  models.push_back(evidence.base.fit);
  return models;
}

/// A model refitted beside these levels.
Explanation refitted(const Evidence& evidence, const FittedModel& model, FreeLevels beside) {
  const Procedure& rules = evidence.settings.procedure;
  Observations observations = evidence.observations;
  observations.levels = free_directions(observations, beside, rules.noise);
  return {fit_model(evidence.model, observations, rules.fit, model.effects, model.u), std::move(beside)};
}

/// The base beside free levels of each set of factors of which any explains the data.
std::vector<Explanation> factors_in_question(const Evidence& evidence) {
  constexpr std::size_t kMost = 4;
  std::vector<Explanation> explanations;
  for (const std::vector<std::string>& factors : evidence.factors)
    if (explanations.size() < kMost)
      explanations.push_back(refitted(evidence, evidence.base.fit, {.factors = factors}));
  return explanations;
}

/// The base beside free levels of each condition that goes with this one.
std::vector<Explanation> alike_in_question(const Evidence& evidence, const Decision& decision,
                                           const std::string& condition) {
  if (decision.contrasts.empty()) return {};
  const Contrast& strongest = decision.contrasts.front();
  std::vector<std::string> together = conditions_alike(plain(evidence), strongest);
  together.push_back(strongest.view.against);
  if (std::ranges::count(together, condition) == 0) return {};
  std::vector<Explanation> explanations;
  for (const std::string& other : together)
    if (other != condition) explanations.push_back(refitted(evidence, evidence.base.fit, {.factors = {other}}));
  return explanations;
}

/// A named model with a law of a condition, and the same with free levels in place of that, or of a condition that goes
/// with it.
std::vector<Explanation> law_in_question(const Evidence& evidence, const Decision& decision) {
  const FittedModel& named = decision.possible.front();
  const std::string condition(material::find_effect(named.effects.back())->law_of);
  FittedModel without = named;
  without.effects.pop_back();
  without.u = named.u.head(evidence.model.map(without.effects).size()).eval();
  FreeLevels levels = decision.beside;
  if (condition != kStrainRate) levels.factors.push_back(condition);
  levels.has_exponents = levels.has_exponents || condition == kStrainRate || condition == "temperature";
  std::vector<Explanation> explanations = alike_in_question(evidence, decision, condition);
  explanations.insert(explanations.begin(), {{named, decision.beside}, refitted(evidence, without, std::move(levels))});
  return explanations;
}

/// What differs between the machines is theirs, or that of the specimens on each.
std::vector<Explanation> machines_in_question(const Evidence& evidence, const Decision& decision) {
  const FittedModel& model = decision.possible.empty() ? evidence.base.fit : decision.possible.front();
  FreeLevels beside = decision.freed ? decision.beside : FreeLevels{without_law(evidence.factors.front())};
  const Explanation of_machines = refitted(evidence, model, beside);
  beside.are_of_specimens = true;
  return {of_machines, {of_machines.model, std::move(beside)}};
}

/// Warm specimens are softer, or they are as cold ones that are pulled more slowly.
std::vector<Explanation> temperature_in_question(const Evidence& evidence) {
  const Procedure& rules = evidence.settings.procedure;
  FreeLevels others{without_law(evidence.factors.front())};
  const Explanation levels = refitted(evidence, evidence.base.fit, others);
  std::erase(others.factors, "temperature");
  FittedModel shifted = evidence.base.fit;
  shifted.effects = {"rate_power_law", "temperature_shift"};
  const CoordinateMap map = evidence.model.map(shifted.effects);
  shifted.u.conservativeResize(map.size());
  for (int i = map.base_count(); i < map.size(); ++i) shifted.u[i] = map.usual(i);
  shifted.u[map.base_count()] = rules.fit.sizes[rules.fit.typical];
  return {refitted(evidence, shifted, std::move(others)), levels};
}

bool is_named_by_a_law(const Decision& decision) {
  return decision.verdict == Verdict::named && decision.freed != nullptr &&
         !material::find_effect(decision.possible.front().effects.back())->law_of.empty();
}

}  // namespace

std::vector<Explanation> beside_levels_of(const Evidence& evidence, std::vector<FittedModel> models) {
  FreeLevels beside;
  if (evidence.without_levels) beside.factors = without_law(evidence.factors.front());
  std::vector<Explanation> explanations;
  for (FittedModel& model : models) explanations.push_back({std::move(model), beside});
  return explanations;
}

std::vector<Explanation> explanations_to_separate(const Evidence& evidence, const Decision& decision) {
  if (is_named_by_a_law(decision)) return law_in_question(evidence, decision);
  if (!decision.rivals.empty()) {
    std::vector<Explanation> explanations;
    for (const FittedModel& rival : decision.rivals) explanations.push_back({rival, decision.beside_rivals});
    return explanations;
  }
  if (decision.verdict != Verdict::named && evidence.factors.size() > 1) return factors_in_question(evidence);
  const std::vector<std::string> told = told_factors(evidence.factors);
  if (std::ranges::count(told, "machine") > 0 && !machines_are_compared(evidence.observations))
    return machines_in_question(evidence, decision);
  if (decision.verdict != Verdict::named && told == std::vector<std::string>{"temperature"})
    return temperature_in_question(evidence);
  if (decision.verdict != Verdict::named) return beside_levels_of(evidence, models_to_separate(evidence, decision));
  if (decision.possible.size() > 1 && !decision.freed) return beside_levels_of(evidence, decision.possible);  // forms
  std::vector<Explanation> explanations = beside_levels_of(evidence, {decision.possible.front(), evidence.base.fit});
  if (decision.freed) explanations.front().beside = decision.beside;
  return explanations;
}

std::string in_words(const Explanation& explanation) {
  const std::vector<std::string>& effects = explanation.model.effects;
  const std::vector<std::string>& factors = explanation.beside.factors;
  if (explanation.beside.are_of_specimens) return "specimens that differ";
  if (factors.empty()) return in_words(effects);
  const std::string levels = fmt::format("a dependence on {}", fmt::join(factors, " and "));
  return effects.empty() ? levels : fmt::format("{} beside {}", in_words(effects), levels);
}

}  // namespace nacre::diagnosis
