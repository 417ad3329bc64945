#include "broken_trials.hpp"

#include <array>
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
constexpr std::array kBrokenMixtures = {0.0, 0.5, 0.75, 1.0};  ///< rigid fractions
constexpr int kPooled = 4;                                     ///< specimens of a design

}  // namespace

std::uint64_t seed_of_truth(const BlindTrial& trial) { return trial.truth_seed > 0 ? trial.truth_seed : trial.seed; }

std::uint64_t broken_design(const BlindTrial& trial) { return seed_of_truth(trial) % kBrokenDesigns; }

std::vector<lab::Experiment> broken_designs(const BlindTrial& trial, tester::Fidelity fidelity) {
  RandomStream random(broken_design(trial), "blind trials/broken layouts");
  std::vector<lab::Experiment> experiments;
  std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(3 * kBrokenLayouts, random);
  std::erase_if(patterns, [](const pattern::Pattern& each) { return each.rigid_fraction() < kLeastRigid; });
  patterns.resize(kBrokenLayouts);
  const auto add = [&](const pattern::Design& design, TestKind test) {
    experiments.push_back(
        {.design = design, .test = test, .conditions = {}, .fidelity = fidelity, .specimens = kPooled});
  };
  for (const pattern::Pattern& each : patterns)
    for (const TestKind test : {TestKind::modulus, TestKind::toughness}) add(each, test);
  for (const double rigid_fraction : kBrokenMixtures) add(pattern::Mixture{rigid_fraction}, TestKind::toughness);
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
