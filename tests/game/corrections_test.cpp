// What persons take back: amended measurements, withdrawn orders.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "person_game.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::game_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class CorrectedGame : public PersonGame {
 protected:
  void withdraw(const std::string& order, int revision = 1, bool withdrawn = true) {
    withdraw(game_, order, revision, withdrawn);
  }
  static void withdraw(InProcessGame& game, const std::string& order, int revision = 1, bool withdrawn = true) {
    game.publish(
        "WITHDRAWAL",
        wire::Withdrawal{
            .order_id = order, .revision = revision, .withdrawn = withdrawn, .by = "Ada", .why = "cannot be printed"});
    game.play();
  }
  static wire::Measurement amended(wire::Measurement measured, double factor, int revision = 1) {
    measured.revision = revision;
    measured.by = "Ada";
    measured.why = "decimal point";
    if (measured.record.modulus_pa) *measured.record.modulus_pa *= factor;
    return measured;
  }
  /// The first upright modulus specimen of a layout.
  static wire::Measurement& modulus_of_a_layout(std::vector<wire::Measurement>& all) {
    return *std::ranges::find_if(all, [](const wire::Measurement& each) {
      return each.record.design.layout() != nullptr && each.record.test == tester::TestKind::modulus &&
             each.record.conditions.orientation_deg == 0.0;
    });
  }
  void expect_that_a_fresh_core_decides_the_same() {
    const auto fresh = validation_agent::make_core(scenario_);
    EXPECT_GT(game_.replay("validation_agent", *fresh), 0u);
  }
};

TEST_F(CorrectedGame, AMistypedValueIsAmendedAndTheGameIsAsIfItHadBeenRight) {
  begin();
  const auto all = all_measurements();
  InProcessGame right;
  begin(right);
  auto typed = all;
  wire::Measurement& mistyped = modulus_of_a_layout(typed);
  const wire::Measurement correct = mistyped;
  *mistyped.record.modulus_pa *= 0.125;  // exact, and back
  report(mistyped);
  report(amended(mistyped, 8.0));
  EXPECT_THAT(game_.refusals_of("validation_agent"), IsEmpty());
  for (const auto& measured : all)
    if (measured.record.specimen != correct.record.specimen) report(measured);
  for (const auto& measured : all) right.publish("MEASUREMENT", measured);
  right.play();
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(last_round(), right.sent<wire::RoundSummary>("ROUND").back());
  EXPECT_TRUE(game_.payloads("PARAMETERS") == right.payloads("PARAMETERS")) << "to the last bit";
  expect_that_a_fresh_core_decides_the_same();
}

TEST_F(CorrectedGame, AmendmentsInWhateverOrderMakeEqualGames) {
  begin();
  auto all = all_measurements();
  const wire::Measurement first = modulus_of_a_layout(all);
  std::vector<wire::Measurement> reports = all;
  reports.insert(reports.begin(), {amended(first, 3.0), amended(first, 1.5, 2)});
  InProcessGame other;
  begin(other);
  for (const auto& measured : reports) report(measured);
  std::ranges::reverse(reports);
  // The last specimen of all closes the round, as in the first game: what comes later is of the next one.
  std::ranges::rotate(reports, reports.begin() + 1);
  for (const auto& measured : reports) other.publish("MEASUREMENT", measured);
  other.play();
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(game_.essence(), other.essence());
}

TEST_F(CorrectedGame, AnAmendmentOfOtherContentUnderTheSameRevisionIsRefused) {
  begin();
  auto all = all_measurements();
  const wire::Measurement first = modulus_of_a_layout(all);
  report(first);
  report(amended(first, 2.0));
  report(amended(first, 2.0));
  EXPECT_THAT(game_.refusals_of("validation_agent"), IsEmpty());
  report(amended(first, 3.0));
  EXPECT_THAT(game_.refusals_of("validation_agent"),
              Contains(HasSubstr("revision 1 of it was reported before with other content")));
}

TEST_F(CorrectedGame, AnAmendmentAfterTheRoundCountsFromTheNextOneOn) {
  scenario_.rounds = 2;
  begin();
  auto first_round = all_measurements();
  for (const auto& measured : first_round) report(measured);
  ASSERT_EQ(rounds(), 2u);
  const wire::RoundSummary before = last_round();
  wire::Measurement front = modulus_of_a_layout(first_round);
  report(amended(front, 100.0));
  EXPECT_EQ(last_round(), before) << "a closed round stays";
  const auto orders = game_.sent<wire::TestOrder>("TEST_ORDER");
  for (const wire::TestOrder& order : orders) {
    if (order.round < 2) continue;
    for (const auto& measured : measure(order, {})) report(measured);
  }
  ASSERT_EQ(rounds(), 3u);
  EXPECT_GT(last_round().before.modulus_max, 0.5) << "the model cannot follow it";
  EXPECT_LT(before.before.modulus_max, 0.5);
  expect_that_a_fresh_core_decides_the_same();
}

TEST_F(CorrectedGame, TheRoundClosesWithoutAnOrderThatNobodyCanMake) {
  begin();
  const auto all = all_measurements();
  const std::string lost = all.front().order_id;
  for (const auto& measured : all)
    if (measured.order_id != lost) report(measured);
  ASSERT_EQ(rounds(), 1u);
  EXPECT_THAT(game_.open("validation_agent", "TEST_ORDER"), SizeIs(1));
  withdraw(lost);
  EXPECT_THAT(game_.refusals_of("validation_agent"), IsEmpty());
  ASSERT_EQ(rounds(), 2u);
  EXPECT_TRUE(last_round().last);
  expect_that_a_fresh_core_decides_the_same();
}

TEST_F(CorrectedGame, AWithdrawalInWhateverOrderMakesEqualGames) {
  begin();
  const auto all = all_measurements();
  const std::string lost = all.front().order_id;
  InProcessGame other;
  begin(other);
  withdraw(lost);
  for (const auto& measured : all) {
    if (measured.order_id == lost) continue;
    report(measured);
    other.publish("MEASUREMENT", measured);
  }
  withdraw(other, lost);
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(game_.essence(), other.essence());
}

TEST_F(CorrectedGame, WhatWasMeasuredOfAWithdrawnOrderCounts) {
  begin();
  auto all = all_measurements();
  const wire::Measurement kept = modulus_of_a_layout(all);
  for (const auto& measured : all)
    if (measured.order_id != kept.order_id) report(measured);
  withdraw(kept.order_id);
  ASSERT_EQ(rounds(), 2u);
  const int without = last_round().after.modulus_count;
  InProcessGame other;
  begin(other);
  other.publish("MEASUREMENT", kept);
  for (const auto& measured : all)
    if (measured.order_id != kept.order_id) other.publish("MEASUREMENT", measured);
  other.play();
  withdraw(other, kept.order_id);
  EXPECT_EQ(other.sent<wire::RoundSummary>("ROUND").back().after.modulus_count, without + 1);
}

TEST_F(CorrectedGame, AWithdrawnOrderIsGivenAgainWhileItsRoundIsMeasured) {
  begin();
  const auto all = all_measurements();
  const std::string order = all.front().order_id;
  withdraw(order);
  EXPECT_THAT(game_.status_of("validation_agent").phase, HasSubstr("0 of 23 orders complete"));
  withdraw(order, 2, false);
  EXPECT_THAT(game_.status_of("validation_agent").phase, HasSubstr("0 of 24 orders complete"));
  withdraw(order, 1);
  EXPECT_THAT(game_.refusals_of("validation_agent"), Contains(HasSubstr("was given again before by Ada (revision 2)")));
  for (const auto& measured : all) report(measured);
  ASSERT_EQ(rounds(), 2u);
  expect_that_a_fresh_core_decides_the_same();
}

TEST_F(CorrectedGame, WithdrawalsOfNothingOpenAreRefused) {
  begin();
  withdraw("r1/no such order/modulus");
  EXPECT_THAT(game_.refusals_of("validation_agent"), Contains(HasSubstr("there is no order r1/no such order")));
  const auto all = all_measurements();
  for (const auto& measured : all) report(measured);
  ASSERT_EQ(rounds(), 2u);
  withdraw(all.front().order_id);
  EXPECT_THAT(game_.refusals_of("validation_agent").back(), HasSubstr("round 1 of order"));
}

TEST_F(CorrectedGame, ARoundOfWhichEverythingIsWithdrawnCloses) {
  begin();
  for (const auto& order : game_.sent<wire::TestOrder>("TEST_ORDER")) withdraw(order.order_id);
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(last_round().calibration_count, 0);
}

TEST_F(CorrectedGame, AWithdrawnDesignIsNotProposedAgainNorItsTestOrdered) {
  scenario_.rounds = 2;
  begin();
  const auto withdrawn = game_.sent<wire::Proposal>("PROPOSAL").front().designs.front().design;
  const auto all = all_measurements();
  for (const auto& order : game_.sent<wire::TestOrder>("TEST_ORDER"))
    if (order.design == withdrawn) withdraw(order.order_id);
  for (const auto& measured : all)
    if (measured.record.design != withdrawn) report(measured);
  ASSERT_EQ(rounds(), 2u);
  for (const auto& each : game_.sent<wire::Proposal>("PROPOSAL").back().designs) EXPECT_NE(each.design, withdrawn);
  for (const auto& order : game_.sent<wire::TestOrder>("TEST_ORDER"))
    EXPECT_TRUE(order.round == 1 || order.design != withdrawn) << order.order_id;
}

}  // namespace
}  // namespace nacre::game_test
