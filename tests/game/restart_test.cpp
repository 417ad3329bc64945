// How long a killed node takes to come back: it folds its whole journal
// (docs/decisions/0006-restarts-fold-the-whole-journal.md).

#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

#include "../instrumented.hpp"
#include "in_process_game.hpp"
#include "proposal_agent/proposal_core.hpp"
#include "runtime/replay.hpp"
#include "simulator_farm/farm_core.hpp"
#include "stand_ins.hpp"
#include "validation_agent/family_work.hpp"
#include "validation_agent/validation_core.hpp"

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

// A power cut took the validation agent's journal: the others offer what they said of all rounds before it has come
// back to any of them, and nobody says it twice.
TEST(Restart, AValidationAgentWithoutItsJournalComesBackToTheSameGame) {
  const game::Scenario scenario = small_scenario();
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
    for (const auto& round : game.said<wire::RoundSummary>("ROUND")) of_rounds.push_back(round.calibration_count);
    return of_rounds;
  };
  EXPECT_EQ(counts(again), counts(whole));
  EXPECT_EQ(again.payloads("PARAMETERS"), whole.payloads("PARAMETERS"));
  EXPECT_EQ(again.payloads("ROUND"), whole.payloads("ROUND"));
}

}  // namespace
}  // namespace nacre::game_test
