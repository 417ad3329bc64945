// Tests that are proposed where a condition is in question.

#include "diagnosis/explanations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "made_specimens.hpp"

namespace nacre::diagnosis {
namespace {

double temperature_of_test(const Made& made) { return std::stod(made.columns.at("temperature_c")); }
double power_of_rate(const Made& made) { return std::pow(made.rate_per_s / 1e-3, 0.12); }

std::vector<Made> rates_with_a_temperature_each() {
  std::vector<Made> all;
  for (const auto& [rate, temperature_c] : {std::pair{1e-3, "60"}, {1e-2, "40"}, {1e-1, "20"}})
    all.push_back({1.0, rate, {{"temperature_c", temperature_c}}});
  return all;
}

/// Whether the test has the rate of one specimen and the temperature of another.
bool is_crossed(const NextExperiment& next) {
  const double own_c = 60.0 - 20.0 * std::log10(next.conditions.strain_rate_per_s / 1e-3);
  return std::abs(*next.surroundings.temperature_c - own_c) > 10.0;
}

double promised_errors(const NextExperiment& next) {
  const std::string by = " by ";
  return std::stod(next.reason.substr(next.reason.rfind(by) + by.size()));
}

// A slow test of a cold specimen is as stiff as the cold or as the slow ones: 0.12 ln 100 apart.
TEST(Explanations, ConditionsThatGoTogetherArePartedByASpecimenUnderEachOfBoth) {
  const Diagnosis diagnosis = diagnose(specimens_of(rates_with_a_temperature_each(), power_of_rate), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  ASSERT_FALSE(diagnosis.next_experiments.empty());
  const NextExperiment& next = diagnosis.next_experiments.front();
  EXPECT_EQ(next.test, tester::TestKind::modulus);
  EXPECT_TRUE(is_crossed(next)) << next.reason;
  // Three further specimens against three measured ones.
  const double apart = 0.12 * std::log(100.0) / (diagnosis.replicate_sd * std::sqrt(2.0 / 3.0));
  EXPECT_NEAR(promised_errors(next) / apart, 1.0, 0.15) << next.reason;
}

// And once they are made the cause has a name, whichever it is.
TEST(Explanations, TheTestThatIsProposedSettlesIt) {
  std::vector<Made> all = rates_with_a_temperature_each();
  const Diagnosis before = diagnose(specimens_of(all, power_of_rate), quick_settings());
  for (const NextExperiment& next : before.next_experiments)
    if (next.test == tester::TestKind::modulus)
      all.push_back({1.0,
                     next.conditions.strain_rate_per_s,
                     {{"temperature_c", std::to_string(*next.surroundings.temperature_c)}}});
  const Diagnosis after = diagnose(specimens_of(all, power_of_rate), quick_settings());
  ASSERT_EQ(to_string(after.verdict), "named") << after.summary;
  EXPECT_EQ(after.effects.front().family, "rate");
  const auto softens = [](const Made& made) { return std::exp(-0.01 * (temperature_of_test(made) - 20.0)); };
  const Diagnosis warm = diagnose(specimens_of(all, softens), quick_settings());
  EXPECT_EQ(told_factors(warm.factors), std::vector<std::string>{"temperature"}) << warm.summary;
}

std::vector<Made> on_machines(const std::vector<double>& rigid_shares) {
  std::vector<Made> all;
  for (const double share : rigid_shares)
    for (const double rate : {1e-3, 1e-2})
      for (const char* machine : {"A", "B"}) all.push_back({share, rate, {{"machine", machine}}});
  return all;
}

double second_reads_higher(const Made& made) {
  return std::pow(1e-3, 1.0 - made.rigid_share) * (made.columns.at("machine") == "B" ? 1.2 : 1.0);
}

// A spring is not seen by what is soft.
TEST(Explanations, GainAndComplianceArePartedByAnotherStiffnessOnBothMachines) {
  std::vector<measurement::SpecimenRecord> specimens = specimens_of(on_machines({1.0}), second_reads_higher);
  for (std::size_t i = 0; i < specimens.size(); ++i) specimens[i].batch = "batch-" + std::to_string(1 + i % 3);
  const Diagnosis diagnosis = diagnose(specimens, quick_settings());
  ASSERT_EQ(diagnosis.cautions.rival_laws.size(), 2u) << diagnosis.summary;
  ASSERT_FALSE(diagnosis.next_experiments.empty());
  const NextExperiment& next = diagnosis.next_experiments.front();
  EXPECT_EQ(next.design, pattern::Design(pattern::Mixture{0.0})) << next.reason;
  EXPECT_EQ(next.machines, (std::vector<std::string>{"A", "B"}));
  EXPECT_GT(promised_errors(next), 2.0);
}

TEST(Explanations, MachinesAreToldFromTheirSpecimensByAPieceOnBoth) {
  const Diagnosis diagnosis = diagnose(specimens_of(on_machines({1.0, 0.0}), second_reads_higher), quick_settings());
  ASSERT_TRUE(diagnosis.cautions.machines_not_compared) << diagnosis.summary;
  ASSERT_FALSE(diagnosis.next_experiments.empty());
  for (const NextExperiment& next : diagnosis.next_experiments)
    EXPECT_EQ(next.machines, (std::vector<std::string>{"A", "B"})) << next.reason;
  // Three pieces on both; what they are to show rests on six specimens on each.
  const double apart = std::log(1.2) / (diagnosis.replicate_sd * std::sqrt(2.0 / 3.0 + 2.0 / 6.0));
  EXPECT_NEAR(promised_errors(diagnosis.next_experiments.front()) / apart, 1.0, 0.2);
}

// At a temperature that nobody measured, free levels say nothing: no test there may promise anything.
TEST(Explanations, ALevelOfANewTemperatureIsNoPrediction) {
  std::vector<Made> all;
  for (const char* temperature_c : {"-10", "10", "30", "60", "90"})
    for (const double rate : {1e-3, 1e-2, 1e-1}) all.push_back({1.0, rate, {{"temperature_c", temperature_c}}});
  const auto warm_is_slow = [](const Made& made) {
    const double above = temperature_of_test(made) - 23.0;
    return std::pow(made.rate_per_s * std::pow(10.0, -8.86 * above / (101.6 + above)), 0.1);
  };
  const Diagnosis diagnosis = diagnose(specimens_of(all, warm_is_slow), quick_settings());
  ASSERT_EQ(diagnosis.effects.size(), 2u) << diagnosis.summary;
  for (const NextExperiment& next : diagnosis.next_experiments)
    EXPECT_TRUE(std::set<double>({-10.0, 10.0, 30.0, 60.0, 90.0}).contains(*next.surroundings.temperature_c))
        << next.reason;
}

/// What was printed or treated together, five of each.
std::vector<measurement::SpecimenRecord> in_batches(const std::vector<Made>& all,
                                                    const std::function<double(const Made&)>& law) {
  std::vector<measurement::SpecimenRecord> specimens = specimens_of(all, law);
  for (measurement::SpecimenRecord& each : specimens) each.batch = each.other_columns.extract("batch_of").mapped();
  return specimens;
}

std::vector<Made> a_humidity_a_batch() {
  std::vector<Made> all;
  for (const auto& [batch, humidity] : {std::pair{"A", "20"}, {"B", "50"}, {"C", "80"}})
    for (int twice = 0; twice < 2; ++twice)
      all.push_back({1.0, 1e-3, {{"humidity_pct", humidity}, {"batch_of", batch}}});
  return all;
}

double softens_in_humidity(const Made& made) {
  return std::exp(-0.006 * (std::stod(made.columns.at("humidity_pct")) - 50.0));
}
double is_of_its_batch(const Made& made) { return made.columns.at("batch_of") == "A" ? 1.2 : 1.0; }

TEST(Explanations, HumidityAndBatchArePartedByPiecesOfABatchInAnotherHumidity) {
  const Diagnosis before = diagnose(in_batches(a_humidity_a_batch(), softens_in_humidity), quick_settings());
  ASSERT_EQ(before.factors.size(), 2u) << before.summary;
  ASSERT_FALSE(before.next_experiments.empty());
  const NextExperiment& next = before.next_experiments.front();
  EXPECT_THAT(next.reason, testing::HasSubstr("of the batch")) << next.reason;
  EXPECT_GT(promised_errors(next), 4.0);
  // And once they are tested they tell which it is.
  std::vector<Made> all = a_humidity_a_batch();
  all.push_back({1.0, 1e-3, {{"humidity_pct", "80"}, {"batch_of", "A"}}});
  all.push_back({1.0, 1e-3, {{"humidity_pct", "20"}, {"batch_of", "C"}}});
  const Diagnosis humid = diagnose(in_batches(all, softens_in_humidity), quick_settings());
  EXPECT_EQ(told_factors(humid.factors), std::vector<std::string>{"humidity"}) << humid.summary;
  const Diagnosis batch = diagnose(in_batches(all, is_of_its_batch), quick_settings());
  EXPECT_EQ(told_factors(batch.factors), std::vector<std::string>{"batch"}) << batch.summary;
}

TEST(Explanations, AgeAndPrintOrderArePartedByAPieceAtAnotherAge) {
  std::vector<Made> all;
  for (const char* age_days : {"1", "10", "100"})
    for (int twice = 0; twice < 2; ++twice) all.push_back({1.0, 1e-3, {{"age_days", age_days}}});
  std::vector<measurement::SpecimenRecord> specimens = specimens_of(
      all, [](const Made& made) { return 1.0 + 0.1 * std::log10(std::stod(made.columns.at("age_days"))); });
  for (std::size_t i = 0; i < specimens.size(); ++i) specimens[i].print_order = static_cast<int>(i) + 1;
  const Diagnosis diagnosis = diagnose(specimens, quick_settings());
  ASSERT_EQ(diagnosis.cautions.alike.size(), 1u) << diagnosis.summary;
  ASSERT_FALSE(diagnosis.next_experiments.empty());
  const NextExperiment& next = diagnosis.next_experiments.front();
  EXPECT_THAT(next.reason, testing::HasSubstr("from a dependence on print order")) << next.reason;
  EXPECT_GT(promised_errors(next), 4.0);
}

// Over two decades of the rate three forms agree: which it is shows after hours.
TEST(Explanations, FormsOfALawOfTheRateArePartedByPauses) {
  std::vector<Made> all;
  for (const double rate : {1e-3, 3e-3, 1e-2}) all.push_back({1.0, rate});
  const Diagnosis diagnosis =
      diagnose(specimens_of(all, [](const Made& made) { return 1.3 * power_of_rate(made); }), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_FALSE(diagnosis.next_experiments.empty());
  const NextExperiment& next = diagnosis.next_experiments.front();
  EXPECT_TRUE(next.hold_s || next.loading.has_pauses()) << next.reason;
  EXPECT_GT(promised_errors(next), 3.0);
}

}  // namespace
}  // namespace nacre::diagnosis
