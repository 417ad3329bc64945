#pragma once
// What a laboratory's budget leaves of the rounds that a scenario describes.

#include <string>
#include <vector>

#include "game/rounds.hpp"
#include "game/scenario.hpp"

namespace nacre::game {

/// Replicates are given up first, but three of them are kept: as many consistent specimens make a measured value
/// (2.2.2), and of two that disagree nobody can tell which is wrong. Scenarios with fewer have no replicate to give.
inline constexpr int kFewestReplicates = 3;

/// The scenario with the numbers of specimens that `round` (from 1) may order. Where the budget is short, all rounds
/// have fewer replicates, down to kFewestReplicates; then the round gives up, one by one: discrimination tests,
/// mixtures (from the end of their list), random patterns, proposed designs. The selection then picks as many fewer,
/// the best of wider parts of the front. Base materials and one design are always measured. `budget.total` is levelled:
/// the largest limit of specimens per round with which all rounds fit. What persons add and families come on top.
/// Without a budget the scenario as it is. A pure function: proposal and validation agent agree without a message.
Scenario within_budget(const Scenario& scenario, int round);

/// "the budget allows 3 of 4 replicates, 5 of 8 designs and 0 of 10 random patterns in round 1"; empty: nothing is
/// given up.
std::string budget_in_words(const Scenario& scenario, int round);

/// Specimens of the smallest round that a budget must allow, and of all rounds together.
int least_specimens(const Scenario& scenario, int round);
int least_specimens_of_all(const Scenario& scenario);

/// All orders that `round` is expected to have before its proposal is known: patterns that are proposed or
/// discriminate stand for those to come.
std::vector<Order> expected_orders(const Scenario& scenario, int round);

}  // namespace nacre::game
