#include "virtual_lab/virtual_lab_core.hpp"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/result.hpp"
#include "laboratory/draw.hpp"
#include "virtual_lab/experiment_text.hpp"
#include "wire/from_json.hpp"
#include "wire/schema.hpp"

namespace nacre::virtual_lab {
namespace {

using runtime::Message;
using runtime::Outputs;
using runtime::WorkDone;

Truth truth() { return laboratory::draw_truth(31, tester::Fidelity::tiny); }

wire::TestOrder order(const std::string& id, const char* design, tester::TestKind test = tester::TestKind::modulus) {
  wire::TestOrder order;
  order.round = 1;
  order.order_id = id;
  order.design = pattern::design_from_name(design).value();
  order.test = test;
  order.fidelity = tester::Fidelity::tiny;
  order.replicates = 3;
  order.batch = "round-1";
  order.reason = "random";
  return order;
}

Message message(const wire::TestOrder& order) { return {.channel = "TEST_ORDER", .payload = wire::write(order)}; }

/// Steps through the messages, does the long work in the given order of arrival, and returns every MEASUREMENT sent.
std::vector<std::string> play(const std::vector<Message>& messages, bool work_backwards) {
  VirtualLabCore core(truth());
  const auto work = work_functions(truth());
  std::vector<runtime::Compute> computes;
  std::vector<std::string> sent;
  const auto take = [&](Outputs outputs) {
    for (auto& compute : outputs.computes) computes.push_back(compute);
    for (auto& measurement : outputs.messages) sent.push_back(measurement.payload);
  };
  for (const Message& each : messages) take(core.step(each));
  if (work_backwards) std::ranges::reverse(computes);
  for (const auto& compute : std::vector(computes))
    take(core.step(WorkDone{.id = compute.id, .result = work.at(compute.kind)(compute.spec)}));
  std::ranges::sort(sent);
  return sent;
}

std::vector<Message> three_orders() {
  return {message(order("r1/a/modulus", "577fffe9fffdef")), message(order("r1/mix/modulus", "mix:0.65")),
          message(order("r2/a/modulus", "577fffe9fffdef"))};
}

TEST(VirtualLabCore, EverySpecimenOfAnOrderIsReportedWithItsOrderAndBatch) {
  const auto sent = play({message(order("r1/a/modulus", "577fffe9fffdef"))}, false);
  ASSERT_EQ(sent.size(), 3u);
  std::set<std::string> names;
  for (const std::string& payload : sent) {
    const auto measurement = wire::read<wire::Measurement>(payload);
    ASSERT_TRUE(measurement) << measurement.error().message;
    EXPECT_EQ(measurement->order_id, "r1/a/modulus");
    EXPECT_EQ(measurement->round, 1);
    EXPECT_EQ(measurement->record.batch, "round-1");
    EXPECT_GE(measurement->record.print_order, 1);
    EXPECT_TRUE(measurement->record.valid && measurement->record.modulus_pa);
    names.insert(measurement->record.specimen);
  }
  EXPECT_EQ(names.size(), 3u);
}

TEST(VirtualLabCore, TellsWhatItHadHiddenAfterTheLastRoundOnce) {
  Truth hiding = truth();
  hiding.effects = {};
  hiding.effects.corner_debonding = 0.88;
  hiding.effects.rate_overstress = 0.5, hiding.effects.rate_relaxation_s = 8.0;
  VirtualLabCore core(hiding);
  wire::RoundSummary round;
  round.round = 1;
  EXPECT_TRUE(core.step(Message{"ROUND", wire::write(round)}).messages.empty());
  round.last = true;
  const Outputs outputs = core.step(Message{"ROUND", wire::write(round)});
  ASSERT_EQ(outputs.messages.size(), 1u);
  EXPECT_EQ(outputs.messages[0].channel, "REVEAL");
  const auto reveal = wire::read<wire::Reveal>(outputs.messages[0].payload);
  ASSERT_TRUE(reveal) << reveal.error().message;
  EXPECT_EQ(reveal->parameters.toughness, hiding.toughness);
  ASSERT_EQ(reveal->causes.size(), 2u);
  EXPECT_EQ(reveal->causes[0].name, "corner_debonding");
  EXPECT_FALSE(reveal->causes[0].in_library);
  EXPECT_EQ(reveal->causes[0].values, std::vector<double>{0.88});
  EXPECT_EQ(reveal->causes[1].values, (std::vector<double>{0.5, 8.0}));
  EXPECT_TRUE(core.step(Message{"ROUND", wire::write(round)}).messages.empty());
}

TEST(VirtualLabCore, SpecimensDoNotDependOnTheOrderInWhichAnythingArrives) {
  auto orders = three_orders();
  const auto expected = play(orders, false);
  EXPECT_EQ(expected.size(), 9u);
  std::ranges::reverse(orders);
  EXPECT_EQ(play(orders, false), expected);
  EXPECT_EQ(play(orders, true), expected);
}

TEST(VirtualLabCore, ARepeatedOrderChangesNothingAndAnotherUnderTheSameIdIsRefused) {
  auto orders = three_orders();
  const auto expected = play(orders, false);
  orders.push_back(orders.front());
  EXPECT_EQ(play(orders, false), expected);
  VirtualLabCore core(truth());
  core.step(orders.front());
  wire::TestOrder other = order("r1/a/modulus", "577fffe9fffdef");
  other.replicates = 5;
  const Outputs outputs = core.step(message(other));
  EXPECT_TRUE(outputs.messages.empty() && outputs.computes.empty());
  EXPECT_EQ(outputs.log.size(), 1u);
}

TEST(VirtualLabCore, EqualExperimentsAreSimulatedOnce) {
  VirtualLabCore core(truth());
  int computes = 0;
  for (const Message& each : three_orders()) computes += static_cast<int>(core.step(each).computes.size());
  EXPECT_EQ(computes, 2);
}

TEST(VirtualLabCore, AnOrderOfMoreSpecimensThanTheTruthHasPullsThemAll) {
  Truth of_two = truth();
  of_two.replicates = 2;
  VirtualLabCore core(of_two);
  wire::TestOrder few = order("r1/a/toughness", "577fffe9fffdef", tester::TestKind::toughness);
  few.replicates = 2;
  wire::TestOrder many = few;
  many.order_id = "r1/b/toughness", many.replicates = 3;
  const Outputs first = core.step(message(few)), second = core.step(message(many));
  ASSERT_EQ(first.computes.size(), 1u);
  ASSERT_EQ(second.computes.size(), 1u);
  EXPECT_EQ(experiment_from_spec(first.computes[0].spec)->specimens, 0) << "as many as the truth has";
  EXPECT_EQ(experiment_from_spec(second.computes[0].spec)->specimens, 3);
}

TEST(VirtualLabCore, ACouponThatIsUnloadedIsAnotherExperiment) {
  VirtualLabCore core(truth());
  const wire::TestOrder pulled = order("r1/a/tensile", "rigid", tester::TestKind::tensile);
  wire::TestOrder unloaded = order("r1/b/tensile", "rigid", tester::TestKind::tensile);
  unloaded.loading = {{0.02, 0.005, 0.022}};
  EXPECT_EQ(core.step(message(pulled)).computes.size(), 1u);
  const Outputs outputs = core.step(message(unloaded));
  ASSERT_EQ(outputs.computes.size(), 1u);
  EXPECT_EQ(experiment_from_spec(outputs.computes.front().spec).value().loading, unloaded.loading);
}

TEST(VirtualLabCore, AnUnknownLoadingProgrammeIsRefusedWithAWarningThatQuotesIt) {
  VirtualLabCore core(truth());
  auto cyclic =
      wire::to_json("test_order_t", wire::write(order("r1/a/tensile", "rigid", tester::TestKind::tensile))).value();
  cyclic["loading"] = "load to 0.01, unload";
  const Outputs outputs =
      core.step(Message{.channel = "TEST_ORDER", .payload = wire::from_json("test_order_t", cyclic).value()});
  EXPECT_TRUE(outputs.messages.empty() && outputs.computes.empty());
  ASSERT_EQ(outputs.log.size(), 1u);
  EXPECT_THAT(outputs.log.front().text, testing::HasSubstr("load to 0.01, unload"));
}

TEST(VirtualLabCore, HostileInputIsRefusedWithAWarningAndChangesNothing) {
  VirtualLabCore core(truth());
  for (const runtime::Input& input : {runtime::Input(Message{.channel = "TEST_ORDER", .payload = "garbage"}),
                                      runtime::Input(WorkDone{.id = "measure/unknown", .result = "{}"})}) {
    const Outputs outputs = core.step(input);
    EXPECT_TRUE(outputs.messages.empty() && outputs.computes.empty());
    EXPECT_EQ(outputs.log.size(), 1u);
  }
  EXPECT_EQ(core.status().phase, "waiting for orders");
}

TEST(VirtualLabCore, AnUnreadableResultOfWorkGivesInvalidSpecimens) {
  VirtualLabCore core(truth());
  const Outputs asked = core.step(three_orders().front());
  const Outputs outputs = core.step(WorkDone{.id = asked.computes.front().id, .result = "not JSON"});
  ASSERT_EQ(outputs.messages.size(), 3u);
  EXPECT_FALSE(wire::read<wire::Measurement>(outputs.messages.front().payload)->record.valid);
}

}  // namespace
}  // namespace nacre::virtual_lab
