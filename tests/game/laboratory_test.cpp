// Games whose laboratory misbehaves, or is a person; approvals, reviews, injected measurements.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "game/rounds.hpp"
#include "in_process_game.hpp"
#include "pattern/coupons.hpp"
#include "person_game.hpp"
#include "stand_ins.hpp"
#include "validation_agent/order_desk.hpp"

namespace nacre::game_test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST_F(PersonGame, WaitsForTheLastSpecimenHoweverItIsReported) {
  begin();
  EXPECT_EQ(rounds(), 1u) << "round 0 needs no laboratory";
  auto all = all_measurements();
  // Backwards, and without the order's id, as measurement sets come.
  std::reverse(all.begin(), all.end());
  for (auto& measured : all) {
    measured.order_id.clear();
    measured.round = -1;
  }
  for (std::size_t i = 0; i + 1 < all.size(); ++i) report(all[i]);
  EXPECT_EQ(rounds(), 1u);
  EXPECT_THAT(game_.status_of("validation_agent").phase, HasSubstr("measuring"));
  report(all.back());
  EXPECT_EQ(rounds(), 2u);
  EXPECT_TRUE(last_round().last);
}

TEST_F(PersonGame, TheOrderOfMeasurementsDoesNotMatter) {
  begin();
  InProcessGame other;
  begin(other);
  auto all = all_measurements();
  for (const auto& measured : all) report(measured);
  std::reverse(all.begin(), all.end());
  std::rotate(all.begin(), all.begin() + 7, all.end());
  for (const auto& measured : all) other.publish("MEASUREMENT", measured);
  other.play();
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(other.essence(), game_.essence());
}

TEST_F(PersonGame, RepeatsAreIgnoredAndContradictionsRefused) {
  begin();
  const auto all = all_measurements();
  report(all.front());
  report(all.front());
  EXPECT_THAT(game_.complaints_of("validation_agent"), IsEmpty());
  EXPECT_THAT(game_.refusals_of("validation_agent"), IsEmpty());
  auto other = all.front();
  *other.record.modulus_pa *= 2.0;
  report(other);
  EXPECT_THAT(game_.refusals_of("validation_agent"), ElementsAre(HasSubstr("other content")));
  EXPECT_THAT(game_.complaints_of("validation_agent"), Contains(HasSubstr("other content")));
  for (const auto& measured : all) report(measured);
  ASSERT_EQ(rounds(), 2u);
  const auto reference = last_round();
  InProcessGame clean;
  begin(clean);
  for (const auto& measured : all) clean.publish("MEASUREMENT", measured);
  clean.play();
  EXPECT_EQ(clean.sent<wire::RoundSummary>("ROUND").back(), reference);
}

TEST_F(PersonGame, InvalidSpecimensCompleteAnOrderAndAreNotUsed) {
  begin();
  auto all = all_measurements();
  // One design has no valid toughness specimen, one modulus specimen is absurd and invalid.
  const std::string spoiled = game_.sent<wire::Proposal>("PROPOSAL").front().designs.front().design.name();
  bool absurd = false;
  for (auto& measured : all) {
    measurement::SpecimenRecord& record = measured.record;
    if (record.design.name() == spoiled && record.test == tester::TestKind::toughness) {
      record.valid = false;
      record.note = "slipped";
    } else if (!absurd && record.design.layout() != nullptr && record.test == tester::TestKind::modulus) {
      absurd = true;
      record.modulus_pa = 500e9;
      record.valid = false;
      record.note = "load cell overflow";
    }
    report(measured);
  }
  ASSERT_EQ(rounds(), 2u);
  EXPECT_THAT(game_.complaints_of("validation_agent"), SizeIs(4));
  EXPECT_THAT(game_.complaints_of("validation_agent"), Contains(HasSubstr("load cell overflow")));
  EXPECT_EQ(last_round().calibration_count, 7);
  EXPECT_EQ(last_round().after.toughness_count, 6) << "the spoiled design has a modulus only";
  EXPECT_LT(last_round().measured_hypervolume_staircase, 100.0);
}

TEST_F(PersonGame, AReviewTakesASpecimenOutAndTheHighestRevisionWins) {
  begin();
  auto all = all_measurements();
  const auto victim = std::find_if(all.begin(), all.end(), [](const wire::Measurement& measured) {
    return measured.record.design.layout() != nullptr && measured.record.test == tester::TestKind::modulus;
  });
  victim->record.modulus_pa = 500e9;
  const auto review = [&](int revision, bool valid) {
    wire::Review message;
    message.specimen = victim->record.specimen;
    message.revision = revision;
    message.valid = valid;
    message.by = "lab";
    message.why = "decimal point";
    game_.publish({"REVIEW", wire::write(message)});
    game_.play();
  };
  review(2, false);  // before the measurement it is about
  for (const auto& measured : all) {
    if (&measured == &*victim) review(1, true);
    report(measured);
  }
  ASSERT_EQ(rounds(), 2u);
  EXPECT_LT(last_round().measured_hypervolume_staircase, 100.0);
  EXPECT_LT(last_round().before.modulus_max, 10.0);
}

TEST_F(PersonGame, DesignsThatNobodyOrderedJoinTheCalibrationSet) {
  begin();
  const pattern::Design unknown = pattern::Pattern(0x3ffc9b4ad4d2d9ULL);
  for (tester::TestKind test : {tester::TestKind::modulus, tester::TestKind::toughness}) {
    wire::TestOrder invented;
    invented.round = 1;
    invented.order_id = std::string("somebody else/") + std::string(tester::to_string(test));
    invented.design = unknown;
    invented.test = test;
    invented.fidelity = scenario_.fidelity;
    invented.replicates = 2;
    for (auto measured : measure(invented, {})) {
      measured.round = -1;
      measured.order_id.clear();
      report(measured);
    }
  }
  EXPECT_EQ(rounds(), 1u) << "the orders are still open";
  for (const auto& measured : all_measurements()) report(measured);
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(last_round().calibration_count, 8);
  EXPECT_EQ(last_round().held_out.modulus_count, 3) << "nobody had predicted it";
  const auto model = game_.sent<wire::AdoptedModel>("PARAMETERS").back();
  EXPECT_THAT(model.measured, Contains(*pattern::Pattern::from_layout(*unknown.layout())));
}

TEST_F(PersonGame, SpecimensWithSwappedLabelsCloseNoOrderOfADesignThatNobodyTested) {
  begin();
  const auto proposal = game_.sent<wire::Proposal>("PROPOSAL").front();
  const pattern::Design untested = proposal.designs.at(0).design, tested = proposal.designs.at(1).design;
  std::vector<wire::Measurement> awaited;
  for (wire::Measurement measured : all_measurements()) {
    if (measured.record.design == untested && measured.record.test == tester::TestKind::modulus) {
      awaited.push_back(measured);
      measured.record.design = tested;
      measured.record.specimen += "-mislabelled";
    }
    report(measured);
  }
  ASSERT_THAT(awaited, SizeIs(3));
  EXPECT_EQ(rounds(), 1u);
  EXPECT_THAT(game_.complaints_of("validation_agent"), SizeIs(3));
  EXPECT_THAT(game_.complaints_of("validation_agent"), Each(HasSubstr("does not fit order")));
  for (const wire::Measurement& measured : awaited) report(measured);
  EXPECT_EQ(rounds(), 2u);
}

TEST_F(PersonGame, TwinsAtAnotherRateAreNotHeldAgainstWhatWasPredicted) {
  begin();
  const auto all = all_measurements();
  const auto proposal = game_.sent<wire::Proposal>("PROPOSAL").front();
  for (wire::Measurement twin : all) {
    const auto is_it = [&](const auto& each) { return each.design == twin.record.design; };
    if (std::ranges::none_of(proposal.designs, is_it)) continue;
    twin.record.specimen += "-fast";
    twin.record.conditions.strain_rate_per_s *= 10.0;
    twin.order_id.clear();
    twin.round = -1;
    report(twin);
  }
  for (const auto& measured : all) report(measured);
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(last_round().held_out.modulus_count, 3);
  EXPECT_EQ(last_round().held_out.toughness_count, 3);
}

TEST_F(PersonGame, AMeasurementOfAnotherFidelityIsRefused) {
  begin();
  auto measured = all_measurements().front();
  measured.fidelity = tester::Fidelity::full;
  report(measured);
  EXPECT_THAT(game_.complaints_of("validation_agent"), Contains(HasSubstr("fidelity full")));
  EXPECT_THAT(game_.refusals_of("validation_agent"), ElementsAre(HasSubstr("fidelity full")));
}

TEST_F(PersonGame, OrdersStayOpenUntilTheyAreMeasured) {
  begin();
  const auto open = [&] {
    std::vector<std::string> payloads;
    for (const runtime::Message& message : game_.open("validation_agent", "TEST_ORDER")) {
      EXPECT_EQ(message.channel, "TEST_ORDER");
      payloads.push_back(message.payload);
    }
    return payloads;
  };
  std::vector<std::string> ordered = game_.payloads("TEST_ORDER");
  EXPECT_EQ(open(), ordered) << "the same bytes: a program that heard them knows them";
  EXPECT_THAT(game_.open("validation_agent", "PROPOSAL"), IsEmpty()) << "nothing waits for approval";
  const auto all = all_measurements();
  const std::string first = all.front().order_id;
  for (const auto& measured : all)
    if (measured.order_id == first) report(measured);
  ordered.erase(ordered.begin());
  EXPECT_EQ(open(), ordered);
  for (const auto& measured : all) report(measured);
  EXPECT_THAT(open(), IsEmpty());
}

TEST_F(PersonGame, EnoughValidSpecimensCompleteAnOrder) {
  scenario_.validation.enough_valid = 2;
  begin();
  for (const auto& measured : all_measurements()) {
    if (!measured.record.specimen.ends_with("#3")) report(measured);
  }
  EXPECT_EQ(rounds(), 2u);
}

TEST_F(PersonGame, SpecimensMeasuredInAdvanceCountForLaterOrders) {
  add_players(game_, scenario_);
  // The pure materials are known from before: reported even before the run is announced.
  for (const auto& order : game::opening_orders(scenario_, {})) {
    wire::TestOrder early{.round = 1,
                          .order_id = order.id,
                          .design = order.design,
                          .test = order.test,
                          .fidelity = scenario_.fidelity,
                          .replicates = order.replicates,
                          .conditions = order.conditions,
                          .loading = {},
                          .batch = "",
                          .reason = ""};
    for (auto measured : measure(early, {})) {
      measured.order_id.clear();
      measured.round = -1;
      report(measured);
    }
  }
  game_.announce(scenario_);
  game_.play();
  EXPECT_THAT(game_.status_of("validation_agent").phase, HasSubstr("8 of 24 orders complete"));
}

class ApprovalGame : public PersonGame {
 protected:
  ApprovalGame() {
    scenario_.validation.approval = true;
    scenario_.laboratory.virtual_lab = true;
  }
  void send_approval(const pattern::Design& design, bool approved, int round = 0) {
    wire::Approval message;
    message.round = round;
    message.design = design;
    message.approved = approved;
    message.by = "head of the lab";
    message.why = approved ? "go" : "too thin to print";
    game_.publish({"APPROVAL", wire::write(message)});
    game_.play();
  }
  std::set<std::string> ordered() const {
    std::set<std::string> names;
    for (const auto& order : game_.sent<wire::TestOrder>("TEST_ORDER")) names.insert(order.design.name());
    return names;
  }
};

TEST_F(ApprovalGame, NothingProposedIsOrderedWithoutAYes) {
  begin();
  EXPECT_EQ(rounds(), 1u);
  const auto designs = game_.sent<wire::Proposal>("PROPOSAL").front().designs;
  for (const auto& each : designs) EXPECT_FALSE(ordered().contains(each.design.name()));
  EXPECT_EQ(game_.status_of("validation_agent").phase, "waits for you: 3 designs to approve");
  send_approval(designs[0].design, true);
  send_approval(designs[1].design, false);
  EXPECT_EQ(rounds(), 1u);
  send_approval(designs[2].design, true);
  ASSERT_EQ(rounds(), 2u);
  EXPECT_TRUE(ordered().contains(designs[0].design.name()));
  EXPECT_FALSE(ordered().contains(designs[1].design.name()));
  EXPECT_EQ(last_round().calibration_count, 6);
  EXPECT_EQ(last_round().held_out.modulus_count, 2);
  // A refused design is not proposed again.
  const auto next_designs = game_.sent<wire::Proposal>("PROPOSAL").back().designs;
  for (const auto& each : next_designs) {
    EXPECT_FALSE(each.design == designs[1].design);
  }
}

TEST_F(ApprovalGame, TheFirstApprovalCountsAndStrayOnesAreRefused) {
  begin();
  const auto designs = game_.sent<wire::Proposal>("PROPOSAL").front().designs;
  send_approval(designs[0].design, true);
  send_approval(designs[0].design, false);
  EXPECT_THAT(game_.complaints_of("validation_agent"), Contains(HasSubstr("was approved before")));
  send_approval(pattern::Design(pattern::Mixture{0.65}), true);
  EXPECT_THAT(game_.complaints_of("validation_agent"), Contains(HasSubstr("not in the proposal")));
  send_approval(designs[1].design, true);
  send_approval(designs[2].design, true);
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(last_round().calibration_count, 7);
}

TEST_F(ApprovalGame, ADesignOfAPersonsOwnIsOrderedOnceAndMeasuredWithTheRest) {
  begin();
  const pattern::Design own = pattern::checkerboard(5);
  send_approval(own, true, -1);
  EXPECT_TRUE(ordered().contains(own.name()));
  const std::size_t orders = game_.payloads("TEST_ORDER").size();
  send_approval(own, true, -1);
  EXPECT_THAT(game_.complaints_of("validation_agent"), Contains(HasSubstr("is ordered already")));
  EXPECT_EQ(game_.payloads("TEST_ORDER").size(), orders);
  const auto designs = game_.sent<wire::Proposal>("PROPOSAL").front().designs;
  for (const auto& each : designs) {
    send_approval(each.design, true, -1);
    EXPECT_THAT(game_.complaints_of("validation_agent").back(), HasSubstr("waits for its approval"));
    send_approval(each.design, true);
  }
  ASSERT_EQ(rounds(), 2u);
  EXPECT_EQ(last_round().calibration_count, 8) << "proposals, random patterns and the person's design";
  EXPECT_EQ(last_round().held_out.modulus_count, 3) << "nobody predicted the person's design";
}

TEST_F(PersonGame, MeasurementsOfDesignsThatNobodyProposedAreCalibratedOn) {
  begin();
  auto all = all_measurements();
  wire::Measurement own = all.front();
  own.record.specimen = "brought-along-1";
  own.record.design = pattern::laminate(pattern::LayerDirection::along_y, 2, 3);
  own.record.test = tester::TestKind::modulus;
  own.record.modulus_pa = 0.9e9;
  own.order_id.clear();
  own.round = -1;
  report(own);
  for (const auto& measured : all) report(measured);
  ASSERT_EQ(rounds(), 2u);
  const auto layouts = [&] {
    std::set<std::string> names;
    for (const auto& measured : all) {
      if (measured.record.design.layout() != nullptr) names.insert(measured.record.design.name());
    }
    return names.size();
  }();
  EXPECT_EQ(last_round().calibration_count, static_cast<int>(layouts) + 1);
}

TEST(OwnDesigns, WhatOpensTheGameIsNotOrderedOnceMore) {
  const game::Scenario scenario = small_scenario();
  validation_agent::OrderDesk desk(scenario);
  const pattern::Design own = pattern::checkerboard(5);
  const std::vector<pattern::Design> opening = {pattern::Mixture{1.0}, pattern::Mixture{0.75}};
  for (const pattern::Design& design : {opening[0], opening[1], own}) ASSERT_TRUE(desk.add_own(design, false));
  const std::vector<game::Order> orders = desk.open_round(1, {}, {});
  for (const pattern::Design& design : opening) {
    EXPECT_EQ(std::ranges::count(orders, design, &game::Order::design), 2) << design.name() << ": each test once";
  }
  for (const game::Order& order : orders)
    EXPECT_EQ(order.reason == game::OrderReason::person, order.design == own) << order.id;
  EXPECT_EQ(std::ranges::count(orders, own, &game::Order::design), 2);
  EXPECT_THAT(desk.own(), IsEmpty());
}

TEST(OwnDesigns, AnExperimentOnOneDoesNotStandForIt) {
  validation_agent::OrderDesk desk(small_scenario());
  const pattern::Design coupon = pattern::Mixture{0.7};
  const game::DiscriminationTest experiment{.design = coupon, .test = tester::TestKind::tensile, .replicates = 1};
  ASSERT_EQ(std::ranges::count(desk.open_round(2, {}, {experiment}), coupon, &game::Order::design), 1);
  const auto orders = desk.add_own(coupon, true);
  ASSERT_TRUE(orders) << orders.error().message;
  EXPECT_EQ(orders->size(), 2u);
  EXPECT_FALSE(desk.add_own(coupon, true)) << "now it is ordered";
}

TEST(Approval, TheOrderOfApprovalsDoesNotMatter) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 1;
  scenario.validation.approval = true;
  std::set<std::pair<std::string, std::string>> reference;
  for (const bool backwards : {false, true}) {
    InProcessGame game;
    add_players(game, scenario);
    game.announce(scenario);
    game.play();
    auto designs = game.sent<wire::Proposal>("PROPOSAL").front().designs;
    if (backwards) std::reverse(designs.begin(), designs.end());
    for (const auto& each : designs) {
      wire::Approval message;
      message.round = 0;
      message.design = each.design;
      message.approved = true;
      message.by = "lab";
      game.publish({"APPROVAL", wire::write(message)});
      game.play();
    }
    EXPECT_THAT(game.payloads("ROUND"), SizeIs(2));
    if (reference.empty()) reference = game.essence();
    EXPECT_EQ(game.essence(), reference);
  }
}

}  // namespace
}  // namespace nacre::game_test
