// What the game does with a diagnosis: extensions adopted or not, experiments ordered.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "in_process_game.hpp"
#include "stand_ins.hpp"

namespace nacre::game_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

diagnosis_t named(const std::string& effect, double parameter) {
  diagnosis_t diagnosis{};
  diagnosis.verdict = "named";
  diagnosis.summary = "made up by the test";
  effect_t cause{};
  cause.name = effect;
  cause.family = "interface";
  cause.parameter = parameter;
  cause.interval_low = 0.9 * parameter;
  cause.interval_high = 1.1 * parameter;
  diagnosis.effects = {cause};
  diagnosis.has_gain = true;
  diagnosis.held_out_error_before = 0.2;
  diagnosis.held_out_error_after = 0.1;
  diagnosis.relative_reduction = 0.5;
  diagnosis.reduction_low = 0.3;
  diagnosis.reduction_high = 0.6;
  return diagnosis;
}

diagnosis_t nothing_wrong() {
  diagnosis_t diagnosis{};
  diagnosis.verdict = "base_sufficient";
  return diagnosis;
}

InProcessGame played(const game::Scenario& scenario, std::function<diagnosis_t(int)> diagnosis) {
  InProcessGame game;
  add_players(game, scenario, {}, std::move(diagnosis));
  game.announce(scenario);
  game.play();
  EXPECT_EQ(game.payloads("ROUND").size(), static_cast<std::size_t>(scenario.rounds) + 1);
  return game;
}

bool proposal_agent_asked_with(const InProcessGame& game, const std::string& effect) {
  const auto requests = game.said<wire::SimulateRequest>("SIMULATE");
  return std::any_of(requests.begin(), requests.end(), [&](const wire::SimulateRequest& request) {
    return request.request_id.starts_with("proposal_agent/") && request.parameters.extensions.contains(effect);
  });
}

TEST(Diagnosis, AnEstablishedEffectOfTheMaterialExtendsTheModelOfTheSearch) {
  game::Scenario scenario = small_scenario();
  const auto game =
      played(scenario, [](int round) { return round == 1 ? named("interface_anisotropy", 0.2) : nothing_wrong(); });
  const auto models = game.said<wire::AdoptedModel>("PARAMETERS");
  EXPECT_THAT(models[0].parameters.extensions, IsEmpty());
  ASSERT_TRUE(models[1].parameters.extensions.contains("interface_anisotropy"));
  EXPECT_EQ(models[1].parameters.extensions.at("interface_anisotropy"), std::vector<double>{0.2});
  EXPECT_TRUE(models[2].parameters.extensions.contains("interface_anisotropy")) << "an adopted extension stays";
  EXPECT_TRUE(proposal_agent_asked_with(game, "interface_anisotropy"));
}

TEST(Diagnosis, AnEffectOfTheTestingMachineActsInComparisonsOnly) {
  game::Scenario scenario = small_scenario();
  const auto game =
      played(scenario, [](int round) { return round == 1 ? named("machine_compliance", 5e-11) : nothing_wrong(); });
  const auto models = game.said<wire::AdoptedModel>("PARAMETERS");
  EXPECT_TRUE(models[1].parameters.extensions.contains("machine_compliance"));
  for (const auto& request : game.said<wire::SimulateRequest>("SIMULATE")) {
    EXPECT_THAT(request.parameters.extensions, IsEmpty()) << request.request_id;
  }
  // Held-out errors of round 2 are taken of what the machine would show: asked again, with curves.
  const auto requests = game.said<wire::SimulateRequest>("SIMULATE");
  EXPECT_TRUE(std::any_of(requests.begin(), requests.end(), [](const wire::SimulateRequest& request) {
    return request.request_id.starts_with("validation_agent/r2/h/") && request.curve_points > 0;
  }));
  EXPECT_EQ(game.said<wire::RoundSummary>("ROUND")[2].held_out.toughness_count, 3);
}

TEST(Diagnosis, NothingIsAdoptedWithoutANameAndAnEstablishedGain) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 1;
  std::vector<diagnosis_t> unconvincing(4, named("interface_anisotropy", 0.2));
  unconvincing[0].verdict = "ambiguous";
  unconvincing[1].has_gain = false;
  unconvincing[2].reduction_low = -0.1;
  unconvincing[3].effects[0].parameter = 1e6;  // outside what the effect allows
  for (const diagnosis_t& diagnosis : unconvincing) {
    const auto game = played(scenario, [&](int) { return diagnosis; });
    for (const auto& model : game.said<wire::AdoptedModel>("PARAMETERS"))
      EXPECT_THAT(model.parameters.extensions, IsEmpty());
  }
}

TEST(Diagnosis, SeparatingExperimentsAreOrderedBesideTheProposals) {
  game::Scenario scenario = small_scenario();
  const pattern::Design coupon = pattern::Pattern(0x577fffe9fffdefULL);
  const auto game = played(scenario, [&](int) {
    diagnosis_t diagnosis{};
    diagnosis.verdict = "ambiguous";
    for (double rate : {6.17e-4, 6.17e-3, 6.17e-2}) {
      next_experiment_t next{};
      next.design = coupon.name();
      next.test = 0;
      next.conditions.strain_rate_per_s = rate;
      next.conditions.thickness_mm = 3.2;
      next.replicates = 2;
      diagnosis.next_experiments.push_back(next);
    }
    return diagnosis;
  });
  std::vector<wire::TestOrder> separating;
  for (const auto& order : game.said<wire::TestOrder>("TEST_ORDER")) {
    if (order.reason == "discrimination" && order.round == 2) separating.push_back(order);
  }
  ASSERT_THAT(separating, SizeIs(2)) << "discrimination_orders of the scenario";
  EXPECT_EQ(separating[0].design, coupon);
  EXPECT_EQ(separating[1].conditions.strain_rate_per_s, 6.17e-3);
  EXPECT_EQ(separating[1].replicates, 2);
}

TEST(Diagnosis, RoundOneOrdersRotatedTwins) {
  const auto game = played(small_scenario(), {});
  int twins = 0;
  for (const auto& order : game.said<wire::TestOrder>("TEST_ORDER")) {
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
  for (const auto& order : game.said<wire::TestOrder>("TEST_ORDER")) EXPECT_NE(order.reason, "discrimination");
}

}  // namespace
}  // namespace nacre::game_test
