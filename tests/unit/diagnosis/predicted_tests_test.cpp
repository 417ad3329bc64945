// The information that a test promises before it is made, against what it gives once it is.

#include "diagnosis/predicted_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "diagnosis/shared_discretisation.hpp"
#include "diagnosis/words.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

constexpr int kReplicates = 3;

/// Moduli with a shared discretisation error.
DiagnosisSettings floor_settings() {
  DiagnosisSettings settings{};
  settings.start = material::thesis_parameters();
  settings.fidelity = tester::Fidelity::tiny;
  settings.floor = {.log_modulus_sd = 0.01, .mesh_amplitude = 0.5, .mesh_remainder_sd = 0.003};
  settings.bootstraps = 1;
  return settings;
}

/// Moduli measured of a material whose droplets mix.
std::vector<measurement::SpecimenRecord> mixed_specimens() {
  material::ParameterSet truth = synthetic_truth();
  truth.extensions["droplet_mixing"] = {0.6};
  return synthetic_specimens({.patterns = 8, .twins = 3}, truth);
}

/// What was measured with one modulus more.
Observations with_test(const Observations& measured, const PossibleTest& test) {
  Observations observations = measured;
  observations.rows.push_back({static_cast<int>(observations.groups.size()), Feature::log_modulus, RowKind::mean,
                               test.test, 1.0 / kReplicates, static_cast<std::size_t>(test.test)});
  observations.groups.push_back(group_of(test, kReplicates));
  observations.values.conservativeResize(observations.size());
  return observations;
}

/// Data that are exactly what a model predicts, and chi squared of any model fitted to them.
struct ExactData {
  const Evidence& evidence;
  Observations observations;
  FeatureModel model;
  ExactData(const Evidence& from, Observations rows)
      : evidence(from), observations(std::move(rows)), model(observations, from.model.basis(), tester::Fidelity::tiny) {
    if (from.observations.has_shared_discretisation())
      observations.discretisation_shared = shared_directions(from, model);
  }
  double chi2(const FittedModel& truth, const FittedModel& fitted) {
    observations.values = model.predict(model.map(truth.effects), truth.u);
    return fit_model(model, observations, {}, fitted.effects, fitted.u).chi2;
  }
  /// Of the wrong model beyond the true one: the prior of the constants bears on both.
  double misfit(const FittedModel& truth, const FittedModel& wrong) { return chi2(truth, wrong) - chi2(truth, truth); }
};

const FittedModel& single(const Evidence& evidence, const std::string& effect) {
  return *std::ranges::find_if(evidence.singles, [&](const FittedModel& fit) { return fit.effects.front() == effect; });
}

/// Moduli of layouts that could be added: two of each kind.
std::vector<PossibleTest> few_tests(const Observations& observations) {
  std::vector<PossibleTest> few;
  std::map<bool, int> counts;
  for (const PossibleTest& test : possible_tests(observations, {}))
    if (test.test == tester::TestKind::modulus && !is_twin(test.way.kind) &&
        counts[test.way.kind == AddedTest::checkerboard]++ < 2)
      few.push_back(test);
  return few;
}

/// Everything known of these moduli, gathered once for all tests.
class MixedDroplets : public testing::Test {
 protected:
  struct Gathered {
    DiagnosisSettings settings = floor_settings();
    Evidence evidence = gather_evidence(data_of(mixed_specimens(), settings), settings);
  };
  static void SetUpTestSuite() { gathered_ = std::make_unique<Gathered>(); }
  static void TearDownTestSuite() { gathered_.reset(); }
  static inline std::unique_ptr<Gathered> gathered_;
};

// The base is refuted by as much as is promised. Of two collinear effects each imitates the other along a curve, which
// slopes do not know: no more may be promised than a test gives, within a standard error.
TEST_F(MixedDroplets, PromiseWhatAModulusThenGives) {
  const Evidence& evidence = gathered_->evidence;
  const std::vector<PossibleTest> tests = few_tests(evidence.observations);
  ASSERT_EQ(tests.size(), 4u);
  const std::vector<FittedModel> models = {single(evidence, "droplet_mixing"), single(evidence, "rigid_overprint"),
                                           evidence.base.fit};
  const PredictedTests predicted(evidence, beside_levels_of(evidence, models), tests, kReplicates);
  const auto misfits = [&](const Observations& rows) {
    ExactData data(evidence, rows);
    return std::array{data.misfit(models[0], models[1]), data.misfit(models[1], models[0]),
                      data.misfit(models[0], models[2])};
  };
  const auto before = misfits(evidence.observations);
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const auto after = misfits(with_test(evidence.observations, tests[t]));
    const double of_a_collinear_effect = 0.5 * (after[0] - before[0] + after[1] - before[1]),
                 of_the_base = after[2] - before[2];
    const std::vector<Separation> promised = predicted.separations(t, {{0, 1}, {0, 2}});
    const std::string test = tests[t].design.name() + ", " + in_words(tests[t]);
    EXPECT_NEAR(std::pow(promised[1].errors, 2) / of_the_base, 1.0, 0.15) << test;
    EXPECT_LT(promised[0].errors, std::sqrt(std::max(of_a_collinear_effect, 0.0)) + 0.5) << test;
  }
}

TEST_F(MixedDroplets, ATestThatBothModelsTakeForAReplicateSeparatesNothing) {
  const Evidence& evidence = gathered_->evidence;
  std::vector<PossibleTest> twins = possible_tests(evidence.observations, {});
  std::erase_if(twins, [](const PossibleTest& test) { return !is_twin(test.way.kind); });
  const std::vector<FittedModel> models = {single(evidence, "droplet_mixing"),
                                           single(evidence, "interface_anisotropy")};
  const PredictedTests predicted(evidence, beside_levels_of(evidence, models), twins, kReplicates);
  double most_turned = 0.0;
  for (std::size_t t = 0; t < twins.size(); ++t) {
    const double errors = predicted.separations(t, {{0, 1}}).front().errors;
    if (twins[t].conditions.orientation_deg == 90.0)
      most_turned = std::max(most_turned, errors);
    else
      EXPECT_EQ(errors, 0.0) << in_words(twins[t]) << ": neither cause knows of rates or thickness";
  }
  EXPECT_GT(most_turned, 1.0) << "of the causes only one has a direction";
}

}  // namespace
}  // namespace nacre::diagnosis
