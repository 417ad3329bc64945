#include "game/design_states.hpp"

#include <gtest/gtest.h>

#include <map>

namespace nacre::game {
namespace {

const pattern::Design kDesign = *pattern::design_from_name("577fffe9fffdef");
const pattern::Design kOther = *pattern::design_from_name("3ffc9b4ad4d2d9");

Order order_of(const pattern::Design& design, tester::TestKind test = tester::TestKind::modulus) {
  return {.id = order_id(1, design, test, {}),
          .round = 1,
          .design = design,
          .test = test,
          .conditions = {},
          .replicates = 2,
          .batch = "round-1",
          .reason = OrderReason::proposal};
}

std::vector<Order> both_orders_of(const pattern::Design& design) {
  return {order_of(design), order_of(design, tester::TestKind::toughness)};
}

measurement::SpecimenRecord specimen_of(const std::string& name, const pattern::Design& design,
                                        tester::TestKind test = tester::TestKind::modulus) {
  measurement::SpecimenRecord record;
  record.specimen = name;
  record.design = design;
  record.test = test;
  record.modulus_pa = 1e9;
  return record;
}

DesignStage stage_of(const LaboratoryFacts& facts, const pattern::Design& design) {
  for (const DesignState& state : design_states(facts)) {
    if (state.design == design) return state.stage;
  }
  ADD_FAILURE() << design.name() << " is unknown";
  return DesignStage::pending;
}

TEST(DesignStates, WhatIsOpenOfADesignIsWithdrawnAndGivenAgain) {
  LaboratoryFacts facts;
  facts.orders = both_orders_of(kDesign);
  const std::string modulus = facts.orders[0].id, toughness = facts.orders[1].id;
  for (const char* name : {"A-1", "A-2"}) facts.book.enter(specimen_of(name, kDesign), "");
  EXPECT_EQ(orders_to_change(facts, kDesign, true), std::vector{toughness}) << "the other one is complete";
  EXPECT_TRUE(why_void(facts, modulus, true)->ends_with("its specimens are measured, and count"));
  EXPECT_TRUE(why_void(facts, toughness, false)->ends_with("is not withdrawn"));
  facts.withdrawals.enter(toughness, {1, true, "Ada", "cannot be notched"});
  const DesignState state = design_states(facts).front();
  EXPECT_EQ(to_string(state.stage), "withdrawn");
  EXPECT_EQ(state.decided_by + ": " + state.why, "Ada: cannot be notched");
  EXPECT_TRUE(why_void(facts, toughness, true)->ends_with("was withdrawn by Ada: cannot be notched"));
  EXPECT_TRUE(why_void(facts, kDesign, true)->ends_with("no order of it is open: it is withdrawn"));
  EXPECT_EQ(orders_to_change(facts, kDesign, false), std::vector{toughness});
  facts.withdrawals.enter(toughness, {2, false, "Ada", ""});
  facts.withdrawals.enter(toughness, {1, true, "Bob", "an old word that comes late"});
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::printed);
  facts.orders.push_back(order_of(kOther));
  facts.orders.back().round = 2;
  EXPECT_TRUE(orders_to_change(facts, kDesign, true).empty()) << "its round is over";
}

TEST(DesignStates, NothingButAnOpenOrderCanBeWithdrawn) {
  LaboratoryFacts facts;
  facts.proposed = {{0, kDesign}, {0, kOther}};
  facts.approvals = {{0, kOther, true, "lab", "go"}};
  EXPECT_TRUE(why_void(facts, kDesign, true)->ends_with("reject it instead"));
  EXPECT_TRUE(why_void(facts, kOther, true)->ends_with("withdraw it when the next round has begun"));
  EXPECT_TRUE(why_void(facts, pattern::Mixture{0.5}, true)->ends_with("is not ordered"));
  EXPECT_TRUE(why_void(facts, std::string("r9/soft/modulus"), true)->ends_with("there is no such order"));
}

TEST(DesignStates, ADesignGoesFromPendingToMeasured) {
  LaboratoryFacts facts;
  facts.proposed = {{0, kDesign}};
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::pending);
  facts.approvals = {{0, kDesign, true, "lab", "go"}};
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::approved);
  facts.orders = {order_of(kDesign), order_of(kDesign, tester::TestKind::toughness)};
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::approved);
  facts.printed = {{"A-1", kDesign, tester::TestKind::modulus, 0.0, ""}};
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::printed);
  for (const char* name : {"A-1", "A-2"}) facts.book.enter(specimen_of(name, kDesign), "");
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::printed) << "toughness is still to be measured";
  for (const char* name : {"T-1", "T-2"}) facts.book.enter(specimen_of(name, kDesign, tester::TestKind::toughness), "");
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::measured);
  const DesignState state = design_states(facts).front();
  EXPECT_EQ(state.ordered, 4);
  EXPECT_EQ(state.arrived, 4);
  EXPECT_EQ(state.decided_by, "lab");
}

TEST(DesignStates, ReplicatesAreEnoughWhenTheGameSaysSo) {
  LaboratoryFacts facts;
  const auto settings = [&](int replicates, int enough_valid) {
    facts.replicates = replicates;
    facts.enough_valid = enough_valid;
    const measurement::ConsistencySettings chosen = consistency_settings(facts);
    return std::pair(chosen.fewest_tested, chosen.fewest_consistent);
  };
  EXPECT_EQ(settings(0, 0), std::pair(4, 3)) << "the thesis";
  EXPECT_EQ(settings(2, 0), std::pair(2, 2));
  EXPECT_EQ(settings(5, 0), std::pair(5, 3));
  EXPECT_EQ(settings(5, 4), std::pair(5, 4));
}

TEST(DesignStates, WhatWasMeasuredWasPrinted) {
  LaboratoryFacts facts;
  facts.orders = {order_of(kDesign), order_of(kDesign, tester::TestKind::toughness)};
  facts.book.enter(specimen_of("A-1", kDesign), "");
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::printed);
  EXPECT_EQ(design_states(facts).front().printed, 1) << "it was not reported";
}

TEST(DesignStates, TheFirstDecisionCounts) {
  LaboratoryFacts facts;
  facts.proposed = {{0, kDesign}};
  facts.approvals = {{0, kDesign, false, "lab", "islands"}, {0, kDesign, true, "other", "go"}};
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::rejected);
  EXPECT_EQ(design_states(facts).front().why, "islands");
}

TEST(DesignStates, TheOppositeOfTheFirstDecisionOnAProposalDoesNotCount) {
  LaboratoryFacts facts;
  const StatedApproval yes{0, kDesign, true, "other", "go"};
  EXPECT_FALSE(approval_against(facts, yes));
  facts.approvals = {{0, kOther, false, "lab", ""}, {0, kDesign, false, "lab", "islands"}, yes};
  ASSERT_TRUE(approval_against(facts, yes));
  EXPECT_EQ(approval_against(facts, yes)->why, "islands");
  EXPECT_FALSE(approval_against(facts, {0, kDesign, false, "other", "again"})) << "the same word";
  EXPECT_FALSE(approval_against(facts, {1, kDesign, true, "other", "go"})) << "another proposal";
}

// The validation agent passes these over; a page that took them for decisions would hide the buttons that the game
// waits for.
TEST(DesignStates, WhatTheGamePassesOverDecidesNothing) {
  LaboratoryFacts facts;
  facts.proposed = {{1, kDesign}};
  facts.approvals = {{-1, kDesign, true, "lab", "as my own"}, {7, kDesign, true, "lab", "no such round"}};
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::pending);
  facts.approvals.push_back({1, kDesign, true, "lab", "go"});
  EXPECT_EQ(stage_of(facts, kDesign), DesignStage::approved);
  facts.approvals = {{-1, kOther, true, "lab", "as my own"}};
  EXPECT_EQ(stage_of(facts, kOther), DesignStage::approved) << "nobody proposed it";
}

TEST(DesignStates, ADecisionThatWouldChangeNothingSaysWhy) {
  LaboratoryFacts facts;
  facts.proposed = {{0, kDesign}};
  const auto reason = [&](const StatedApproval& decision, bool asks = true) {
    return why_void(facts, decision, asks).value_or("");
  };
  EXPECT_EQ(reason({0, kDesign, true, "lab", ""}), "");
  EXPECT_EQ(reason({0, kDesign, true, "lab", ""}, false),
            "this game does not ask for approvals: proposed designs are ordered at once");
  EXPECT_EQ(reason({3, kDesign, true, "lab", ""}), "577fffe9fffdef is not in proposal 3");
  EXPECT_EQ(reason({-1, kDesign, true, "lab", ""}),
            "577fffe9fffdef is proposed and waits for approval: approve it in the proposal");
  EXPECT_EQ(reason({-1, kOther, true, "lab", ""}), "");
  EXPECT_NE(reason({-1, kOther, false, "lab", ""}), "");
  facts.approvals = {{0, kDesign, false, "Ada", "islands"}};
  EXPECT_EQ(reason({0, kDesign, true, "lab", ""}), "577fffe9fffdef was already rejected by Ada, which is kept");
  facts.orders = both_orders_of(kOther);
  EXPECT_EQ(reason({-1, kOther, true, "lab", ""}), "3ffc9b4ad4d2d9 was already ordered; the order is kept");
}

TEST(DesignStates, WhatWaitsForAnAnswerWaitsWhateverWasPrintedOfIt) {
  LaboratoryFacts facts;
  facts.proposed = {{0, kDesign}};
  facts.printed = {{"look-1", kDesign, tester::TestKind::modulus, 0.0, ""}};
  const StatedApproval own{-1, kDesign, true, "lab", ""};
  EXPECT_NE(why_void(facts, own, true).value_or(""), "") << "a printed look";
  facts.book.enter(specimen_of("look-1", kDesign), "");
  EXPECT_NE(why_void(facts, own, true).value_or(""), "") << "a measured one";
  facts.approvals = {{0, kDesign, false, "lab", "no"}};
  EXPECT_EQ(why_void(facts, own, true), std::nullopt) << "refused as a proposal, and wanted all the same";
}

TEST(DesignStates, AnOrderOfATurnedSpecimenOrOfOneTestIsNoneOfTheDesignAsAPersonAddsIt) {
  LaboratoryFacts facts;
  facts.orders = both_orders_of(kDesign);
  for (Order& order : facts.orders) order.conditions.orientation_deg = 90.0;
  EXPECT_FALSE(are_both_ordered(facts.orders, kDesign));
  facts.orders.push_back(order_of(kDesign));
  EXPECT_FALSE(are_both_ordered(facts.orders, kDesign)) << "an experiment of the diagnosis may be of its modulus alone";
  facts.orders.push_back(order_of(kDesign, tester::TestKind::toughness));
  EXPECT_TRUE(are_both_ordered(facts.orders, kDesign));
  EXPECT_FALSE(are_both_ordered(facts.orders, kOther));
}

TEST(DesignStates, WhatWasMeasuredWithoutAnOrderIsMeasured) {
  LaboratoryFacts facts;
  facts.book.enter(specimen_of("brought", kOther), "");
  EXPECT_EQ(stage_of(facts, kOther), DesignStage::measured);
  EXPECT_EQ(design_states(facts).front().round, -1);
}

TEST(DesignStates, PrintedSpecimensCountOnceForTheOrderTheyCarryOrFit) {
  const std::vector<Order> orders = {order_of(kDesign), order_of(kDesign, tester::TestKind::toughness)};
  const std::vector<PrintedSpecimen> printed = {
      {"A-1", kDesign, tester::TestKind::modulus, 0.0, orders[0].id},
      {"A-2", kDesign, tester::TestKind::modulus, 0.0, ""},
      {"A-3", kDesign, tester::TestKind::modulus, 0.0, ""},     // one too many
      {"A-4", kDesign, tester::TestKind::toughness, 90.0, ""},  // turned: another order
      {"A-5", kOther, tester::TestKind::toughness, 0.0, ""}};
  EXPECT_EQ(printed_for(orders, printed), (std::vector<int>{2, 0}));
}

}  // namespace
}  // namespace nacre::game
