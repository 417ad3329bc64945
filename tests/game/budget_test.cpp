// A game with people: what is ordered before the first search ends, and what a budget leaves.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "stand_ins.hpp"

namespace nacre::game_test {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// A small game for which a person prints and measures.
game::Scenario persons_scenario() {
  game::Scenario scenario = small_scenario();
  scenario.laboratory.virtual_lab = false;
  return scenario;
}

class OrdersOfPeople : public testing::Test {
 protected:
  void begin(const game::Scenario& scenario) {
    add_players(game_, scenario);
    game_.announce(scenario);
    game_.play();
  }
  std::vector<wire::TestOrder> orders() const { return game_.sent<wire::TestOrder>("TEST_ORDER"); }
  int specimens() const {
    int count = 0;
    for (const wire::TestOrder& order : orders()) count += order.replicates;
    return count;
  }
  void measure_all() {
    for (const wire::TestOrder& order : orders())
      for (const wire::Measurement& measured : measure(order, {})) game_.publish("MEASUREMENT", measured);
    game_.play();
  }
  InProcessGame game_;
};

TEST_F(OrdersOfPeople, BaseMaterialsComeBeforeTheFirstSearch) {
  begin(persons_scenario());
  const auto& sent = game_.everything_sent();
  const auto at = [&](const std::string& channel) {
    return std::ranges::find(sent, channel, &runtime::Message::channel) - sent.begin();
  };
  EXPECT_LT(at("TEST_ORDER"), at("PARAMETERS"));
  std::set<std::string> ids, base;
  for (const wire::TestOrder& order : orders()) {
    EXPECT_TRUE(ids.insert(order.order_id).second) << order.order_id << " is ordered twice";
    EXPECT_EQ(order.round, 1);
    if (order.reason == "base") base.insert(order.design.name());
  }
  EXPECT_EQ(base, (std::set<std::string>{"soft", "interface", "rigid"}));
  for (int i = 0; i < 6; ++i) EXPECT_EQ(orders()[i].reason, "base");
}

// The same orders, measured before or after the search, make the same game.
TEST_F(OrdersOfPeople, BaseMaterialsMeasuredEarlyCountInRound1) {
  begin(persons_scenario());
  measure_all();
  InProcessGame early;
  const game::Scenario scenario = persons_scenario();
  add_players(early, scenario);
  std::vector<wire::Measurement> base;
  for (const wire::TestOrder& order : orders())
    if (order.reason == "base")
      for (const wire::Measurement& measured : measure(order, {})) base.push_back(measured);
  early.announce(scenario);
  for (const wire::Measurement& measured : base) early.publish("MEASUREMENT", measured);  // behind RUN in the queue
  early.play();
  for (const wire::TestOrder& order : early.sent<wire::TestOrder>("TEST_ORDER"))
    for (const wire::Measurement& measured : measure(order, {})) early.publish("MEASUREMENT", measured);
  early.play();
  EXPECT_EQ(early.sent<wire::RoundSummary>("ROUND"), game_.sent<wire::RoundSummary>("ROUND"));
}

TEST_F(OrdersOfPeople, OfTheVirtualLaboratoryWaitForTheSearch) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 1;
  begin(scenario);
  const auto& sent = game_.everything_sent();
  const auto at = [&](const std::string& channel) {
    return std::ranges::find(sent, channel, &runtime::Message::channel) - sent.begin();
  };
  EXPECT_LT(at("PROPOSAL"), at("TEST_ORDER"));
}

// 3 replicates of 3 base materials, 1 mixture, 4 patterns and 3 designs in 2 tests, and 2 twins: 72 specimens.
TEST_F(OrdersOfPeople, KeepToTheBudgetAndTheProposalIsAsLarge) {
  game::Scenario scenario = persons_scenario();
  scenario.budget.specimens_per_round = 33;
  begin(scenario);
  EXPECT_EQ(specimens(), 30) << "3 base materials and 2 designs in 2 tests";
  EXPECT_EQ(game_.sent<wire::Proposal>("PROPOSAL").front().designs.size(), 2U);
  measure_all();
  EXPECT_EQ(game_.sent<wire::Proposal>("PROPOSAL").back().designs.size(), 3U) << "round 2 has room for all";
  EXPECT_EQ(specimens(), 30 + 18);
}

TEST_F(OrdersOfPeople, AreAsEverWithABudgetThatSuffices) {
  begin(persons_scenario());
  InProcessGame rich;
  game::Scenario scenario = persons_scenario();
  scenario.budget = {.specimens_per_round = 72, .total = 1000};
  add_players(rich, scenario);
  rich.announce(scenario);
  rich.play();
  EXPECT_EQ(rich.payloads("TEST_ORDER"), game_.payloads("TEST_ORDER"));
  EXPECT_EQ(specimens(), 72);
}

}  // namespace
}  // namespace nacre::game_test
