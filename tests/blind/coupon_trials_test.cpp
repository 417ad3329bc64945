// Blind trials of homogeneous coupons pulled at two rates. The same hidden cause, printed so that two effects are
// collinear, and printed so that they are not.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "blind_trial.hpp"

namespace nacre::blind {
namespace {

/// As slow as creep and as fast as an impact: a relaxation in between has no signature in the shape of either curve.
constexpr double kSlow = 1e-6, kFast = 10.0;

std::vector<laboratory::Experiment> coupons(std::uint64_t) {
  std::vector<laboratory::Experiment> experiments;
  for (const double fraction : {0.0, 0.25, 0.5, 0.65, 0.8, 0.9, 1.0}) {
    for (const double rate : {kSlow, kFast}) {
      laboratory::Experiment experiment;
      experiment.design = pattern::Mixture{fraction};
      experiment.test = tester::TestKind::tensile;
      experiment.conditions.strain_rate_per_s = rate;
      experiments.push_back(experiment);
    }
  }
  return experiments;
}

std::string laboratory(int seed, const std::string& effect, const std::string& value) {
  return laboratory_file(seed, "tiny", "modulus = 0.01\ntoughness = 0.01\nstrain = 0.002\n", effect, value);
}

std::vector<std::string> possible(const OpenedTrial& trial) {
  std::vector<std::string> names;
  for (const auto& model : trial.diagnosis["possible"]) names.push_back(model[0]);
  std::sort(names.begin(), names.end());
  return names;
}

// All fast coupons come from the second batch: batches that drift and materials that respond more stiffly to faster
// pulls have the same signature.
TEST(BlindCouponTrials, RateAndBatchThatChangeTogetherCannotBeDistinguished) {
  const OpenedTrial trial =
      run_trial(laboratory(51, "batch_drift", "0.08"), coupons, "tiny",
                [](const auto& experiment, int) { return experiment.conditions.strain_rate_per_s == kFast ? 1 : 0; });
  EXPECT_EQ(trial.diagnosis["verdict"], "ambiguous") << trial.diagnosis["summary"];
  EXPECT_EQ(possible(trial), (std::vector<std::string>{"batch_drift", "rate_dependence"}))
      << trial.diagnosis["summary"] << trial.diagnosis["candidates"].dump(1);
  EXPECT_TRUE(trial.diagnosis["effects"].empty());
  EXPECT_NE(trial.diagnosis["summary"].get<std::string>().find("cannot tell"), std::string::npos)
      << trial.diagnosis["summary"];
}

// The same drift with both rates in both batches. Means over both batches do not gain by it: replicates show it.
TEST(BlindCouponTrials, BatchesThatHoldBothRatesShowTheirDrift) {
  const OpenedTrial trial = run_trial(laboratory(52, "batch_drift", "0.08"), coupons, "tiny",
                                      [](const auto&, int replicate) { return replicate % 2; });
  ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
  ASSERT_EQ(trial.diagnosis["effects"].size(), 1u);
  EXPECT_EQ(trial.diagnosis["effects"][0]["name"], "batch_drift");
  EXPECT_NEAR(trial.diagnosis["effects"][0]["parameter"].get<double>(), 0.08, 0.012);
}

std::vector<laboratory::Experiment> unloaded_coupons(std::uint64_t seed) {
  std::vector<laboratory::Experiment> experiments = coupons(seed);
  for (laboratory::Experiment& experiment : experiments) experiment.loading = {{0.02, 0.005, 0.022}};
  return experiments;
}

// As a diagnosis orders them. The machine records other strains than the coupon feels, on the way back too.
TEST(BlindCouponTrials, AMachineIsSeenThroughCouponsThatWereUnloadedOnTheWay) {
  for (const auto& [name, value] : {std::pair{"toe_slack", 0.004}, {"machine_compliance", 2.5e-10}}) {
    const OpenedTrial trial = run_trial(laboratory(54, name, fmt::format("{}", value)), unloaded_coupons, "tiny");
    ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
    ASSERT_EQ(trial.diagnosis["effects"].size(), 1u);
    EXPECT_EQ(trial.diagnosis["effects"][0]["name"], name);
    const auto interval = trial.diagnosis["effects"][0]["interval90"];
    const double width = interval[1].get<double>() - interval[0].get<double>();
    EXPECT_NEAR(trial.diagnosis["effects"][0]["parameter"].get<double>(), value, 1.5 * width);
  }
}

// At one rate both bend the pull and leave a set: what recovers at zero force is viscous, what stays has flowed.
TEST(BlindCouponTrials, PausesTellAViscousMaterialFromAPlasticOne) {
  const auto paused = [](std::uint64_t) {
    std::vector<laboratory::Experiment> experiments;
    for (const double fraction : {0.5, 0.75, 1.0})
      experiments.push_back({.design = pattern::Mixture{fraction},
                             .test = tester::TestKind::tensile,
                             .loading = {{0.015}, {60.0}, 600.0}});
    return experiments;
  };
  for (const auto& [name, value] : {std::pair{"rate_dependence", "[0.5, 40]"}, {"rigid_yield", "1.5e7"}}) {
    const OpenedTrial trial = run_trial(laboratory(55, name, value), paused, "tiny");
    ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
    ASSERT_EQ(trial.diagnosis["effects"].size(), 1u);
    EXPECT_EQ(trial.diagnosis["effects"][0]["name"], name);
    const double size = name == std::string("rigid_yield") ? 1.5e7 : 0.5;
    EXPECT_NEAR(trial.diagnosis["effects"][0]["parameter"].get<double>(), size, 0.05 * size);
  }
  EXPECT_EQ(run_trial(laboratory(56, "", ""), paused, "tiny").diagnosis["verdict"], "base_sufficient");
}

std::vector<laboratory::Experiment> unloaded_at_two_rates(std::uint64_t) {
  std::vector<laboratory::Experiment> experiments;
  for (const double fraction : {0.0, 0.25, 0.5, 1.0})
    for (const double rate_per_s : {1e-3, 1e-1})
      experiments.push_back({.design = pattern::Mixture{fraction},
                             .test = tester::TestKind::tensile,
                             .conditions = {.strain_rate_per_s = rate_per_s},
                             .loading = {{0.02, 0.005, 0.022}}});
  return experiments;
}

/// Rate dependence whose form is a branch by phase: of the soft phase alone.
void expect_that_the_soft_phase_relaxes(const nlohmann::json& effect, double overstress, double time_s) {
  EXPECT_EQ(effect["name"], "rate_dependence");
  EXPECT_EQ(effect["form"], "maxwell_by_phase");
  EXPECT_NEAR(effect["parameters"]["soft_overstress"]["value"].get<double>(), overstress, 0.05 * overstress);
  EXPECT_NEAR(effect["parameters"]["relaxation_time"]["value"].get<double>(), time_s, 0.1 * time_s);
  EXPECT_LT(effect["parameters"]["rigid_overstress"]["interval90"][1].get<double>(), 0.05);
}

// No effect of the library relaxes so: a law of the strain rate beyond them does.
TEST(BlindCouponTrials, HowTheSoftPhaseRelaxesAloneIsToldFromCurves) {
  const OpenedTrial trial =
      run_trial(laboratory(57, "soft_rate_dependence", "[0.8, 4]"), unloaded_at_two_rates, "tiny");
  ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
  ASSERT_EQ(trial.diagnosis["effects"].size(), 1u);
  expect_that_the_soft_phase_relaxes(trial.diagnosis["effects"][0], 0.8, 4.0);
}

// Neither an effect of the library, nor two of them, nor a law of the strain rate alone explains the curves.
TEST(BlindCouponTrials, FlowBesideASoftPhaseThatRelaxesAreBothNamed) {
  const OpenedTrial trial = run_trial(
      laboratory(58, "rigid_yield", "2e7") + "[[effect]]\nname = \"soft_rate_dependence\"\nvalue = [0.8, 4]\n",
      unloaded_at_two_rates, "tiny");
  ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
  ASSERT_EQ(trial.diagnosis["effects"].size(), 2u);
  EXPECT_EQ(trial.diagnosis["effects"][0]["name"], "rigid_yield");
  EXPECT_NEAR(trial.diagnosis["effects"][0]["parameter"].get<double>(), 2e7, 0.05 * 2e7);
  expect_that_the_soft_phase_relaxes(trial.diagnosis["effects"][1], 0.8, 4.0);
}

// Alone neither explains the curves: slack lies before the specimen carries, flow at its end.
TEST(BlindCouponTrials, SlackAndFlowAtOnceAreBothNamed) {
  const OpenedTrial trial = run_trial(
      laboratory(53, "rigid_yield", "4.8e7") + "[[effect]]\nname = \"toe_slack\"\nvalue = 0.007\n", coupons, "tiny");
  ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
  std::map<std::string, double> sizes;
  for (const auto& effect : trial.diagnosis["effects"]) sizes[effect["name"]] = effect["parameter"];
  ASSERT_EQ(sizes.size(), 2u) << trial.diagnosis["summary"];
  EXPECT_NEAR(sizes["rigid_yield"], 4.8e7, 0.05 * 4.8e7);
  EXPECT_NEAR(sizes["toe_slack"], 0.007, 0.05 * 0.007);
  EXPECT_GT(trial.diagnosis["gain"]["interval90"][0].get<double>(), 0.0) << "coupons are all there is";
}

}  // namespace
}  // namespace nacre::blind
