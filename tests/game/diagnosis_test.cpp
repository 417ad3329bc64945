// What the game does with a diagnosis: extensions adopted or not, experiments ordered.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "in_process_game.hpp"
#include "pattern/coupons.hpp"
#include "stand_ins.hpp"

namespace nacre::game_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

wire::Diagnosis named(const std::string& effect, double parameter) {
  wire::Diagnosis diagnosis;
  diagnosis.verdict = "named";
  diagnosis.summary = "made up by the test";
  wire::DiagnosedEffect cause;
  cause.name = effect;
  cause.family = "interface";
  cause.parameter = parameter;
  cause.interval_low = 0.9 * parameter;
  cause.interval_high = 1.1 * parameter;
  diagnosis.effects = {cause};
  diagnosis.gain = wire::DiagnosedGain{.held_out_error_before = 0.2,
                                       .held_out_error_after = 0.1,
                                       .relative_reduction = 0.5,
                                       .reduction_low = 0.3,
                                       .reduction_high = 0.6};
  return diagnosis;
}

wire::Diagnosis nothing_wrong() {
  wire::Diagnosis diagnosis;
  diagnosis.verdict = "base_sufficient";
  return diagnosis;
}

InProcessGame played(const game::Scenario& scenario, std::function<wire::Diagnosis(int)> diagnosis,
                     const LaboratorySettings& laboratory = {}) {
  InProcessGame game;
  add_players(game, scenario, laboratory, std::move(diagnosis));
  game.announce(scenario);
  game.play();
  EXPECT_EQ(game.payloads("ROUND").size(), static_cast<std::size_t>(scenario.rounds) + 1);
  return game;
}

bool proposal_agent_asked_with(const InProcessGame& game, const std::string& effect) {
  const auto requests = game.sent<wire::SimulateRequest>("SIMULATE");
  return std::any_of(requests.begin(), requests.end(), [&](const wire::SimulateRequest& request) {
    return request.request_id.starts_with("proposal_agent/") && request.parameters.extensions.contains(effect);
  });
}

/// A game of `rounds` whose laboratory hides an effect that the diagnosis names in the rounds that `names` holds.
InProcessGame played_with(const std::string& effect, double value, int rounds, const std::set<int>& names) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = rounds;
  scenario.proposal.designs = 4;
  LaboratorySettings laboratory;
  laboratory.hidden[effect] = {value};
  return played(
      scenario, [&](int round) { return names.contains(round) ? named(effect, value) : nothing_wrong(); }, laboratory);
}

std::vector<bool> adopted(const InProcessGame& game, const std::string& effect) {
  std::vector<bool> held;
  for (const auto& model : game.sent<wire::AdoptedModel>("PARAMETERS"))
    held.push_back(model.parameters.extensions.contains(effect));
  return held;
}

// Round 1 names it, what it expects of the designs of later rounds comes true, so one of them adopts it; it is kept
// when it is no longer named.
TEST(Diagnosis, AnEffectOfTheMaterialThatPredictsBetterExtendsTheModelOfTheSearch) {
  const auto game = played_with("droplet_mixing", 0.3, 4, {1, 2, 3});
  const std::vector<bool> held = adopted(game, "droplet_mixing");
  EXPECT_FALSE(held[1]) << "a name alone adopts nothing";
  EXPECT_TRUE(held[3]) << "eight designs were predicted within two per cent, against forty";
  EXPECT_TRUE(held[4]);
  EXPECT_TRUE(proposal_agent_asked_with(game, "droplet_mixing"));
}

TEST(Diagnosis, WhatAnExtensionExpectsIsNotedBeforeAnythingIsOrdered) {
  const auto game = played_with("droplet_mixing", 0.3, 2, {1, 2});
  int noted = 0;
  bool ordered = false;
  for (const runtime::Message& message : game.everything_sent()) {
    if (message.channel == "TEST_ORDER") ordered = ordered || wire::read<wire::TestOrder>(message.payload)->round == 2;
    if (message.channel != "SIMULATED") continue;
    const auto response = wire::read<wire::SimulateResult>(message.payload).value();
    if (!response.request_id.starts_with("validation_agent/r2/f/")) continue;
    EXPECT_FALSE(ordered) << response.request_id;
    noted += static_cast<int>(response.results.size());
  }
  EXPECT_EQ(noted, 4) << "designs proposed in round 1";
}

TEST(Diagnosis, WhatSeparatesANameFromTheBaseIsPredictedByBothAndOrdered) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 3;
  scenario.proposal.designs = 4;
  LaboratorySettings laboratory;
  laboratory.hidden["droplet_mixing"] = {0.3};
  const auto diagnosed = [](int) {
    wire::Diagnosis diagnosis = named("droplet_mixing", 0.3);
    for (const int period : {1, 2}) {
      wire::NextExperiment next;
      next.design = pattern::checkerboard(period);
      next.replicates = 2;
      diagnosis.next_experiments.push_back(next);
    }
    wire::NextExperiment turned = diagnosis.next_experiments.front();
    turned.conditions.orientation_deg = 90.0;  // no design of the calibration: the trial has no use for it
    diagnosis.next_experiments.push_back(turned);
    return diagnosis;
  };
  const auto game = played(scenario, diagnosed, laboratory);
  int by_the_name = 0, by_the_adopted = 0;
  for (const auto& response : game.sent<wire::SimulateResult>("SIMULATED")) {
    const int designs = static_cast<int>(response.results.size());
    if (response.request_id.starts_with("validation_agent/r2/f/1/")) by_the_name += designs;
    if (response.request_id.starts_with("validation_agent/r2/f/2/")) by_the_adopted += designs;
  }
  EXPECT_EQ(by_the_name, 2);
  EXPECT_EQ(by_the_adopted, 2);
  std::map<int, int> ordered;  // by round
  for (const auto& order : game.sent<wire::TestOrder>("TEST_ORDER"))
    if (order.reason == "discrimination") ++ordered[order.round];
  EXPECT_TRUE(adopted(game, "droplet_mixing")[2]);
  EXPECT_EQ(ordered[2], 2);
  EXPECT_EQ(ordered[3], 0) << "nothing is left to tell apart once it is adopted";
}

TEST(Diagnosis, AnEffectOfTheTestingMachineActsInComparisonsOnly) {
  const auto game = played_with("machine_compliance", 2e-9, 3, {1, 2, 3});
  EXPECT_TRUE(adopted(game, "machine_compliance").back());
  for (const auto& request : game.sent<wire::SimulateRequest>("SIMULATE")) {
    EXPECT_THAT(request.parameters.extensions, IsEmpty()) << request.request_id;
  }
  EXPECT_FALSE(proposal_agent_asked_with(game, "machine_compliance"));
}

// Prediction errors are taken of what the machine would record: requested again, with curves.
TEST(Diagnosis, PredictionErrorsOfAnExtendedModelAreThoseThroughTheMachine) {
  const auto game = played_with("machine_compliance", 2e-9, 4, {1, 2, 3, 4});
  const std::vector<bool> held = adopted(game, "machine_compliance");
  const auto first = std::find(held.begin(), held.end(), true) - held.begin();
  ASSERT_LT(first, 4);
  const auto requests = game.sent<wire::SimulateRequest>("SIMULATE");
  EXPECT_TRUE(std::any_of(requests.begin(), requests.end(), [&](const wire::SimulateRequest& request) {
    return request.request_id.starts_with("validation_agent/r" + std::to_string(first + 1) + "/h/") &&
           request.curve_points > 0;
  }));
  EXPECT_EQ(game.sent<wire::RoundSummary>("ROUND")[static_cast<std::size_t>(first) + 1].held_out.toughness_count, 4);
}

TEST(Diagnosis, ANameThatPredictsNothingBetterIsNeverAdopted) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 3;
  const auto game = played(scenario, [](int) { return named("droplet_mixing", 0.3); });
  EXPECT_EQ(adopted(game, "droplet_mixing"), std::vector<bool>(4, false)) << "the laboratory hides nothing";
}

TEST(Diagnosis, ANameThatIsNotHeldEndsItsTrial) {
  const auto game = played_with("droplet_mixing", 0.3, 4, {1, 3, 4});
  EXPECT_EQ(adopted(game, "droplet_mixing"), (std::vector<bool>{false, false, false, false, true}))
      << "what it predicted for round 2 does not count in round 3";
}

TEST(Diagnosis, NothingIsAdoptedWithoutAUsableName) {
  game::Scenario scenario = small_scenario();
  LaboratorySettings laboratory;
  laboratory.hidden["droplet_mixing"] = {0.3};
  std::vector<wire::Diagnosis> unusable(3, named("droplet_mixing", 0.3));
  unusable[0].verdict = "ambiguous";
  unusable[1].effects[0].parameter = 1e6;  // outside what the effect allows
  unusable[2].effects[0].name = "gremlins";
  for (const wire::Diagnosis& diagnosis : unusable) {
    const auto game = played(
        scenario, [&](int) { return diagnosis; }, laboratory);
    for (const auto& model : game.sent<wire::AdoptedModel>("PARAMETERS"))
      EXPECT_THAT(model.parameters.extensions, IsEmpty());
  }
}

TEST(Diagnosis, SeparatingExperimentsAreOrderedWithTheProposals) {
  game::Scenario scenario = small_scenario();
  const pattern::Design coupon = pattern::Pattern(0x577fffe9fffdefULL);
  const auto game = played(scenario, [&](int) {
    wire::Diagnosis diagnosis;
    diagnosis.verdict = "ambiguous";
    for (double rate : {6.17e-4, 6.17e-3, 6.17e-2}) {
      wire::NextExperiment next;
      next.design = coupon;
      next.conditions.strain_rate_per_s = rate;
      next.replicates = 2;
      diagnosis.next_experiments.push_back(next);
    }
    wire::NextExperiment& unloaded = diagnosis.next_experiments[1];
    unloaded.design = pattern::Mixture{1.0};
    unloaded.test = tester::TestKind::tensile;
    unloaded.loading = {{0.02, 0.005}};
    return diagnosis;
  });
  std::vector<wire::TestOrder> separating;
  for (const auto& order : game.sent<wire::TestOrder>("TEST_ORDER")) {
    if (order.reason == "discrimination" && order.round == 2) separating.push_back(order);
  }
  ASSERT_THAT(separating, SizeIs(2)) << "discrimination_orders of the scenario";
  EXPECT_EQ(separating[0].design, coupon);
  EXPECT_EQ(separating[1].conditions.strain_rate_per_s, 6.17e-3);
  EXPECT_EQ(separating[1].replicates, 2);
  EXPECT_EQ(separating[0].loading, tester::Loading{});
  EXPECT_EQ(separating[1].loading, (tester::Loading{{0.02, 0.005}}));
}

TEST(Diagnosis, RoundOneOrdersRotatedTwins) {
  const auto game = played(small_scenario(), {});
  int twins = 0;
  for (const auto& order : game.sent<wire::TestOrder>("TEST_ORDER")) {
    if (order.reason != "discrimination") continue;
    EXPECT_EQ(order.round, 1);
    EXPECT_EQ(order.conditions.orientation_deg, 90.0);
    EXPECT_EQ(order.test, tester::TestKind::modulus);
    ++twins;
  }
  EXPECT_EQ(twins, 2);
}

TEST(Diagnosis, ADisabledDiagnosisIsNeitherAskedForNorWaitedFor) {
  game::Scenario scenario = small_scenario();
  scenario.diagnosis.enabled = false;
  const auto game = played(scenario, {});
  EXPECT_THAT(game.payloads("DIAGNOSE"), IsEmpty());
  for (const auto& order : game.sent<wire::TestOrder>("TEST_ORDER")) EXPECT_NE(order.reason, "discrimination");
}

}  // namespace
}  // namespace nacre::game_test
