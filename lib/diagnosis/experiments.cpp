#include "diagnosis/experiments.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "diagnosis/predicted_tests.hpp"
#include "diagnosis/words.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

/// Where moduli are measured too, they tell what some fracture tests would. Where fracture tests are simulated
/// elsewhere, none could be predicted.
std::vector<PossibleTest> tests_worth_their_cost(const Evidence& evidence, const TestRules& rules) {
  std::vector<PossibleTest> tests = possible_tests(evidence.observations, rules);
  if (evidence.settings.fractures)
    std::erase_if(tests, [](const PossibleTest& t) { return t.test == TestKind::toughness; });
  if (evidence.observations.has(TestKind::modulus)) std::erase_if(tests, is_told_by_modulus);
  return tests;
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_of(std::size_t models) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t b = 1; b < models; ++b)
    for (std::size_t a = 0; a < b; ++a) pairs.emplace_back(a, b);
  return pairs;
}

}  // namespace

std::vector<NextExperiment> next_experiments(const Evidence& evidence, const std::vector<Explanation>& explanations,
                                             const TestRules& rules) {
  if (explanations.size() < 2) return {};
  const std::vector<PossibleTest> tests = tests_worth_their_cost(evidence, rules);
  const PredictedTests predicted(evidence, explanations, tests, rules.replicates);
  const auto pairs = pairs_of(explanations.size());
  std::vector<TestValue> values(tests.size());
  parallel_for(static_cast<int>(tests.size()), [&](int job) {
    const auto t = static_cast<std::size_t>(job);
    values[t] = {tests[t].way, predicted.separations(t, pairs)};
  });
  std::vector<NextExperiment> experiments;
  for (const TestChoice& choice : choose_tests(values, rules.count, rules)) {
    const PossibleTest& test = tests[choice.test];
    const Separation& separation = values[choice.test].pairs[choice.pair];
    const auto& [a, b] = pairs[choice.pair];
    tester::Loading loading = test.pauses;
    if (test.test == TestKind::tensile && !loading.has_pauses()) loading = coupon_loading();
    std::vector<std::string> machines;
    if (!test.surroundings.machine.empty()) machines.push_back(test.surroundings.machine);
    if (test.second_machine) machines.push_back(evidence.observations.machines[*test.second_machine]);
    const std::string reason =
        in_words(Separated{test, separation, in_words(explanations[a]), in_words(explanations[b])});
    experiments.push_back({.design = test.design,
                           .test = test.test,
                           .conditions = test.conditions,
                           .replicates = rules.replicates,
                           .loading = std::move(loading),
                           .hold_s = test.surroundings.held ? hold_of(test) : std::nullopt,
                           .surroundings = test.surroundings,
                           .machines = std::move(machines),
                           .reason = reason});
  }
  return experiments;
}

std::vector<NextExperiment> specimens_of_materials(const Observations& observations,
                                                   const std::vector<ModulusAtBound>& moduli, int replicates) {
  std::vector<NextExperiment> experiments;
  for (const ModulusAtBound& each : moduli) {
    experiments.push_back({.design = *pattern::design_from_name(kConstantMaterials[each.material]),
                           .test = TestKind::modulus,
                           .conditions = usual_conditions(observations, TestKind::modulus),
                           .replicates = replicates,
                           .reason = in_words(UntoldMaterial{each})});
  }
  return experiments;
}

}  // namespace nacre::diagnosis
