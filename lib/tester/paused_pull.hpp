#pragma once
// A coupon that is pulled, held, unloaded to zero force and left: what pauses show, which a curve does not tell.

#include <optional>
#include <vector>

#include "base/result.hpp"
#include "tester/loading.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// Read at the pauses of a programme.
struct PausedPull {
  double turn_stress_pa = 0.0;                ///< where the first strain is reached
  std::optional<double> held_stress_pa = {};  ///< at the end of the hold there
  std::optional<double> set_strain = {};      ///< at zero force
  std::optional<double> dwelled_strain = {};  ///< at zero force after the dwell
};

/// Nominal strains are reached at the strain rate of the conditions, which unloads to zero force too. Laws act as in
/// test_tensile(): flow stays, a Maxwell branch recovers. Error: as there.
Result<PausedPull> pull_with_pauses(const Simulation& simulation, const Loading& loading);

}  // namespace nacre::tester
