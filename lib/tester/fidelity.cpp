#include "tester/fidelity.hpp"

#include "thesis/constants.hpp"

namespace nacre::tester {

SpecimenUnits toughness_units(Fidelity fidelity) {
  switch (fidelity) {
    case Fidelity::tiny:
      return {1, 1};
    case Fidelity::preview:
      return {3, 2};
    case Fidelity::full:
      break;
  }
  return {thesis::kToughnessUnitsX, thesis::kToughnessUnitsY};
}

SpecimenUnits modulus_units(Fidelity fidelity) {
  if (fidelity == Fidelity::tiny) return {1, 1};
  return {thesis::kModulusUnitsX, thesis::kModulusUnitsY};
}

}  // namespace nacre::tester
