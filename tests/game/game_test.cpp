// Whole games of the three cores, played in one process.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "../instrumented.hpp"
#include "base/files.hpp"
#include "explore/search.hpp"
#include "in_process_game.hpp"
#include "material/parameter_file.hpp"
#include "optimize/pareto.hpp"
#include "proposal_agent/proposal_core.hpp"
#include "simulator_farm/farm_core.hpp"
#include "stand_ins.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::game_test {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

void play_whole(InProcessGame& game, const game::Scenario& scenario) {
  game.announce(scenario);
  game.play();
}

TEST(Game, TwoRoundsTakeTheCourseOfTheRules) {
  const game::Scenario scenario = small_scenario();
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);

  const auto models = game.sent<wire::AdoptedModel>("PARAMETERS");
  const auto proposals = game.sent<wire::Proposal>("PROPOSAL");
  const auto rounds = game.sent<wire::RoundSummary>("ROUND");
  ASSERT_THAT(models, SizeIs(3));
  ASSERT_THAT(proposals, SizeIs(3));
  ASSERT_THAT(rounds, SizeIs(3));
  for (int round = 0; round < 3; ++round) {
    const auto at = static_cast<std::size_t>(round);
    EXPECT_EQ(models[at].round, round);
    EXPECT_EQ(proposals[at].round, round);
    EXPECT_THAT(proposals[at].designs, SizeIs(3));
    EXPECT_EQ(rounds[at].round, round);
    EXPECT_EQ(rounds[at].last, round == 2);
  }
  // N(n): 4 random patterns and 3 proposals in round 1, 3 more in round 2; the proposals are out-of-sample.
  EXPECT_EQ(rounds[1].calibration_count, 7);
  EXPECT_EQ(rounds[2].calibration_count, 10);
  EXPECT_EQ(rounds[1].held_out.modulus_count, 3);
  EXPECT_EQ(rounds[2].held_out.toughness_count, 3);
  for (const char* node : {"validation_agent", "proposal_agent", "simulator_farm"}) {
    EXPECT_TRUE(game.status_of(node).finished) << node;
    EXPECT_THAT(game.complaints_of(node), IsEmpty()) << node;
  }
}

TEST(Game, CalibrationBringsTheModelNearerToTheLaboratory) {
  const game::Scenario scenario = small_scenario();
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  const auto rounds = game.sent<wire::RoundSummary>("ROUND");
  ASSERT_THAT(rounds, SizeIs(3));
  EXPECT_LT(rounds[1].after.modulus_mean, 0.5 * rounds[1].before.modulus_mean);
  EXPECT_LT(rounds[1].after.toughness_mean, rounds[1].before.toughness_mean);
  EXPECT_LT(rounds[2].held_out.modulus_mean, rounds[1].held_out.modulus_mean);
}

/// A scenario whose game begins with constants of its own and an extension.
game::Scenario beginning_with_a_model(material::ParameterSet& model) {
  model = material::default_parameters();
  model.modulus.e_if_pa = 7e8;
  model.toughness.w_if_j_per_m3 = 2.5e6;
  model.extensions["droplet_mixing"] = {0.4};
  game::Scenario scenario = small_scenario();
  scenario.model_file = testing::TempDir() + "model_of_an_earlier_game.toml";
  write_file_atomically(scenario.model_file, material::to_toml(model));
  return scenario;
}

TEST(Game, BeginsWithTheModelOfAnEarlierOne) {
  material::ParameterSet model;
  game::Scenario scenario = beginning_with_a_model(model);
  scenario.base_materials_file.clear();
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  const auto models = game.sent<wire::AdoptedModel>("PARAMETERS");
  ASSERT_THAT(models, SizeIs(3));
  EXPECT_EQ(models[0].parameters, model);
  EXPECT_EQ(models[0].provenance.search, "begun_with");
  EXPECT_EQ(models[2].parameters.extensions, model.extensions);
  EXPECT_NE(models[2].parameters.modulus, model.modulus);
}

TEST(Game, BaseMaterialsAreFittedFromTheModelThatItBeginsWith) {
  material::ParameterSet model;
  const game::Scenario scenario = beginning_with_a_model(model);
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  const auto models = game.sent<wire::AdoptedModel>("PARAMETERS");
  ASSERT_THAT(models, SizeIs(3));
  EXPECT_EQ(models[0].parameters.extensions, model.extensions);
  EXPECT_NE(models[0].parameters.modulus, model.modulus);
  EXPECT_EQ(models[0].provenance.search, "base_materials");
}

TEST(Game, EveryTestRequestIsComputedOnce) {
  const game::Scenario scenario = small_scenario();
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  std::set<std::string> simulated;
  for (const std::string& id : game.work_of("simulator_farm")) {
    if (id.ends_with("/curve")) continue;
    EXPECT_TRUE(simulated.insert(id).second) << id;
  }
  EXPECT_GT(simulated.size(), 300u);
}

TEST(Game, LateShuffledAndRepeatedDeliveryIsTheSameGame) {
  const game::Scenario scenario = small_scenario();
  InProcessGame undisturbed;
  add_players(undisturbed, scenario);
  play_whole(undisturbed, scenario);
  ASSERT_THAT(undisturbed.sent<wire::RoundSummary>("ROUND"), SizeIs(3));
  for (std::uint64_t seed : {1, 2, 3}) {
    InProcessGame disturbed({.seed = seed, .repeat_probability = 0.3});
    add_players(disturbed, scenario);
    play_whole(disturbed, scenario);
    EXPECT_EQ(disturbed.essence(), undisturbed.essence()) << "delivery seed " << seed;
  }
}

TEST(Game, AFreshCoreRepeatsItsJournalWordForWord) {
  const game::Scenario scenario = small_scenario();
  InProcessGame game({.seed = 5, .repeat_probability = 0.2});
  add_players(game, scenario);
  play_whole(game, scenario);
  EXPECT_GT(game.replay("validation_agent", *validation_agent::make_core(scenario)), 50u);
  EXPECT_GT(game.replay("proposal_agent", *proposal_agent::make_core(scenario)), 10u);
  EXPECT_GT(game.replay("simulator_farm", *simulator_farm::make_core(scenario)), 300u);
}

TEST(Game, NoStepTakesLongerThanATenthOfASecond) {
  // As many designs and evaluations as the demonstration has.
  game::Scenario scenario = small_scenario();
  scenario.proposal.samples = 300;
  scenario.proposal.population = 20;
  scenario.proposal.designs = 4;
  scenario.validation.random_patterns = 6;
  scenario.validation.calibration_evaluations = 25;
  scenario.validation.modulus_evaluations = 120;
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  EXPECT_EQ(game.payloads("ROUND").size(), 3u);
  EXPECT_LT(game.longest_step_s(), 0.1 * test::kPatience);
  RecordProperty("longest_step_us", static_cast<int>(1e6 * game.longest_step_s()));
}

TEST(Game, DesignsAreNotProposedTwice) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 4;
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  std::set<std::string> proposed;
  for (const auto& proposal : game.sent<wire::Proposal>("PROPOSAL")) {
    for (const auto& design : proposal.designs) EXPECT_TRUE(proposed.insert(design.design.name()).second);
  }
  EXPECT_THAT(proposed, SizeIs(15));
}

TEST(Game, BenchmarkOfTheSelectionComesFromTheMeasuredMixtures) {
  const game::Scenario scenario = small_scenario();
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  const auto models = game.sent<wire::AdoptedModel>("PARAMETERS");
  ASSERT_THAT(models, SizeIs(3));
  EXPECT_THAT(models[0].benchmark, IsEmpty());
  ASSERT_THAT(models[1].benchmark, SizeIs(4)) << "soft, interface, mix:0.75, rigid";
  EXPECT_TRUE(std::is_sorted(models[1].benchmark.begin(), models[1].benchmark.end(),
                             [](const auto& a, const auto& b) { return a.modulus_pa < b.modulus_pa; }));
}

TEST(Game, EndsAtEquilibriumBeforeTheLimit) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 12;
  scenario.stop_at_equilibrium = true;
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  const auto rounds = game.sent<wire::RoundSummary>("ROUND");
  ASSERT_FALSE(rounds.empty());
  EXPECT_TRUE(rounds.back().last);
  EXPECT_TRUE(rounds.back().equilibrium) << rounds.back().decided_by;
  EXPECT_GE(rounds.back().round, 3);
  EXPECT_LT(rounds.back().round, scenario.rounds);
  EXPECT_THAT(rounds.back().decided_by, HasSubstr("round " + std::to_string(rounds.back().round)));
}

TEST(Game, WithAModelThatStaysEachRoundSaysWhatIsNewInItsGamut) {
  const game::Scenario scenario = unfitted_scenario();
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, scenario);
  const auto rounds = game.sent<wire::RoundSummary>("ROUND");
  ASSERT_THAT(rounds, SizeIs(static_cast<std::size_t>(scenario.rounds) + 1));
  wire::GamutCollector gamuts;
  std::vector<std::size_t> said(rounds.size()), whole(rounds.size());
  for (const auto& chunk : game.sent<wire::GamutChunk>("GAMUT")) {
    EXPECT_EQ(chunk.base, chunk.round - 1);
    said.at(static_cast<std::size_t>(chunk.round)) += chunk.samples.size();
    gamuts.add(chunk);
    ASSERT_NE(gamuts.whole(chunk.round), nullptr);
    const std::vector<explore::Evaluated>& gamut = *gamuts.whole(chunk.round);
    whole.at(static_cast<std::size_t>(chunk.round)) = gamut.size();
    EXPECT_EQ(std::ssize(gamut), chunk.total);
    EXPECT_EQ(rounds.at(static_cast<std::size_t>(chunk.round)).gamut_hypervolume_staircase,
              optimize::hypervolume_staircase_gpa_mpa(explore::performances_of(gamut)));
  }
  EXPECT_GT(whole.back(), 4 * whole.front());
  for (std::size_t round = 1; round < said.size(); ++round) EXPECT_LT(said[round], 2 * whole.front()) << round;
}

TEST(Game, FailedSimulationsDoNotStopIt) {
  const game::Scenario scenario = small_scenario();
  InProcessGame sound;
  add_players(sound, scenario);
  play_whole(sound, scenario);
  // Everything that was proposed for round 1, and one of the random patterns, cannot be simulated.
  std::set<std::string> failing;
  const wire::Proposal first = sound.sent<wire::Proposal>("PROPOSAL").front();
  for (const auto& design : first.designs) failing.insert(design.design.name());
  for (const auto& order : sound.sent<wire::TestOrder>("TEST_ORDER")) {
    if (order.reason == "random" && failing.size() < 4) failing.insert(order.design.name());
  }
  InProcessGame game;
  add_players(game, scenario, {}, {}, failing);
  play_whole(game, scenario);
  const auto rounds = game.sent<wire::RoundSummary>("ROUND");
  ASSERT_THAT(rounds, SizeIs(3));
  EXPECT_TRUE(rounds.back().last);
  const wire::Proposal second = game.sent<wire::Proposal>("PROPOSAL").front();
  for (const auto& design : second.designs) {
    EXPECT_FALSE(failing.contains(design.design.name()));
  }
}

TEST(Game, AnUnnoticedRunOfAnotherSeedIsRefused) {
  const game::Scenario scenario = small_scenario();
  game::Scenario other = scenario;
  other.seed = 99;
  InProcessGame game;
  add_players(game, scenario);
  play_whole(game, other);
  EXPECT_THAT(game.payloads("PARAMETERS"), IsEmpty());
  EXPECT_THAT(game.complaints_of("validation_agent"), SizeIs(1));
  play_whole(game, scenario);
  EXPECT_THAT(game.payloads("ROUND"), SizeIs(3));
}

}  // namespace
}  // namespace nacre::game_test
