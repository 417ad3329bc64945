#include "tester/modulus.hpp"

#include "fem/static_solver.hpp"
#include "material/extended_law.hpp"
#include "tester/assembly.hpp"
#include "tester/fidelity.hpp"
#include "tester/modulus_explicit.hpp"
#include "tester/usable.hpp"
#include "thesis/constants.hpp"

namespace nacre::tester {
namespace {

double homogeneous_modulus(const pattern::Mixture& mixture, const Simulation& simulation) {
  const material::Constants constants = elastic_coupon_constants(
      simulation.parameters.modulus, mixture, simulation.parameters.extensions, simulation.conditions);
  const material::Lame lame = material::lame_from_engineering(constants.young_pa, constants.poisson);
  return material::uniaxial_stress(thesis::kModulusStrain, lame).nominal_stress_pa / thesis::kModulusStrain;
}

}  // namespace

double rate_factor(const Simulation& simulation) {
  return material::rate_stiffening(material::law_extensions(simulation.parameters.extensions),
                                   simulation.conditions.strain_rate_per_s);
}

Result<ModulusResult> test_modulus(const Simulation& simulation, const Discretisation& discretisation) {
  if (std::string fault = simulation_fault(simulation, TestKind::modulus); !fault.empty())
    return fail("modulus tester: {}", fault);
  const bool homogeneous = simulation.design.mixture() != nullptr;
  const double at_rate = rate_factor(simulation);
  if (homogeneous && !discretisation.explicit_modulus)
    return ModulusResult{homogeneous_modulus(*simulation.design.mixture(), simulation) * at_rate};

  const SpecimenUnits units = modulus_units(simulation.fidelity);
  const fem::Grid grid =
      assemble(simulation.design, simulation.parameters, simulation.conditions, AssemblyTarget::modulus, units.x,
               units.y, refinement_of(simulation.fidelity) * discretisation.refinement);
  if (discretisation.explicit_modulus)
    return explicit_modulus(grid, simulation.parameters.modulus.gamma_per_s).transform([&](double modulus_pa) {
      return ModulusResult{modulus_pa * at_rate};
    });
  const Result<fem::StaticSolution> solution = fem::pull(grid, thesis::kModulusStrain);
  if (!solution) return fail("modulus tester: {}", solution.error().message);
  return ModulusResult{solution->top_stress_pa / thesis::kModulusStrain * at_rate};
}

}  // namespace nacre::tester
