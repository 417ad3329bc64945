#include "diagnosis/factors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/data.hpp"
#include "diagnosis/diagnose.hpp"
#include "made_specimens.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

double temperature_of(const Made& made) { return std::stod(made.columns.at("temperature_c")); }

/// Softer when warm, by far more than it is stiffer when fast; no power of the rate: it levels off.
double warm_and_slow(const Made& made) {
  return std::exp(-0.04 * (temperature_of(made) - 20.0)) * (1.0 + 0.5 * std::tanh(1.0 + std::log10(made.rate_per_s)));
}

std::vector<Made> rates_at_temperatures() {
  std::vector<Made> all;
  for (const char* temperature_c : {"20", "40", "60"})
    for (const double rate : {1e-3, 1e-2, 1e-1, 1.0}) all.push_back({1.0, rate, {{"temperature_c", temperature_c}}});
  return all;
}

Observations observations_of(const std::vector<measurement::SpecimenRecord>& specimens) {
  return observe(specimens, 0.0, {}, {});
}

// Effects of the library tell how layouts go with rate, orientation and thickness.
TEST(Factors, LayoutsHaveThemWhereSurroundingsVary) {
  std::vector<measurement::SpecimenRecord> specimens = specimens_of(rates_at_temperatures(), warm_and_slow);
  const std::vector<std::string> both = {"strain rate", "temperature"};
  EXPECT_EQ(varying_factors(observations_of(specimens)), both);
  specimens.push_back(synthetic_specimens({.patterns = 1, .twins = 0, .replicates = 1}, synthetic_truth()).front());
  EXPECT_EQ(varying_factors(observations_of(specimens)), both);
  for (measurement::SpecimenRecord& specimen : specimens) specimen.other_columns.erase("temperature_c");
  EXPECT_TRUE(varying_factors(observations_of(specimens)).empty());
}

// Free levels compare specimens at equal values; what all of a material have in common stays the model's.
TEST(Factors, LevelsLeaveTheMeanOfAMaterial) {
  const Observations observations = observations_of(specimens_of(rates_at_temperatures(), warm_and_slow));
  const Eigen::MatrixXd levels = level_directions(observations, {"temperature"}, 2.0);
  ASSERT_EQ(levels.rows(), 12);
  ASSERT_EQ(levels.cols(), 3);
  EXPECT_LT(levels.colwise().sum().cwiseAbs().maxCoeff(), 1e-12);
  for (int row = 0; row < 12; ++row) EXPECT_NEAR(levels.row(row).maxCoeff(), 2.0 * (1.0 - 4.0 / 12.0), 1e-12);
  EXPECT_EQ(level_directions(observations, {"humidity"}, 2.0).cols(), 0) << "it does not vary";
}

TEST(Factors, TheRateIsNamedWithinTemperaturesWhateverItsLaw) {
  const Diagnosis diagnosis = diagnose(specimens_of(rates_at_temperatures(), warm_and_slow), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects.front().family, "rate");
  ASSERT_EQ(diagnosis.factors.size(), 1u);
  EXPECT_EQ(diagnosis.factors.front(), (std::vector<std::string>{"strain rate", "temperature"}));
  EXPECT_LT(diagnosis.p_misfit, 0.01) << "of the base alone";
  for (const CandidateEffect& candidate : diagnosis.candidates) {
    if (candidate.status != CandidateStatus::in_set) continue;
    EXPECT_EQ(material::find_effect(candidate.name)->family, "rate") << candidate.name;
  }
  EXPECT_NE(diagnosis.summary.find("temperature"), std::string::npos) << diagnosis.summary;
}

// Each rate at a temperature of its own: either may be the cause.
TEST(Factors, AnAliasOfTheRateGetsNoName) {
  std::vector<Made> all;
  for (const auto& [rate, temperature_c] : {std::pair{1e-3, "60"}, {1e-2, "40"}, {1e-1, "20"}})
    all.push_back({1.0, rate, {{"temperature_c", temperature_c}}});
  const Diagnosis diagnosis = diagnose(specimens_of(all, warm_and_slow), quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_EQ(diagnosis.factors.size(), 2u);
  EXPECT_TRUE(told_factors(diagnosis.factors).empty());
}

// No solid softens when it is pulled faster: what falls with the rate is something else (Payne's amplitude, say).
TEST(Factors, WhatFallsWithTheRateIsNoRateDependence) {
  std::vector<Made> all;
  for (const double rate : {1e-3, 1e-2, 1e-1}) all.push_back({1.0, rate});
  const Diagnosis diagnosis =
      diagnose(specimens_of(all, [](const Made& made) { return std::pow(made.rate_per_s, -0.1); }), quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_EQ(told_factors(diagnosis.factors), std::vector<std::string>{"strain rate"});
}

TEST(Factors, ATemperatureAloneIsNotGreen) {
  std::vector<Made> all;
  for (const char* temperature_c : {"20", "40", "60"}) all.push_back({1.0, 1e-3, {{"temperature_c", temperature_c}}});
  const Diagnosis diagnosis = diagnose(specimens_of(all, warm_and_slow), quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_EQ(diagnosis.finding.reason, Reason::factor);
  EXPECT_EQ(diagnosis.contrasts.front().name, "temperature");
}

// One piece swept at every temperature: what it keeps is no scatter, and the exponent of each temperature is its own.
TEST(Factors, ExponentsDifferFromTemperatureToTemperature) {
  std::vector<Made> all;
  for (const char* temperature_c : {"20", "40", "60"})
    for (double rate = 1e-3; rate < 2.0; rate *= std::sqrt(10.0))
      all.push_back({1.0, rate, {{"temperature_c", temperature_c}, {"sample", "strip"}}});
  const auto law = [](const Made& made) {
    const double warm = (temperature_of(made) - 20.0) / 40.0;
    return std::exp(-3.0 * warm) * std::pow(made.rate_per_s, 0.02 + 0.2 * warm);
  };
  std::vector<measurement::SpecimenRecord> specimens = specimens_of(all, law);
  for (std::size_t i = 0; i < specimens.size(); ++i) specimens[i].modulus_pa = 2e9 * law(all[i / 3]);
  const Diagnosis diagnosis = diagnose(specimens, quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects.front().name, "rate_power_law");
  EXPECT_EQ(diagnosis.finding.reason, Reason::free_form);
  EXPECT_NEAR(diagnosis.effects.front().derived.back().value, 0.12, 0.02) << "the mean exponent";
  ASSERT_TRUE(diagnosis.gain);
  EXPECT_LT(diagnosis.gain->held_out_error_after, 0.1 * diagnosis.gain->held_out_error_before);
}

TEST(Factors, SpecimensThatDependOnNothingNeedNoLevels) {
  const Diagnosis diagnosis =
      diagnose(specimens_of(rates_at_temperatures(), [](const Made&) { return 1.0; }), quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
  EXPECT_TRUE(diagnosis.factors.empty());
}

}  // namespace
}  // namespace nacre::diagnosis
