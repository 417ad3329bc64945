#include "tester/relaxation.hpp"

#include "material/extended_law.hpp"
#include "tester/assembly.hpp"
#include "tester/usable.hpp"
#include "thesis/constants.hpp"

namespace nacre::tester {

Result<double> relaxation_modulus(const Simulation& simulation, double time_s) {
  if (std::string fault = simulation_fault(simulation, TestKind::modulus); !fault.empty())
    return fail("relaxation tester: {}", fault);
  const pattern::Mixture* mixture = simulation.design.mixture();
  if (mixture == nullptr || !(time_s > 0.0))
    return fail("relaxation tester: {} after {} s, expected a homogeneous material and a time above 0",
                simulation.design.name(), time_s);
  const material::Extensions& extensions = simulation.parameters.extensions;
  const material::Constants constants =
      held_coupon_constants(simulation.parameters.modulus, *mixture, extensions, simulation.conditions, time_s);
  const material::Lame lame = material::lame_from_engineering(constants.young_pa, constants.poisson);
  // Stiff as in the modulus tester, whose strain is as small.
  return material::uniaxial_stress(thesis::kModulusStrain, lame).nominal_stress_pa / thesis::kModulusStrain *
         material::held_stiffening(material::law_extensions(extensions), time_s);
}

}  // namespace nacre::tester
