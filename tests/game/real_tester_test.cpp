// One whole game on the real testers: tiny specimens, few samples, a laboratory that is a tester with other parameters.

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "in_process_game.hpp"
#include "proposal_agent/proposal_core.hpp"
#include "proposal_agent/selection_work.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "stand_ins.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::game_test {
namespace {

TEST(RealTesters, PlayAWholeGame) {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 1;
  scenario.proposal.samples = 10;
  scenario.proposal.seeds = 1;
  scenario.proposal.population = 5;
  scenario.proposal.designs = 1;
  scenario.validation.random_patterns = 2;
  scenario.validation.replicates = 2;
  scenario.validation.calibration_evaluations = 4;
  scenario.validation.modulus_evaluations = 14;
  scenario.validation.mixtures = {};
  const auto folder = std::filesystem::path(testing::TempDir()) / "nacre_real_tester_game";
  std::filesystem::remove_all(folder);
  auto cache = std::make_shared<store::SimulationCache>(folder / "simulations.db");
  LaboratorySettings laboratory;
  laboratory.real_testers = true;
  InProcessGame game;
  game.add("simulator_farm", simulator_farm::make_core(scenario),
           simulator_farm::work_functions(cache, folder / "films"));
  game.add("proposal_agent", proposal_agent::make_core(scenario), proposal_agent::work_functions());
  game.add("validation_agent", validation_agent::make_core(scenario));
  game.add("virtual_lab", make_laboratory(laboratory));
  game.add("analyser", make_analyser());
  game.announce(scenario);
  game.play();
  const auto rounds = game.sent<wire::RoundSummary>("ROUND");
  ASSERT_EQ(rounds.size(), 2u);
  EXPECT_TRUE(rounds.back().last);
  EXPECT_EQ(rounds.back().calibration_count, 3);
  // Round 0 fits the modulus tester to the base materials within a percent (thesis Table 3.4).
  EXPECT_LT(rounds.front().after.modulus_max, 0.01);
  EXPECT_LT(rounds.back().after.modulus_mean, rounds.back().before.modulus_mean);
  EXPECT_LE(rounds.back().after.toughness_mean, rounds.back().before.toughness_mean);
  std::size_t simulations = 0;
  for (const std::string& id : game.work_of("simulator_farm")) simulations += id.find('/') == std::string::npos;
  EXPECT_EQ(static_cast<std::size_t>(cache->size()), simulations) << "each test was simulated once";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace nacre::game_test
