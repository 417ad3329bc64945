#pragma once
// Simulated E, T and curve of one design.

#include <optional>

#include "tester/curve.hpp"

namespace nacre::sysid {

/// Result of the testers for one design; each part only where its test was requested and succeeded.
struct Prediction {
  std::optional<double> modulus_pa;
  std::optional<double> toughness_pa;  ///< mean over specimens
  double toughness_sd_pa = 0.0;        ///< scatter between them, over specimens - 1; 0 with one
  int specimens = 0;                   ///< that broke
  tester::Curve curve;
};

}  // namespace nacre::sysid
