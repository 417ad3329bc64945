#include "explore/learned.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "base/random.hpp"
#include "base/result.hpp"
#include "explore/improvement.hpp"
#include "explore/model_search.hpp"
#include "explore/predictors.hpp"
#include "explore/specimen_scatter.hpp"
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

/// The best patterns by rank, to be tested a second time, until some were: without them no scatter is known. None where
/// one specimen of each is enough.
std::vector<pattern::Pattern> first_repeats(const BatchRequest& batch_request) {
  constexpr int kFewest = 10;
  const auto tested_once = [](const Evaluated& sample) { return sample.sampling.specimens == 1; };
  const std::vector<Evaluated>& evaluated = batch_request.evaluated;
  const auto repeated = static_cast<int>(evaluated.size() - std::ranges::count_if(evaluated, tested_once));
  if (batch_request.settings.learned.specimens == 1 || repeated >= kFewest) return {};
  std::vector<Evaluated> once;
  std::ranges::copy_if(best_by_rank(evaluated, evaluated.size()), std::back_inserter(once), tested_once);
  once.resize(std::min(
      {once.size(), static_cast<std::size_t>(kFewest - repeated), static_cast<std::size_t>(batch_request.count)}));
  return patterns_of(once);
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

/// The first finalists in an order of patterns, none nearer than LearnedSettings::apart flips to an earlier one; where
/// these are less than a batch, others behind them.
std::vector<std::size_t> picked_apart(std::span<const std::pair<double, std::size_t>> order,
                                      std::span<const pattern::Pattern> patterns, const BatchRequest& batch_request) {
  const auto fewest = static_cast<std::size_t>(batch_request.count), most = std::max(kFinalists, fewest);
  std::vector<std::size_t> picked, near;
  for (const auto& [value, i] : order) {
    if (picked.size() == most) break;
    const bool is_near = std::ranges::any_of(picked, [&](std::size_t earlier) {
      return std::popcount(patterns[i].bits() ^ patterns[earlier].bits()) < batch_request.settings.learned.apart;
    });
    (is_near ? near : picked).push_back(i);
  }
  near.resize(std::min(near.size(), std::max(fewest, picked.size()) - picked.size()));
  picked.insert(picked.end(), near.begin(), near.end());
  return picked;
}

/// Those whose own improvement is expected to be largest. `scatter`: of specimens; none: a test settles all.
Finalists finalists_of(const Predictors& predictors, std::span<const pattern::Pattern> patterns,
                       std::span<const optimize::Performance> front, const BatchRequest& batch_request,
                       const SpecimenScatter* scatter) {
  std::vector<Belief> beliefs = beliefs_about(predictors, patterns);
  if (scatter != nullptr)
    for (std::size_t i = 0; i < patterns.size(); ++i) beliefs[i].noise_variance = scatter->variance_at(patterns[i]);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < patterns.size(); ++i) order.emplace_back(-expected_improvement(beliefs[i], front), i);
  std::sort(order.begin(), order.end());
  Finalists best;
  for (const std::size_t i : picked_apart(order, patterns, batch_request)) {
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

/// Adds the best of the evaluated patterns of which a further specimen may be tested, with their moduli known.
void add_known(Finalists& finalists, const BatchRequest& batch_request, const SpecimenScatter& scatter) {
  constexpr std::size_t kMostAgain = 60;
  for (const Evaluated& estimate : best_by_rank(batch_request.evaluated, kMostAgain)) {
    if (estimate.sampling.specimens >= batch_request.settings.learned.specimens) continue;
    const auto& [modulus_pa, toughness_pa] = estimate.performance;
    if (modulus_pa <= 0.0 || toughness_pa <= 0.0) continue;
    const double deviation = estimate.sampling.toughness_se_pa / toughness_pa;
    finalists.patterns.push_back(estimate.pattern);
    finalists.beliefs.push_back({.modulus = {std::log(modulus_pa), 0.0},
                                 .toughness = {std::log(toughness_pa) - 0.5 * deviation * deviation, deviation},
                                 .noise_variance = scatter.variance_at(estimate.pattern),
                                 .present = estimate.performance});
  }
}

/// `scatter`: of specimens, where the noise is known; evaluated samples are then estimates.
std::vector<pattern::Pattern> choose_by_improvement(const Predictors& predictors, std::span<const Evaluated> candidates,
                                                    const BatchRequest& batch_request, const SpecimenScatter* scatter) {
  const std::vector<optimize::Performance> points = performances_of(batch_request.evaluated);
  const auto count = static_cast<std::size_t>(batch_request.count);
  Finalists finalists = finalists_of(predictors, patterns_of(best_by_rank(candidates, std::max(kShortList, count))),
                                     optimize::pareto_front(points), batch_request, scatter);
  if (batch_request.settings.mechanics.modulus_of) know_moduli(finalists, batch_request.settings.mechanics.modulus_of);
  if (scatter != nullptr) add_known(finalists, batch_request, *scatter);
  SharedErrors shared{{}, predictors.toughness->covariance(finalists.patterns)};
  if (!batch_request.settings.mechanics.modulus_of)
    shared.log_modulus = predictors.modulus->covariance(finalists.patterns);
  std::vector<pattern::Pattern> batch;
  for (const std::size_t i : best_improvements(finalists.beliefs, points, batch_request.count, std::move(shared)))
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
  check(settings.apart >= 1 && settings.apart <= pattern::kFreePixels, "apart", settings.apart, "1 to 55 flips");
  check(settings.specimens >= 1 && settings.specimens <= 100, "specimens", settings.specimens, "1 to 100");
  const bool knows_noise = settings.predictor == "patches" && settings.choice == "improvement";
  check(settings.specimens == 1 || knows_noise, "specimens", settings.specimens,
        "1, or predictor = patches and choice = improvement");
}

std::string to_text(const LearnedSettings& settings) {
  return fmt::format(
      "predictor={} choice={} generations={} population={} optimism={} most_samples={} members={} warm_start={} "
      "weight_decay={} dropout={} floor_deviations={} barred_start={} barred_candidates={}{}{}",
      settings.predictor, settings.choice, settings.generations, settings.population, settings.optimism,
      settings.most_samples, settings.members, settings.warm_start, settings.weight_decay, settings.dropout,
      settings.floor_deviations, settings.barred_start, settings.barred_candidates,
      settings.specimens > 1 ? fmt::format(" specimens={}", settings.specimens) : "",
      settings.apart > 1 ? fmt::format(" apart={}", settings.apart) : "");
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
  if (std::vector<pattern::Pattern> again = first_repeats(batch_request); !again.empty()) return again;
  Predictors base;
  if (!settings.former.empty()) base = fit_predictors(settings.former, settings);
  const Predictors predictors = fit_predictors(batch_request.evaluated, settings, base);
  BatchRequest believed = batch_request;
  const bool knows_noise = is_noise_known(batch_request.evaluated, settings.learned);
  if (knows_noise) believed.evaluated = estimated(predictors, batch_request.evaluated, settings.learned);
  const std::vector<Evaluated> candidates = candidates_for(believed, predictors);
  const SpecimenScatter scatter(batch_request.evaluated);
  if (settings.learned.choice == "improvement")
    return choose_by_improvement(predictors, candidates, believed, knows_noise ? &scatter : nullptr);
  return patterns_of(best_by_rank(candidates, batch_request.count));
}

}  // namespace nacre::explore
