#pragma once
// Parameters for elements of another size.

#include "material/parameters.hpp"

namespace nacre::tester {

/// The same material on elements of h / refinement: damping times refinement^2, since the filter of Eq. 2.4 acts as a
/// viscosity gamma h^2.
inline material::ParameterSet refined(material::ParameterSet parameters, int refinement) {
  parameters.toughness.gamma_per_s *= refinement * refinement;
  return parameters;
}

}  // namespace nacre::tester
