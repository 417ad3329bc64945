#include "dashboard/round_price.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "game/rounds.hpp"

namespace nacre::dashboard {
namespace {

using testing::HasSubstr;

/// Round 1 measures three base materials and one design in two tests, twice each: 8 notched specimens, which fill a
/// tray, and 8 bars, which take another.
game::Scenario scenario_of() {
  game::Scenario scenario;
  scenario.rounds = 2;
  scenario.proposal.designs = 1;
  scenario.validation.replicates = 2;
  scenario.validation.random_patterns = 0;
  scenario.validation.mixtures = {};
  scenario.validation.approval = true;
  scenario.diagnosis.enabled = false;
  scenario.laboratory.virtual_lab = false;
  scenario.laboratory.layers_per_minute = 2.02;
  scenario.laboratory.minutes_per_test = 15.0;
  return scenario;
}

const pattern::Design kProposed = pattern::Pattern(0x577fffe9fffdef);

TEST(RoundPrice, IsExpectedBeforeAnythingIsProposed) {
  const RoundPrice price = price_of_round(scenario_of(), {}, 1);
  EXPECT_TRUE(price.is_expected);
  EXPECT_EQ(price.all.specimens, 16);
  EXPECT_EQ(price.all.trays, 2);
  EXPECT_EQ(price.all.slices, 202);
  EXPECT_NEAR(price.all.printing_h, 202 / 2.02 / 60.0, 1e-9);
  EXPECT_NEAR(price.all.testing_h, 4.0, 1e-9);
  EXPECT_EQ(price.left, price.all);
  EXPECT_THAT(in_words(price), testing::StartsWith("round 1, as expected: 16 specimens on 2 trays, 202 slices, about "
                                                   "1.7 h of printing, 4.0 h of testing, "));
  EXPECT_EQ(price_of_round(scenario_of(), {}, 2).all.specimens, 4) << "without base materials";
}

TEST(RoundPrice, ABaseMaterialThatIsPrintedDuringTheFirstSearchIsNotLeft) {
  game::LaboratoryFacts facts;
  facts.orders = game::base_orders(scenario_of());
  facts.printed = {{"a-1", facts.orders[0].design, facts.orders[0].test, 0.0, facts.orders[0].id}};
  const RoundPrice price = price_of_round(scenario_of(), facts, 1);
  EXPECT_EQ(price.all.specimens, 16);
  EXPECT_EQ(price.left.specimens, 15);
}

TEST(RoundPrice, FollowsProposalApprovalAndPrint) {
  const game::Scenario scenario = scenario_of();
  game::LaboratoryFacts facts;
  facts.orders = game::base_orders(scenario);
  facts.proposed = {{0, kProposed}};
  const RoundPrice waiting = price_of_round(scenario, facts, 1);
  EXPECT_FALSE(waiting.is_expected);
  EXPECT_EQ(waiting.all.specimens, 16) << "as if it were approved";
  facts.approvals = {{0, kProposed, false, "me", "islands"}};
  EXPECT_EQ(price_of_round(scenario, facts, 1).all.specimens, 12);
  facts.approvals = {};
  for (const game::Order& order : game::proposal_orders(scenario, 1, std::vector{kProposed}))
    facts.orders.push_back(order);
  for (const game::Order& order : facts.orders)
    for (int i = 0; i < order.replicates; ++i)
      facts.printed.push_back({order.id + std::to_string(i), order.design, order.test, 0.0, order.id});
  const RoundPrice printed = price_of_round(scenario, facts, 1);
  EXPECT_EQ(printed.all.specimens, 16);
  EXPECT_EQ(printed.left, fabricate::Price{});
  EXPECT_THAT(in_words(printed), HasSubstr("; all are printed"));
}

TEST(RoundPrice, SaysWhatTheBudgetTook) {
  game::Scenario scenario = scenario_of();
  scenario.proposal.designs = 4;
  scenario.budget.specimens_per_round = 20;
  const RoundPrice price = price_of_round(scenario, {}, 1);
  EXPECT_EQ(price.all.specimens, 20);
  EXPECT_THAT(in_words(price), HasSubstr("; the budget allows 2 of 4 designs in round 1"));
}

}  // namespace
}  // namespace nacre::dashboard
