#pragma once
// The derivatives of a modulus at the cost of one solution. In equilibrium the elastic energy does not change to first
// order with the displacements (Hellmann-Feynman); so the energy of other constants on the same displacements gives E
// with an error of second order in their change. A derivative by differences needs no further solution.

#include <vector>

#include "tester/simulation.hpp"

namespace nacre::tester {

class ModulusProbe {
 public:
  /// Solves for a layout (Error: what made the solution impossible; a homogeneous design).
  static Result<ModulusProbe> at(const Simulation& simulation);
  /// The same solution as that of another simulation with the same elastic_key().
  ModulusProbe of(const Simulation& simulation) const;
  /// E of test_modulus() at these parameters, Pa.
  double modulus_pa() const { return modulus_pa_; }
  /// The same but for rate_factor().
  double relaxed_pa() const { return relaxed_pa_; }
  /// E of the same specimen with other parameters, exact to first order in their change, never too small to second
  /// order. The parameters must be usable (material::parameter_fault empty). Cost: the constants of
  /// a unit's elements.
  double nearby(const material::ParameterSet& parameters) const;

 private:
  double energy(const material::ParameterSet& parameters) const;

  Simulation simulation_;
  double relaxed_pa_ = 0.0;  ///< E but for rate_factor()
  double modulus_pa_ = 0.0, energy_ = 0.0;
  std::vector<double> shear_, bulk_;  ///< energy of each place in the units per Pa of mu and of lambda
};

}  // namespace nacre::tester
