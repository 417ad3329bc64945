#pragma once
// A game that a person measures for: nothing measures what is ordered by itself.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "in_process_game.hpp"
#include "stand_ins.hpp"

namespace nacre::game_test {

class PersonGame : public testing::Test {
 protected:
  PersonGame() {
    scenario_.rounds = 1;
    scenario_.laboratory.virtual_lab = false;
  }
  void begin() { begin(game_); }
  void begin(InProcessGame& game) const {
    add_players(game, scenario_);
    game.announce(scenario_);
    game.play();
  }
  void report(const wire::Measurement& measured) {
    game_.publish("MEASUREMENT", measured);
    game_.play();
  }
  std::vector<wire::Measurement> all_measurements() const {
    std::vector<wire::Measurement> all;
    for (const auto& order : game_.sent<wire::TestOrder>("TEST_ORDER")) {
      for (auto& measured : measure(order, {})) all.push_back(std::move(measured));
    }
    return all;
  }
  std::size_t rounds() const { return game_.payloads("ROUND").size(); }
  wire::RoundSummary last_round() const { return game_.sent<wire::RoundSummary>("ROUND").back(); }

  game::Scenario scenario_ = small_scenario();
  InProcessGame game_;
};

}  // namespace nacre::game_test
