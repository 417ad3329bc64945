#pragma once

#include "material/parameters.hpp"

namespace nacre::sysid {

/// A model that a calibration evaluated by fracture tests of all its designs: it broke this specimen of each.
struct EvaluatedModel {
  material::ParameterSet parameters;
  int specimen = 0;
  bool operator==(const EvaluatedModel&) const = default;
};

}  // namespace nacre::sysid
