#pragma once
// One parameter set that a calibration wants simulated.

#include <string>
#include <vector>

#include "material/parameters.hpp"

namespace nacre::sysid {

/// The tests named, of all `items`, with these parameters.
struct WantedEvaluation {
  std::string id;  ///< unique within the calibration
  material::ParameterSet parameters;
  bool modulus = false;
  bool toughness = false;
  std::vector<std::size_t> items;  ///< indices into the measured designs
};

}  // namespace nacre::sysid
