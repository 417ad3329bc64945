// Blind trials of tabulated moduli: homogeneous specimens of several blends at several rates, no layout and no curve.

#include <gtest/gtest.h>

#include <fstream>

#include "blind_trial.hpp"

namespace nacre::blind {
namespace {

std::vector<laboratory::Experiment> moduli(const std::vector<double>& blends, const std::vector<double>& rates) {
  std::vector<laboratory::Experiment> experiments;
  for (const double fraction : blends) {
    for (const double rate : rates) {
      laboratory::Experiment experiment;
      experiment.design = pattern::Mixture{fraction};
      experiment.conditions.strain_rate_per_s = rate;
      experiments.push_back(experiment);
    }
  }
  return experiments;
}

std::vector<laboratory::Experiment> blends_at_four_rates(std::uint64_t) {
  return moduli({0.0, 0.25, 0.5, 0.75, 1.0}, {1e-4, 1e-3, 1e-2, 1e-1});
}

std::string laboratory(int seed, const std::string& effect = "", const std::string& value = "") {
  return laboratory_file(seed, "tiny", "modulus = 0.05\n", effect, value);
}

/// The interval of a parameter that is told by name holds the value.
void expect_parameter(const nlohmann::json& effect, const std::string& name, double value) {
  const nlohmann::json& parameter = effect["parameters"][name];
  EXPECT_LE(parameter["interval90"][0].get<double>(), value) << name << effect.dump(1);
  EXPECT_GE(parameter["interval90"][1].get<double>(), value) << name << effect.dump(1);
}

TEST(BlindHomogeneousTrials, APowerOfTheRateIsNamedWithItsExponents) {
  const OpenedTrial trial = run_trial(laboratory(61, "rate_power_law", "[0.18, 0.2]"), blends_at_four_rates, "tiny");
  ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
  const nlohmann::json& effect = trial.diagnosis["effects"][0];
  EXPECT_EQ(effect["name"], "rate_dependence");
  EXPECT_EQ(effect["form"], "power_law");
  expect_parameter(effect, "soft_exponent", 0.18);
  expect_parameter(effect, "rigid_exponent", 0.2 * 0.18);
  expect_parameter(effect, "interface_exponent", 0.6 * 0.18);
  EXPECT_GT(trial.diagnosis["gain"]["interval90"][0].get<double>(), 0.5);
}

TEST(BlindHomogeneousTrials, OneRelaxationTimeIsNamedAsThat) {
  const OpenedTrial trial = run_trial(laboratory(62, "rate_dependence", "[0.6, 0.3]"), blends_at_four_rates, "tiny");
  ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
  const nlohmann::json& effect = trial.diagnosis["effects"][0];
  EXPECT_EQ(effect["name"], "rate_dependence");
  EXPECT_EQ(effect["form"], "maxwell");
  EXPECT_NEAR(effect["parameter"].get<double>(), 0.6, 0.15);
}

TEST(BlindHomogeneousTrials, BlendsOffTheMixtureLawAreNamed) {
  const OpenedTrial trial = run_trial(laboratory(63, "blend_law", "0.4"), blends_at_four_rates, "tiny");
  ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
  EXPECT_EQ(trial.diagnosis["effects"][0]["name"], "blend_law");
  EXPECT_NEAR(trial.diagnosis["effects"][0]["parameter"].get<double>(), 0.4, 0.06);
}

// Rates at three temperatures: these move E by more than the rate does, and as other rates would.
TEST(BlindHomogeneousTrials, ThePowerOfTheRateIsNamedWithTheShiftByTemperature) {
  const auto swept = [](std::uint64_t seed) {
    std::vector<laboratory::Experiment> all;
    for (laboratory::Experiment each : blends_at_four_rates(0)) {
      for (const double temperature_c : {10.0, 25.0, 45.0}) {
        each.temperature_c = temperature_c;
        all.push_back(each);
      }
    }
    RandomStream order(seed, "blind trial order");
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[order.index(static_cast<int>(i))]);
    return all;
  };
  const OpenedTrial trial = run_trial(laboratory(71, "rate_power_law", "[0.18, 0.2]"), swept, "tiny");
  ASSERT_EQ(trial.diagnosis["verdict"], "named") << trial.diagnosis["summary"];
  EXPECT_EQ(trial.diagnosis["effects"][0]["name"], "rate_dependence");
  expect_parameter(trial.diagnosis["effects"][0], "soft_exponent", 0.18);
  ASSERT_EQ(trial.diagnosis["effects"].size(), 2u);
  const nlohmann::json& shift = trial.diagnosis["effects"][1];
  EXPECT_EQ(shift["name"], "temperature_shift");
  EXPECT_LE(shift["interval90"][0].get<double>(), 8.86 / 101.6);
  EXPECT_GE(shift["interval90"][1].get<double>(), 8.86 / 101.6);
  ASSERT_EQ(trial.diagnosis["factors"].size(), 1u);
  EXPECT_EQ(trial.diagnosis["factors"][0], (std::vector<std::string>{"strain rate", "temperature"}));
}

// As a person would: measured on two machines by the command line.
TEST(BlindHomogeneousTrials, ASpringOfOneOfTwoMachinesIsNamed) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.folder() / "LAB.toml", set = scratch.folder() / "set";
  std::ofstream(file) << laboratory(72, "compliance_of_one_machine", "1e-10");
  output_of(std::string(NACRE_BINARY_DIR) + "/nacre measure --lab " + file.string() + " --out " + set.string() +
            " --test modulus --machine a b --rate 1e-3 1e-2 -- soft mix:0.25 interface mix:0.75 rigid");
  const nlohmann::json diagnosis = diagnosed(set, "tiny");
  ASSERT_EQ(diagnosis["verdict"], "named") << diagnosis["summary"];
  ASSERT_EQ(diagnosis["effects"].size(), 1u);
  EXPECT_EQ(diagnosis["effects"][0]["name"], "machine_compliance");
  EXPECT_EQ(diagnosis["effects"][0]["form"], "one_machine");
  EXPECT_NEAR(diagnosis["effects"][0]["parameter"].get<double>(), 1e-10, 2e-11);
  EXPECT_EQ(diagnosis["machines"], (std::vector<std::string>{"a", "b"}));
  EXPECT_GT(diagnosis["gain"]["interval90"][0].get<double>(), 0.3);
}

/// As a person would: strains held on pieces of three materials, by the command line.
nlohmann::json diagnosed_relaxation(const std::string& laboratory) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.folder() / "LAB.toml", set = scratch.folder() / "set";
  std::ofstream(file) << laboratory;
  output_of(std::string(NACRE_BINARY_DIR) + "/nacre measure --lab " + file.string() + " --out " + set.string() +
            " --test modulus --hold 1 3 10 30 100 300 1000 -- soft interface rigid");
  return diagnosed(set, "tiny");
}

TEST(BlindHomogeneousTrials, APowerLawIsNamedFromRelaxation) {
  const nlohmann::json diagnosis = diagnosed_relaxation(laboratory(73, "rate_power_law", "[0.18, 0.2]"));
  ASSERT_EQ(diagnosis["verdict"], "named") << diagnosis["summary"];
  const nlohmann::json& effect = diagnosis["effects"][0];
  EXPECT_EQ(effect["name"], "rate_dependence");
  EXPECT_EQ(effect["form"], "power_law");
  expect_parameter(effect, "soft_exponent", 0.18);
  expect_parameter(effect, "rigid_exponent", 0.2 * 0.18);
  EXPECT_GT(diagnosis["gain"]["interval90"][0].get<double>(), 0.5);
}

TEST(BlindHomogeneousTrials, OneRelaxationTimeIsNamedFromRelaxation) {
  const nlohmann::json diagnosis = diagnosed_relaxation(laboratory(74, "rate_dependence", "[0.6, 20]"));
  ASSERT_EQ(diagnosis["verdict"], "named") << diagnosis["summary"];
  const nlohmann::json& effect = diagnosis["effects"][0];
  EXPECT_EQ(effect["name"], "rate_dependence");
  EXPECT_EQ(effect["form"], "maxwell");
  EXPECT_LE(effect["interval90"][0].get<double>(), 0.6);
  EXPECT_GE(effect["interval90"][1].get<double>(), 0.6);
  EXPECT_NEAR(effect["further"][0].get<double>(), 20.0, 4.0);
}

TEST(BlindHomogeneousTrials, WhereNothingRelaxesNothingIsNamed) {
  const nlohmann::json diagnosis = diagnosed_relaxation(laboratory(75));
  EXPECT_EQ(diagnosis["verdict"], "base_sufficient") << diagnosis["summary"];
}

TEST(BlindHomogeneousTrials, NothingIsNamedWhereNothingActs) {
  for (int seed = 64; seed < 70; ++seed) {
    const OpenedTrial trial = run_trial(laboratory(seed), blends_at_four_rates, "tiny");
    EXPECT_EQ(trial.diagnosis["verdict"], "base_sufficient") << trial.diagnosis["summary"];
  }
}

// Too few to tell, and what they do tell.
TEST(BlindHomogeneousTrials, OneMaterialAtOneRateTellsNothingOfAModel) {
  const OpenedTrial trial = run_trial(
      laboratory(70), [](std::uint64_t) { return moduli({1.0}, {1e-3}); }, "tiny");
  EXPECT_EQ(trial.diagnosis["verdict"], "insufficient") << trial.diagnosis["summary"];
  ASSERT_EQ(trial.diagnosis["data"]["means"].size(), 1u);
  EXPECT_EQ(trial.diagnosis["data"]["means"][0]["pieces"], kReplicates);
  EXPECT_FALSE(trial.diagnosis["next_experiments"].empty());
}

}  // namespace
}  // namespace nacre::blind
