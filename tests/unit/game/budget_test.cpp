#include "game/budget.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/result.hpp"

namespace nacre::game {
namespace {

using testing::HasSubstr;

/// 4 replicates of: in round 1 (3 base materials + 1 mixture + 2 patterns + 4 designs) in 2 tests and 1 discrimination
/// test, 84 specimens; later 4 designs in 2 tests and 1 test, 36.
Scenario scenario_of(BudgetSettings budget) {
  Scenario scenario;
  scenario.rounds = 3;
  scenario.proposal.designs = 4;
  scenario.validation.replicates = 4;
  scenario.validation.random_patterns = 2;
  scenario.validation.mixtures = {0.5, 0.75};
  scenario.diagnosis.discrimination_orders = 1;
  scenario.budget = budget;
  return scenario;
}

int ordered(const Scenario& scenario, int round) {
  int specimens = 0;
  for (const Order& order : expected_orders(scenario, round)) specimens += order.replicates;
  return specimens;
}

TEST(Budget, WithoutOneNothingIsGivenUp) {
  const Scenario scenario = scenario_of({});
  EXPECT_EQ(within_budget(scenario, 1), scenario);
  EXPECT_EQ(ordered(scenario, 1), 84);
  EXPECT_EQ(ordered(scenario, 2), 36);
  EXPECT_EQ(budget_in_words(scenario, 1), "");
  EXPECT_EQ(within_budget(scenario_of({.specimens_per_round = 84, .total = 156}), 1).validation.replicates, 4)
      << "a budget of just what is wanted";
}

TEST(Budget, ReplicatesAreGivenUpFirstAndInEveryRoundAlike) {
  const Scenario scenario = scenario_of({.specimens_per_round = 83});
  EXPECT_EQ(ordered(scenario, 1), 63);
  EXPECT_EQ(ordered(scenario, 2), 27) << "means of all rounds are equally exact";
  EXPECT_EQ(within_budget(scenario, 1).proposal.designs, 4);
  EXPECT_EQ(budget_in_words(scenario, 1), "the budget allows 3 of 4 replicates in round 1");
}

TEST(Budget, ThreeReplicatesAreKeptAndThenDesignsAreGivenUp) {
  const Scenario scenario = scenario_of({.specimens_per_round = 40});
  const Scenario first = within_budget(scenario, 1);
  EXPECT_EQ(first.validation.replicates, 3);
  EXPECT_EQ(first.diagnosis.discrimination_orders, 0);
  EXPECT_EQ(first.validation.mixtures, std::vector{0.5}) << "the interface material is a base material";
  EXPECT_EQ(first.validation.random_patterns, 0);
  EXPECT_EQ(first.proposal.designs, 3) << "3 x 2 x (3 + 3) = 36, one more would be 42";
  EXPECT_EQ(ordered(scenario, 1), 36);
  EXPECT_EQ(within_budget(scenario, 2).proposal.designs, 4) << "later rounds fit";
  EXPECT_EQ(budget_in_words(scenario, 1),
            "the budget allows 3 of 4 replicates, 3 of 4 designs, 0 of 2 random patterns, 0 of 1 mixtures and 0 of 1 "
            "discrimination tests in round 1");
}

TEST(Budget, FewReplicatesAreNotMadeFewer) {
  Scenario scenario = scenario_of({.specimens_per_round = 30});
  scenario.validation.replicates = 2;
  EXPECT_EQ(within_budget(scenario, 1).validation.replicates, 2);
  EXPECT_LE(ordered(scenario, 1), 30);
}

TEST(Budget, ATotalIsLevelledOverTheRounds) {
  for (const int total : {155, 117, 116, 90, 72, 50, 36}) {
    const Scenario scenario = scenario_of({.total = total});
    const int first = ordered(scenario, 1), later = ordered(scenario, 2);
    EXPECT_LE(first + 2 * later, total);
    EXPECT_EQ(ordered(scenario, 3), later);
    EXPECT_EQ(within_budget(scenario, 1).validation.replicates, 3) << total;
  }
  const Scenario scenario = scenario_of({.total = 100});  // 3 replicates: 63 + 2 x 27 = 117
  EXPECT_EQ(ordered(scenario, 1), 42) << "levelled to 46: 3 x 2 x (3 + 4) fits, 54 would not";
  EXPECT_EQ(ordered(scenario, 2), 27) << "a smaller round keeps what it has";
}

TEST(Budget, ThatIsTooSmallForAnyGameIsRefused) {
  const auto complaint = [](std::string_view toml) -> std::string {
    try {
      parse_scenario(toml, "s.toml");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(complaint("[budget]\nspecimens_per_round = 23\n"),
              HasSubstr("s.toml:2:23: budget.specimens_per_round = 23: expected 0, or at least 24"));
  EXPECT_EQ(complaint("[budget]\nspecimens_per_round = 24\n"), "accepted");
  EXPECT_THAT(complaint("rounds = 2\n[budget]\ntotal = 29\n"), HasSubstr("at least 30"));
  EXPECT_EQ(complaint("rounds = 2\n[budget]\ntotal = 30\n"), "accepted");
  EXPECT_THAT(complaint("[laboratory]\nlayers_per_minute = 0\n"), HasSubstr("a number from 0.001 to 1000"));
  EXPECT_THAT(complaint("[laboratory]\ntray_x_mm = 100\n"), HasSubstr("a number from 175 to 10000"));
}

}  // namespace
}  // namespace nacre::game
