#include "broken_trials.hpp"

#include <numeric>

#include <fmt/format.h>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "pool.hpp"

namespace nacre::blind_trials {
namespace {

namespace lab = laboratory;
using tester::TestKind;

constexpr int kBrokenDesigns = 2, kBrokenLayouts = 24;
constexpr double kLeastRigid = 0.55;
constexpr int kPooled = 6;  ///< specimens of a design

}  // namespace

std::uint64_t seed_of_truth(const BlindTrial& trial) { return trial.truth_seed > 0 ? trial.truth_seed : trial.seed; }

std::uint64_t broken_design(const BlindTrial& trial) { return seed_of_truth(trial) % kBrokenDesigns; }

std::vector<lab::Experiment> broken_layouts(const BlindTrial& trial, tester::Fidelity fidelity) {
  RandomStream random(broken_design(trial), "blind trials/broken layouts");
  std::vector<lab::Experiment> experiments;
  std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(3 * kBrokenLayouts, random);
  std::erase_if(patterns, [](const pattern::Pattern& each) { return each.rigid_fraction() < kLeastRigid; });
  patterns.resize(kBrokenLayouts);
  for (const pattern::Pattern& each : patterns)
    for (const TestKind test : {TestKind::modulus, TestKind::toughness})
      experiments.push_back({.design = pattern::Design(each),
                             .test = test,
                             .conditions = {},
                             .fidelity = fidelity,
                             .specimens = kPooled});
  return experiments;
}

std::vector<int> drawn_from_pool(const BlindTrial& trial, std::size_t experiment) {
  std::vector<int> numbers(kPooled);
  std::iota(numbers.begin(), numbers.end(), 1);
  RandomStream random(trial.seed, fmt::format("trial/drawn/{}", experiment));
  for (int i = kPooled; i > 1; --i) std::swap(numbers[i - 1], numbers[random.index(i)]);
  return numbers;
}

std::vector<Result<lab::TrueResponse>> responses_of_pool(const BlindTrial& trial, const TrialOptions& options,
                                                         const lab::Truth& truth,
                                                         const std::vector<lab::Experiment>& experiments) {
  const std::string what = trial.hidden.empty() ? "nothing" : trial.hidden.front();
  return pooled_responses(
      truth, experiments,
      options.pools / fmt::format("{}-{}-{}.jsonl", what, trial.large ? "large" : "small", trial.truth_seed));
}

}  // namespace nacre::blind_trials
