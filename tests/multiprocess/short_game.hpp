#pragma once

#include <string>

namespace nacre {

/// A scenario of a few seconds against the virtual laboratory; more tables may follow.
inline std::string short_game(const std::string& name, int rounds) {
  return "name = \"" + name + "\"\nseed = 1\nrounds = " + std::to_string(rounds) + R"(
fidelity = "tiny"

[proposal]
samples = 10
seeds = 1
population = 5
designs = 1
"redraws" = 1

[validation]
random_patterns = 2
replicates = 2
calibration_evaluations = 3
modulus_evaluations = 6
mixtures = [0.5]

[diagnosis]
discrimination_orders = 0
bootstraps = 1000
simulations = 0
)";
}

}  // namespace nacre
