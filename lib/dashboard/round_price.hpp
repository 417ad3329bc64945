#pragma once
// What the round at hand asks of a laboratory: specimens, trays, hours, resin. For the page and the command line.

#include <optional>
#include <string>

#include "fabricate/price.hpp"
#include "game/design_states.hpp"
#include "game/scenario.hpp"

namespace nacre::dashboard {

struct RoundPrice;
/// "round 1: 32 specimens on 4 trays, ...; 24 specimens to be printed yet; the budget allows ...".
std::string in_words(const RoundPrice& price);

struct RoundPrice {
  static constexpr std::string_view kPageName = "RoundPrice";
  int round = 0;
  bool is_expected = false;  ///< its designs are not proposed yet
  fabricate::Price all;      ///< every specimen of the round, as if all designs that wait were approved
  fabricate::Price left;     ///< of them those that nobody has printed or measured
  std::string budget;        ///< what a budget has taken from the round, as a sentence; empty: nothing

  static void fields(auto& field, auto& m) {
    field("round", m.round);
    field("is_expected", m.is_expected);
    field("all", m.all);
    field("left", m.left);
    field("budget", m.budget);
    field("sentence", in_words(m));
  }
};

/// Of an order's specimens that are to be printed.
fabricate::WantedSpecimens wanted(const game::Order& order, int replicates);

/// Rates and tray of the scenario.
fabricate::Rates rates_of(const game::Scenario& scenario);
fabricate::Printer printer_of(const game::Scenario& scenario);

/// `round`: the one that is measured, or will be next: from 1. Before its designs are proposed, what it is expected to
/// be by the scenario.
RoundPrice price_of_round(const game::Scenario& scenario, const game::LaboratoryFacts& facts, int round);

}  // namespace nacre::dashboard
