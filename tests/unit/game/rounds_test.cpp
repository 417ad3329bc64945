#include "game/rounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace nacre::game {
namespace {

TEST(Rounds, OpeningOrdersNameEveryDesignOncePerTest) {
  Scenario scenario;
  scenario.validation.mixtures = {0.5, 0.6, 0.9, 0.6};
  scenario.validation.replicates = 4;
  const std::vector<pattern::Pattern> random = {pattern::Pattern(7), pattern::Pattern(9)};
  const auto orders = opening_orders(scenario, random);
  std::set<std::string> ids;
  for (const Order& order : orders) {
    EXPECT_TRUE(ids.insert(order.id).second) << order.id;
    EXPECT_EQ(order.replicates, 4);
    EXPECT_EQ(order.round, 1);
  }
  // soft, interface, rigid, two mixtures, two patterns; 0.5 is the interface material.
  EXPECT_EQ(orders.size(), 2u * 7u);
  const auto count = [&](OrderReason reason) {
    return std::count_if(orders.begin(), orders.end(), [&](const Order& order) { return order.reason == reason; });
  };
  EXPECT_EQ(count(OrderReason::base), 6);
  EXPECT_EQ(count(OrderReason::mixture), 4);
  EXPECT_EQ(count(OrderReason::random), 4);
}

TEST(Rounds, RotatedTwinsComeFromThePatternsWithTheLongestInterface) {
  pattern::Pattern solid;
  for (int row = 0; row < pattern::kSide; ++row) {
    for (int column = 0; column < pattern::kSide; ++column) solid.set(row, column, true);
  }
  pattern::Pattern checkered;
  for (int row = 0; row < pattern::kSide / 2; ++row) {
    for (int column = row; column < pattern::kSide / 2; ++column) checkered.set(row, column, (row + column) % 2 == 0);
  }
  const auto twins = rotated_twins(std::vector{solid, checkered}, 3);
  ASSERT_EQ(twins.size(), 2u);
  EXPECT_EQ(twins.front().design, pattern::Design(checkered));
  EXPECT_EQ(twins.front().conditions.orientation_deg, 90.0);
}

TEST(Rounds, DiscriminationOrdersAreLimitedAndHaveIdsOfTheirOwn) {
  Scenario scenario;
  scenario.diagnosis.discrimination_orders = 2;
  const pattern::Design design = pattern::Pattern(7);
  const DiscriminationTest turned{.design = design, .conditions = {.orientation_deg = 90.0}, .replicates = 3};
  DiscriminationTest fast = turned;
  fast.conditions.strain_rate_per_s *= 10.0;
  DiscriminationTest third;
  third.design = pattern::Pattern(9);
  const auto orders = discrimination_orders(scenario, 2, std::vector{turned, turned, fast, third});
  ASSERT_EQ(orders.size(), 2u) << "a repeated test is ordered once, the third falls under the limit";
  EXPECT_NE(orders[0].id, orders[1].id);
  EXPECT_EQ(orders[1].conditions, fast.conditions);
  scenario.diagnosis.discrimination_orders = 0;
  EXPECT_TRUE(discrimination_orders(scenario, 2, std::vector{turned}).empty());
}

TEST(Rounds, CalliperReadingsAnswerTheNominalThickness) {
  EXPECT_TRUE(fulfils({.thickness_mm = 3.27}, {}));
  EXPECT_FALSE(fulfils({.thickness_mm = 1.6}, {}));
  EXPECT_FALSE(fulfils({.orientation_deg = 90.0}, {}));
}

TEST(Rounds, ReasonsOfOrdersComeBackFromTheirNamesAndNoOtherDoes) {
  for (const OrderReason reason : {OrderReason::base, OrderReason::mixture, OrderReason::random, OrderReason::proposal,
                                   OrderReason::discrimination, OrderReason::person, OrderReason::family}) {
    EXPECT_EQ(order_reason_from_string(to_string(reason)), reason);
  }
  EXPECT_FALSE(order_reason_from_string("whim"));
}

}  // namespace
}  // namespace nacre::game
