#include "tester/fidelity.hpp"

#include "thesis/constants.hpp"

namespace nacre::tester {

SpecimenUnits toughness_units(Fidelity fidelity) {
  if (fidelity == Fidelity::tiny) return {1, 1};
  return {thesis::kToughnessUnitsX, thesis::kToughnessUnitsY};
}

double loading_rate_scale(Fidelity fidelity) { return fidelity == Fidelity::preview ? 2.0 : 1.0; }

int refinement_of(Fidelity fidelity) { return fidelity == Fidelity::fine ? 2 : 1; }

SpecimenUnits modulus_units(Fidelity fidelity) {
  if (fidelity == Fidelity::tiny) return {1, 1};
  return {thesis::kModulusUnitsX, thesis::kModulusUnitsY};
}

}  // namespace nacre::tester
