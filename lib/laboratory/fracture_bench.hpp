#pragma once

#include <cstdint>

#include "base/result.hpp"
#include "laboratory/specimen_raster.hpp"
#include "tester/curve.hpp"

namespace nacre::laboratory {

/// How the notched specimen is pulled.
struct Pull {
  double gamma_per_s = 0.0;  ///< damping constant of Eq. 2.4, taken as the viscosity that it amounts to
  double strain_rate_per_s = 20.0;
  double strain_limit = 0.3;  ///< 2 for pure soft material
  std::int64_t step_limit = 800'000;
};

/// What the machine would record of one specimen without noise.
struct PulledSpecimen {
  tester::Curve curve;     ///< nominal stress and strain, averages over windows of equal length
  bool separated = false;  ///< stress fell under 20 % of its peak; else the strain limit ended the test
  std::int64_t steps = 0;
  std::int64_t element_count = 0;
};

/// Explicit dynamics of the notched specimen until separation, single precision, one thread. Failure: element deletion
/// at the threshold energy density. Error: blow-up with step, row and column, or the step limit.
Result<PulledSpecimen> pull_to_separation(const Raster& raster, const Pull& pull);

}  // namespace nacre::laboratory
