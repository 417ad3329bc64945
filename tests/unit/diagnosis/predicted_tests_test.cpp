// The information that a test promises before it is made, against what it gives once it is.

#include "diagnosis/predicted_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "diagnosis/factors.hpp"
#include "diagnosis/shared_discretisation.hpp"
#include "diagnosis/words.hpp"
#include "made_specimens.hpp"
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

/// Chi squared of an explanation fitted to exactly what another predicts.
double chi2_of(const Evidence& evidence, Observations rows, const Explanation& truth, const Explanation& fitted) {
  const FeatureModel model(rows, evidence.model.basis(), tester::Fidelity::tiny);
  rows.values = model.predict(model.map(truth.model.effects), truth.model.u);
  rows.levels = free_directions(rows, fitted.beside, {});
  return fit_model(model, rows, {}, fitted.model.effects, fitted.model.u).chi2;
}

/// Pulls of warm specimens that are as slow pulls of cold ones; the rate varies at 23 and 40 C. `stiffness`: 1 puts E
/// at the lower bound of its range.
std::vector<measurement::SpecimenRecord> shifted_specimens(double stiffness) {
  std::vector<Made> all;
  for (const double temperature_c : {10.0, 23.0, 40.0, 60.0})
    for (const double rate : {1e-3, 1e-2, 1e-1})
      if (rate == 1e-2 || temperature_c == 23.0 || temperature_c == 40.0)
        all.push_back({1.0, rate, {{"temperature_c", std::to_string(temperature_c)}}});
  return specimens_of(all, [stiffness](const Made& made) {
    const double above = std::stod(made.columns.at("temperature_c")) - 23.0;
    return stiffness * std::pow(made.rate_per_s * std::pow(10.0, -8.86 * above / (101.6 + above)) / 1e-2, 0.1);
  });
}

// A shifted power of the rate is a level at each temperature: where the exponent was measured a further rate tells
// nothing, and next to nothing is promised. With effects free beyond their ranges it was 20 standard errors.
TEST(PredictedTests, BesideALawOfTheRatePromiseNothingWhereItsExponentWasMeasured) {
  for (const auto& [stiffness, most] : {std::pair{1.5, TestRules{}.least_errors}, {1.0, 3.0}}) {
    const DiagnosisSettings settings = quick_settings();
    const Evidence evidence = gather_evidence(data_of(shifted_specimens(stiffness), settings), settings);
    const std::vector<Explanation> both = explanations_to_separate(evidence, decide(evidence));
    ASSERT_EQ(both.size(), 2u);
    ASSERT_TRUE(both[1].beside.has_exponents);
    std::vector<PossibleTest> tests = possible_tests(evidence.observations, {});
    std::erase_if(tests, [](const PossibleTest& test) {
      return test.way.kind != AddedTest::at_other_rate || test.surroundings.temperature_c != 23.0;
    });
    ASSERT_FALSE(tests.empty());
    const PredictedTests predicted(evidence, both, tests, kReplicates);
    const auto apart = [&](const Observations& rows) {
      return chi2_of(evidence, rows, both[0], both[1]) - chi2_of(evidence, rows, both[0], both[0]);
    };
    const double before = apart(evidence.observations);
    for (std::size_t t = 0; t < tests.size(); ++t) {
      EXPECT_LT(apart(with_test(evidence.observations, tests[t])) - before, 0.25) << "what is given";
      EXPECT_LT(predicted.separations(t, {{0, 1}}).front().errors, most) << in_words(tests[t]);
    }
  }
}

}  // namespace
}  // namespace nacre::diagnosis
