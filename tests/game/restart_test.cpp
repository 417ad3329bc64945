// How long a killed node takes to come back: it folds its whole journal
// (docs/decisions/0006-restarts-fold-the-whole-journal.md).

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../instrumented.hpp"
#include "in_process_game.hpp"
#include "proposal_agent/proposal_core.hpp"
#include "proposal_agent/selection_work.hpp"
#include "runtime/replay.hpp"
#include "simulator_farm/farm_core.hpp"
#include "stand_ins.hpp"
#include "validation_agent/family_work.hpp"
#include "validation_agent/validation_core.hpp"
#include "wire/channels.hpp"

namespace nacre::game_test {
namespace {

/// A game of the demonstration's size, five rounds long; simulations by the closed form, decisions by the real cores.
game::Scenario five_rounds() {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 5;
  scenario.stop_at_equilibrium = false;
  scenario.proposal.samples = 300;
  scenario.proposal.population = 20;
  scenario.proposal.designs = 4;
  scenario.validation.random_patterns = 6;
  scenario.validation.replicates = 3;
  scenario.validation.calibration_evaluations = 25;
  scenario.validation.modulus_evaluations = 120;
  return scenario;
}

TEST(Restart, FoldsTheJournalOfFiveRoundsInSeconds) {
  constexpr double kPatienceS = 5.0 * test::kPatience;  // a crashed node is missed after ten
  const game::Scenario scenario = five_rounds();
  InProcessGame game;
  add_players(game, scenario);
  game.announce(scenario);
  game.play();
  ASSERT_EQ(game.payloads("ROUND").size(), 6U);
  const auto expect_quick_restart = [&](const std::string& node, std::unique_ptr<runtime::NodeCore> fresh) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / (node + "_restart.lcm");
    std::filesystem::remove(file);
    const std::int64_t records = game.write_journal(node, file);
    const double begin_s = processor_time_s();
    const runtime::ReplayReport report = runtime::replay_journal(file, *fresh);
    const double taken_s = processor_time_s() - begin_s;
    EXPECT_TRUE(report.equal) << node << ": " << report.difference;
    EXPECT_LT(taken_s, kPatienceS) << node;
    std::printf("%s: %lld records, %.1f MB, folded in %.3f s, %.0f records/s\n", node.c_str(),
                static_cast<long long>(records), 1e-6 * static_cast<double>(std::filesystem::file_size(file)), taken_s,
                static_cast<double>(records) / taken_s);
    std::filesystem::remove(file);
  };
  expect_quick_restart("validation_agent", validation_agent::make_core(scenario));
  expect_quick_restart("proposal_agent", proposal_agent::make_core(scenario));
  expect_quick_restart("simulator_farm", simulator_farm::make_core(scenario));
}

// A power cut took the validation agent's journal: the others offer what they sent of all rounds before it has come
// back to any of them, and nobody sends it twice.
void expect_it_comes_back(const game::Scenario& scenario) {
  InProcessGame whole;
  add_players(whole, scenario);
  whole.announce(scenario);
  whole.play();
  InProcessGame again;
  again.add("simulator_farm", simulator_farm::make_core(scenario), closed_form_work());
  again.add("validation_agent", validation_agent::make_core(scenario), validation_agent::work_functions({}));
  again.announce(scenario);
  for (const char* channel : {"GAMUT", "PROPOSAL", "DIAGNOSIS", "MEASUREMENT"})
    for (const std::string& payload : whole.payloads(channel)) again.publish(runtime::Message{channel, payload});
  again.play();
  const auto counts = [](const InProcessGame& game) {
    std::vector<int> of_rounds;
    for (const auto& round : game.sent<wire::RoundSummary>("ROUND")) of_rounds.push_back(round.calibration_count);
    return of_rounds;
  };
  EXPECT_EQ(counts(again), counts(whole));
  EXPECT_EQ(again.payloads("PARAMETERS"), whole.payloads("PARAMETERS"));
  EXPECT_EQ(again.payloads("ROUND"), whole.payloads("ROUND"));
}

TEST(Restart, AValidationAgentWithoutItsJournalComesBackToTheSameGame) {
  expect_it_comes_back(small_scenario());
  expect_it_comes_back(unfitted_scenario());  // where each gamut is said as what it adds to the last
}

/// The proposal agent and the farm that it asks.
void add_proposal_agent(InProcessGame& game, const game::Scenario& scenario) {
  game.add("simulator_farm", simulator_farm::make_core(scenario), closed_form_work());
  game.add("proposal_agent", proposal_agent::make_core(scenario), proposal_agent::work_functions());
}

/// What the proposal agent asked the farm; its searches do not wait for each other, so there is no order.
std::set<std::string> asked_by_proposal_agent(const InProcessGame& game) {
  std::set<std::string> asked;
  for (const std::string& payload : game.payloads("SIMULATE"))
    if (wire::requester_of(wire::request_id_of("SIMULATE", payload)) == "proposal_agent") asked.insert(payload);
  return asked;
}

// Its journal lost, it is offered the models of all rounds, and over a network any of them may be the first to come. A
// round begins with what the one before has found: taken out of turn it would be another round.
TEST(Restart, AProposalAgentPlaysTheRoundsInTheirOrderInWhateverOrderTheModelsCome) {
  const game::Scenario scenario = small_scenario();
  InProcessGame whole;
  add_players(whole, scenario);
  whole.announce(scenario);
  whole.play();
  const std::vector<std::string> models = whole.payloads("PARAMETERS");
  ASSERT_EQ(models.size(), 3U);
  std::vector<std::size_t> order = {0, 1, 2};
  do {
    InProcessGame again;
    add_proposal_agent(again, scenario);
    for (const std::size_t round : order) again.publish(runtime::Message{"PARAMETERS", models[round]});
    again.play();
    const std::string came = testing::PrintToString(order);
    EXPECT_EQ(asked_by_proposal_agent(again), asked_by_proposal_agent(whole)) << came;
    EXPECT_EQ(again.payloads("GAMUT"), whole.payloads("GAMUT")) << came;
    EXPECT_EQ(again.payloads("PROPOSAL"), whole.payloads("PROPOSAL")) << came;
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Restart, AProposalAgentWaitsForTheModelOfTheRoundThatIsDue) {
  const game::Scenario scenario = small_scenario();
  const auto core = proposal_agent::make_core(scenario);
  const auto model_of = [&](int round) {
    wire::AdoptedModel model;
    model.round = round;
    model.fidelity = scenario.fidelity;
    model.parameters = material::default_parameters();
    return runtime::Message{"PARAMETERS", wire::write(model)};
  };
  EXPECT_TRUE(core->step(model_of(1)).messages.empty());
  EXPECT_EQ(core->status().phase, "waiting for a model");
  const runtime::Outputs begun = core->step(model_of(0));
  ASSERT_FALSE(begun.messages.empty());
  EXPECT_TRUE(wire::request_id_of("SIMULATE", begun.messages.front().payload).starts_with("proposal_agent/r0/"));
}

// Its journal lost, it comes to another model of the same round, and the farm still repeats its responses about the
// first.
TEST(Restart, AProposalAgentWithoutItsJournalTakesNoResponsesAboutAnotherModel) {
  const game::Scenario scenario = small_scenario();
  wire::AdoptedModel model;
  model.fidelity = scenario.fidelity;
  model.parameters = material::default_parameters();
  InProcessGame before;
  add_proposal_agent(before, scenario);
  before.publish("PARAMETERS", model);
  before.play();
  model.parameters.modulus.e_if_pa *= 1.1;
  model.parameters.toughness.w_if_j_per_m3 *= 0.5;
  InProcessGame undisturbed, disturbed;
  for (InProcessGame* game : {&undisturbed, &disturbed}) {
    add_proposal_agent(*game, scenario);
    game->publish("PARAMETERS", model);
  }
  for (const std::string& stale : before.payloads("SIMULATED")) disturbed.publish(runtime::Message{"SIMULATED", stale});
  undisturbed.play();
  disturbed.play();
  ASSERT_EQ(undisturbed.payloads("PROPOSAL").size(), 1U);
  EXPECT_NE(undisturbed.payloads("GAMUT"), before.payloads("GAMUT")) << "the models differ enough";
  EXPECT_EQ(asked_by_proposal_agent(disturbed), asked_by_proposal_agent(undisturbed));
  EXPECT_EQ(disturbed.payloads("GAMUT"), undisturbed.payloads("GAMUT"));
  EXPECT_EQ(disturbed.payloads("PROPOSAL"), undisturbed.payloads("PROPOSAL"));
}

}  // namespace
}  // namespace nacre::game_test
