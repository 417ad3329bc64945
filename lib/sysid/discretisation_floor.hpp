#pragma once
// Discretisation floor of the testers: the difference between two discretisations of one truth, and so between any
// laboratory and the testers, besides scatter and missing physics (data/discretisation_floor.toml,
// docs/studies/discretisation-floor.md).

#include <filesystem>

#include "material/parameters.hpp"
#include "tester/names.hpp"
#include "tester/simulation.hpp"

namespace nacre::sysid {

/// Standard deviations of natural logarithms, per design (after the parameters have absorbed what they can) and common
/// to all designs. `trend`: growing along the rigid fraction.
struct DiscretisationFloor {
  double log_modulus_sd = 0.006, log_toughness_sd = 0.22, log_peak_sd = 0.10;
  double log_modulus_common_sd = 0.06, log_toughness_common_sd = 0.27, log_peak_common_sd = 0.10;
  double log_modulus_trend_sd = 0.024;  ///< over the designs: thin soft joints are computed softer than thick ones
  double log_toughness_trend_sd = 0.05, log_peak_trend_sd = 0.07;  ///< per 0.1 of rigid fraction
  /// Of eta's parameters: another mesh needs other values to break in the same way, beyond what the above say.
  material::ToughnessVector log_eta_sd = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1.7};
  /// No floor at all: residuals are scatter or physics.
  static DiscretisationFloor none();
};

/// From data/discretisation_floor.toml, the table of this fidelity; a key that is missing keeps its default. Throws
/// InputError.
DiscretisationFloor read_discretisation_floor(const std::filesystem::path& file, tester::Fidelity fidelity);

}  // namespace nacre::sysid
