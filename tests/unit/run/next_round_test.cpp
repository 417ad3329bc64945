#include "run/next_round.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run/measured_patterns.hpp"

namespace nacre::run {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// One bit apart each.
pattern::Pattern pattern_of(int number) {
  return pattern::Pattern(0x577fffe9fffdef ^ (1ull << static_cast<unsigned>(number)));
}

wire::ProposedDesign proposed(int number, double modulus_pa, double toughness_pa) {
  wire::ProposedDesign design;
  design.design = pattern_of(number);
  design.modulus_pa = modulus_pa;
  design.toughness_pa = toughness_pa;
  return design;
}

/// One specimen for each property.
void measure(RunRecord& run, int round, int number, double modulus_pa, double toughness_pa) {
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness}) {
    MeasuredSpecimen specimen;
    specimen.round = specimen.measured_in = round;
    specimen.record.specimen = fmt::format("{}-{}", number, tester::to_string(test));
    specimen.record.design = pattern_of(number);
    specimen.record.test = test;
    (test == tester::TestKind::modulus ? specimen.record.modulus_pa : specimen.record.toughness_pa) =
        test == tester::TestKind::modulus ? modulus_pa : toughness_pa;
    run.specimens.push_back(specimen);
  }
}

void close(RunRecord& run, int round) {
  auto& summary = run.rounds[round].summary.emplace();
  summary.round = round;
  summary.after.modulus_mean = 0.04;
  summary.after.toughness_mean = 0.08;
}

/// Round 1 measured a design that a model without patterns predicted badly, and proposes three.
RunRecord after_round_1() {
  RunRecord run;
  run.rounds[0].proposals = {proposed(0, 3e9, 5e6)};
  close(run, 0);
  measure(run, 1, 0, 1e9, 0.5e6);
  close(run, 1);
  run.rounds[1].proposals = {proposed(1, 1.2e9, 0.45e6), proposed(2, 1.5e9, 0.4e6), proposed(3, 0.9e9, 0.6e6)};
  return run;
}

const std::vector<game::MeasuredDesign> kOfRound1 = {{.round = 1, .mean = {1e9, 0.5e6}}};

TEST(NextRound, CannotBeToldBeforeARoundIsMeasured) {
  RunRecord run;
  EXPECT_THAT(in_words(next_round(run)), HasSubstr("it cannot be told yet"));
  EXPECT_EQ(next_round(run).round, 1);
  close(run, 0);
  EXPECT_FALSE(next_round(run).expected);
}

TEST(NextRound, IsExpectedByTheErrorsOfTheFitWhereOnlyTheFirstModelWasWrong) {
  const NextRound next = next_round(after_round_1());
  EXPECT_EQ(next.round, 2);
  EXPECT_NEAR(next.hypervolume_gpa_mpa, 0.5, 1e-12);
  ASSERT_EQ(next.brought.size(), 1U);
  EXPECT_NEAR(next.brought[0].growth.mean_gpa_mpa, 0.5, 1e-12);
  ASSERT_TRUE(next.expected);
  EXPECT_TRUE(next.is_scatter_of_fit);
  const double per_mean = std::sqrt(std::numbers::pi / 2.0);
  const std::vector<optimize::Performance> designs = {{1.2e9, 0.45e6}, {1.5e9, 0.4e6}, {0.9e9, 0.6e6}};
  const game::Growth expected =
      game::expected_growth(kOfRound1, designs, {.of_design = 0.04 * per_mean}, {.of_design = 0.08 * per_mean}, 1);
  EXPECT_EQ(next.expected->mean_gpa_mpa, expected.mean_gpa_mpa);
  EXPECT_THAT(in_words(next), StartsWith("round 1 brought 0.5000 +- 0.0000 GPa MPa of measured hypervolume; round 2 is "
                                         "expected to bring 0."));
  EXPECT_THAT(in_words(next), HasSubstr("; by the errors of the fit)"));
}

TEST(NextRound, IsExpectedByTheErrorsOfDesignsThatWerePredicted) {
  RunRecord run = after_round_1();
  measure(run, 2, 1, 1.3e9, 0.4e6);
  measure(run, 2, 2, 1.4e9, 0.5e6);
  measure(run, 2, 3, 0.9e9, 0.5e6);
  close(run, 2);
  run.rounds[2].proposals = {proposed(1, 1.2e9, 0.45e6), proposed(4, 2.0e9, 0.35e6)};
  const NextRound next = next_round(run);
  EXPECT_EQ(next.round, 3);
  EXPECT_EQ(next.brought.size(), 2U);
  EXPECT_FALSE(next.is_scatter_of_fit);
  const std::vector<int> rounds = {2, 2, 2};
  const auto modulus =
      game::prediction_scatter(rounds, std::vector{std::log(1.3 / 1.2), std::log(1.4 / 1.5), std::log(0.9 / 0.9)});
  const auto toughness =
      game::prediction_scatter(rounds, std::vector{std::log(0.4 / 0.45), std::log(0.5 / 0.4), std::log(0.5 / 0.6)});
  std::vector<game::MeasuredDesign> measured;
  for (const MeasuredPattern& each : measured_patterns(run, 2))
    measured.push_back({.round = each.round, .mean = each.mean});
  std::ranges::sort(measured, {}, [](const auto& each) { return each.mean.modulus_pa; });
  const game::Growth expected =
      game::expected_growth(measured, std::vector<optimize::Performance>{{2.0e9, 0.35e6}}, modulus, toughness, 1);
  EXPECT_NEAR(next.expected->mean_gpa_mpa, expected.mean_gpa_mpa, 1e-9) << "what is measured is not to be measured";
  EXPECT_THAT(in_words(next),
              StartsWith("round 1 brought 0.5000 +- 0.0000 GPa MPa of measured hypervolume, round 2 0."));
}

TEST(NextRound, SaysThatNothingNewIsProposed) {
  RunRecord run = after_round_1();
  run.rounds[1].proposals = {proposed(0, 1e9, 0.5e6)};
  EXPECT_THAT(in_words(next_round(run)), HasSubstr("; round 1 has proposed no design that is not measured"));
}

}  // namespace
}  // namespace nacre::run
