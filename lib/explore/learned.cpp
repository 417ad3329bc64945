#include "explore/learned.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "base/random.hpp"
#include "base/result.hpp"
#include "explore/improvement.hpp"
#include "explore/model_search.hpp"
#include "explore/predictors.hpp"
#include "explore/surrogate_search.hpp"
#include "pattern/random_pattern.hpp"
#include "surrogate/network.hpp"
#include "thesis/constants.hpp"

namespace nacre::explore {
namespace {

/// Candidates whose uncertainty is computed, and those of them that a batch is chosen from; a batch itself may be
/// larger.
constexpr std::size_t kShortList = 1000, kFinalists = 250;

std::vector<pattern::Pattern> patterns_of(std::span<const Evaluated> samples) {
  std::vector<pattern::Pattern> patterns;
  for (const Evaluated& sample : samples) patterns.push_back(sample.pattern);
  return patterns;
}

std::vector<Belief> beliefs_about(const Predictors& predictors, std::span<const pattern::Pattern> patterns) {
  const auto modulus = predictors.modulus->predict(patterns), toughness = predictors.toughness->predict(patterns);
  std::vector<Belief> beliefs;
  for (std::size_t i = 0; i < patterns.size(); ++i)
    beliefs.push_back({{modulus[i].mean, modulus[i].deviation}, {toughness[i].mean, toughness[i].deviation}});
  return beliefs;
}

/// Random patterns with rigid bars, not simulated yet; without values.
std::vector<Evaluated> barred_patterns(const BatchRequest& batch_request, int count) {
  RandomStream random(batch_seed(batch_request), "explore/barred");
  std::vector<Evaluated> patterns;
  while (static_cast<int>(patterns.size()) < count) patterns.push_back({pattern::random_barred_pattern(random), {}});
  return unseen(std::move(patterns), batch_request);
}

/// The next patterns with bars that a search begins with, at most a batch; none once it has asked for enough.
std::vector<pattern::Pattern> barred_start(const BatchRequest& batch_request) {
  const SearchSettings& settings = batch_request.settings;
  const int asked = batch_request.evaluated.size() + batch_request.lost.size();
  const int count = std::min(batch_request.count, settings.population + settings.learned.barred_start - asked);
  if (count <= 0 || !settings.former.empty()) return {};
  constexpr int kSpare = 10;  // some are equal or known
  std::vector<pattern::Pattern> start = patterns_of(barred_patterns(batch_request, kSpare * batch_request.count));
  start.resize(std::min(start.size(), static_cast<std::size_t>(count)));
  return start;
}

/// All that a search on the predictors visits, and patterns with bars, which that search starts from too.
std::vector<Evaluated> candidates_for(const BatchRequest& batch_request, const Predictors& predictors) {
  const LearnedSettings& learned = batch_request.settings.learned;
  const auto believed_of = [&](std::span<const pattern::Pattern> patterns) {
    return believed(predictors, patterns, learned.optimism);
  };
  const auto count = static_cast<std::size_t>(learned.population);
  // The population of that search begins with the best that was simulated, at its true values: a candidate has to be
  // predicted better than these, not better than their predictions.
  std::vector<Evaluated> start = best_by_rank(batch_request.evaluated, count);
  std::vector<Evaluated> candidates = barred_patterns(batch_request, learned.barred_candidates);
  const std::vector<optimize::Performance> performances = believed_of(patterns_of(candidates));
  for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].performance = performances[i];
  const std::vector<Evaluated> barred = best_by_rank(candidates, count);
  start.insert(start.end(), barred.begin(), barred.end());
  const std::vector<Evaluated> visited = search_believed(
      believed_of, start,
      {.generations = learned.generations, .population = learned.population, .seed = batch_seed(batch_request)});
  candidates.insert(candidates.begin(), visited.begin(), visited.end());
  return unseen(std::move(candidates), batch_request);
}

/// Patterns and the beliefs about them.
struct Finalists {
  std::vector<pattern::Pattern> patterns;
  std::vector<Belief> beliefs;
};

/// Those whose own improvement is expected to be largest.
Finalists finalists_of(const Predictors& predictors, std::span<const pattern::Pattern> patterns,
                       std::span<const optimize::Performance> front, std::size_t count) {
  const std::vector<Belief> beliefs = beliefs_about(predictors, patterns);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < patterns.size(); ++i) order.emplace_back(-expected_improvement(beliefs[i], front), i);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), count));
  Finalists best;
  for (const auto& [improvement, i] : order) {
    best.patterns.push_back(patterns[i]);
    best.beliefs.push_back(beliefs[i]);
  }
  return best;
}

/// Puts the computed modulus in place of the belief about it; one that could not be computed stays a belief.
void know_moduli(Finalists& finalists, const ModulusOf& modulus_of) {
  const std::vector<std::optional<double>> moduli = modulus_of(finalists.patterns);
  for (std::size_t i = 0; i < moduli.size(); ++i)
    if (moduli[i] && *moduli[i] > 0.0) finalists.beliefs[i].modulus = {std::log(*moduli[i]), 0.0};
}

std::vector<pattern::Pattern> choose_by_improvement(const Predictors& predictors, std::span<const Evaluated> candidates,
                                                    const BatchRequest& batch_request) {
  const std::vector<optimize::Performance> front = optimize::pareto_front(performances_of(batch_request.evaluated));
  const auto count = static_cast<std::size_t>(batch_request.count);
  Finalists finalists = finalists_of(predictors, patterns_of(best_by_rank(candidates, std::max(kShortList, count))),
                                     front, std::max(kFinalists, count));
  SharedErrors shared{{}, predictors.toughness->covariance(finalists.patterns)};
  if (batch_request.settings.mechanics.modulus_of)
    know_moduli(finalists, batch_request.settings.mechanics.modulus_of);
  else
    shared.log_modulus = predictors.modulus->covariance(finalists.patterns);
  std::vector<pattern::Pattern> batch;
  for (const std::size_t i : best_improvements(finalists.beliefs, front, batch_request.count, std::move(shared)))
    batch.push_back(finalists.patterns[i]);
  return batch;
}

}  // namespace

void check_learned(const LearnedSettings& settings) {
  const auto check = [](bool within, std::string_view key, const auto& value, std::string_view expected) {
    if (!within) throw InputError::format("learned: {} = {}, expected {}", key, value, expected);
  };
  check(settings.predictor == "patches" || settings.predictor == "networks", "predictor", settings.predictor,
        "patches or networks");
  if (settings.predictor == "networks" && !surrogate::networks_available())
    throw InputError("learned: predictor = networks, but this build has none: install libtorch-dev and build again");
  check(settings.members >= 1 && settings.members <= 100, "members", settings.members, "1 to 100");
  check(settings.weight_decay >= 0.0, "weight_decay", settings.weight_decay, "at least 0");
  check(settings.dropout >= 0.0 && settings.dropout < 1.0, "dropout", settings.dropout, "0 to below 1");
  check(settings.choice == "improvement" || settings.choice == "rank", "choice", settings.choice,
        "improvement or rank");
  check(settings.barred_start >= 0, "barred_start", settings.barred_start, "at least 0");
  check(settings.barred_candidates >= 0, "barred_candidates", settings.barred_candidates, "at least 0");
  check(settings.generations >= 1, "generations", settings.generations, "at least 1");
  check(settings.population >= 2, "population", settings.population, "at least 2");
  check(settings.optimism >= 0.0 && settings.optimism <= 10.0, "optimism", settings.optimism, "0 to 10 deviations");
  check(settings.floor_deviations >= 0.0, "floor_deviations", settings.floor_deviations, "at least 0");
  check(settings.most_samples >= 10, "most_samples", settings.most_samples, "at least 10");
}

std::string to_text(const LearnedSettings& settings) {
  return fmt::format(
      "predictor={} choice={} generations={} population={} optimism={} most_samples={} members={} warm_start={} "
      "weight_decay={} dropout={} floor_deviations={} barred_start={} barred_candidates={}",
      settings.predictor, settings.choice, settings.generations, settings.population, settings.optimism,
      settings.most_samples, settings.members, settings.warm_start, settings.weight_decay, settings.dropout,
      settings.floor_deviations, settings.barred_start, settings.barred_candidates);
}

LearnedSettings thesis_learning() {
  LearnedSettings settings;
  settings.predictor = "networks";
  settings.barred_start = settings.barred_candidates = 0;
  settings.members = 1;
  settings.warm_start = false;
  settings.floor_deviations = 0.0;
  settings.choice = "rank";
  settings.generations = thesis::kSurrogateGenerations;
  settings.population = thesis::kSurrogatePopulation;
  settings.most_samples = 1'000'000;
  return settings;
}

std::vector<pattern::Pattern> learned_batch(const BatchRequest& batch_request) {
  const SearchSettings& settings = batch_request.settings;
  if (std::vector<pattern::Pattern> start = barred_start(batch_request); !start.empty()) return start;
  Predictors base;
  if (!settings.former.empty()) base = fit_predictors(settings.former, settings);
  const Predictors predictors = fit_predictors(batch_request.evaluated, settings, base);
  const std::vector<Evaluated> candidates = candidates_for(batch_request, predictors);
  if (settings.learned.choice == "improvement") return choose_by_improvement(predictors, candidates, batch_request);
  return patterns_of(best_by_rank(candidates, batch_request.count));
}

}  // namespace nacre::explore
