#pragma once
// How far the result of a calibration can be trusted.

#include <string>
#include <string_view>
#include <vector>

#include "pattern/design.hpp"
#include "sysid/calibration.hpp"

namespace nacre::sysid {

/// A simulated fracture test that ended at its strain limit (thesis 2.3.1; pure soft specimens have none that counts):
/// its toughness is the area until there.
bool is_unbroken(const Prediction& prediction, const pattern::Design& design);

/// Where parameters come from and how far they can be trusted: published with them.
struct Provenance {
  std::string search;  ///< `base_materials`, `begun_with` (nothing was fitted), or how eta was searched
  double modulus_objective = 0.0, toughness_objective = 0.0;  ///< (2.8) of these parameters on their calibration set
  GoodnessOfFit modulus_fit, toughness_fit;
  std::vector<ParameterEstimate> estimates;
  bool operator==(const Provenance&) const = default;
};

Provenance provenance_of(const Calibrated& calibrated, std::string_view search);

/// The fitted parameters that are at a bound of their range, to a millionth of it in the coordinate of the fit, those
/// that the data determine first: the data would have them go further, and they may push the others aside. Elastic
/// moduli count as fitted where there are moduli, parameters of fracture where there is toughness.
std::vector<ParameterEstimate> at_an_end(const Calibrated& calibrated, const material::ParameterRanges& ranges,
                                         material::FitTarget target);

}  // namespace nacre::sysid
