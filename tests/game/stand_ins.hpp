#pragma once
// Stand-ins for tests of the game's logic: a closed-form tester instead of the simulations, a laboratory with another
// truth and noise, an analyser that sends the diagnosis of the test.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "game/scenario.hpp"
#include "in_process_game.hpp"
#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::game_test {

/// A mixture rule with the testers' parameters: smooth in all of them, quick, and different for different patterns.
/// droplet_mixing p stiffens half of all designs by a factor e^p and softens the others by as much, which no constants
/// of the materials imitate. Fails on designs that `fails` names.
wire::SimulatedDesign closed_form(const tester::Simulation& simulation, bool modulus, bool toughness, int curve_points);

/// Work function of kind "simulate" by closed_form(); `failing` designs (by name) have no number.
std::map<std::string, runtime::WorkFunction> closed_form_work(std::set<std::string> failing = {});

/// What a stand-in laboratory does.
struct LaboratorySettings {
  double modulus_factor = 0.8;    ///< hidden truth: factor on the moduli of the default parameters
  double toughness_factor = 0.6;  ///< and on the failure thresholds
  double modulus_noise = 0.02;    ///< relative, per specimen
  double toughness_noise = 0.10;
  material::Extensions hidden;                    ///< effects that the laboratory has and the base model has not
  std::function<void(wire::Measurement&)> spoil;  ///< changes a measurement before it is sent
  bool real_testers = false;                      ///< the testers instead of closed_form()
};

/// Node "virtual_lab": TEST_ORDER in, one MEASUREMENT per replicate out.
std::unique_ptr<runtime::NodeCore> make_laboratory(const LaboratorySettings& settings = {});

/// The replicates that the laboratory would report for an order.
std::vector<wire::Measurement> measure(const wire::TestOrder& order, const LaboratorySettings& settings);

/// Node "analyser": DIAGNOSE in, `diagnosis` out with the round of the request; by default "base_sufficient".
std::unique_ptr<runtime::NodeCore> make_analyser(std::function<wire::Diagnosis(int round)> diagnosis = {});

/// A scenario small enough for hundreds of games: 20 samples, 2 designs a round.
game::Scenario small_scenario();

/// Six rounds of it in which nothing is fitted: its model stays.
game::Scenario unfitted_scenario();

/// The three nodes under test and the two stand-ins, with the closed-form tester.
void add_players(InProcessGame& game, const game::Scenario& scenario, const LaboratorySettings& laboratory = {},
                 std::function<wire::Diagnosis(int)> diagnosis = {}, std::set<std::string> failing = {});

}  // namespace nacre::game_test
