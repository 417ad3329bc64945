#include "tester/coupon_law.hpp"

#include "material/mixture.hpp"
#include "tester/assembly.hpp"
#include "tester/usable.hpp"

namespace nacre::tester {

Result<material::ExtendedLaw> coupon_law(const Simulation& simulation) {
  if (std::string fault = simulation_fault(simulation, TestKind::tensile); !fault.empty())
    return fail("tensile tester: {}", fault);
  const pattern::Mixture* mixture = simulation.design.mixture();
  if (mixture == nullptr)
    return fail(
        "tensile tester: {} is not homogeneous; only soft, interface, rigid and mix: are pulled as unnotched coupons",
        simulation.design.name());
  const material::Constants constants = elastic_coupon_constants(
      simulation.parameters.modulus, *mixture, simulation.parameters.extensions, simulation.conditions);
  const material::Lame lame = material::lame_from_engineering(constants.young_pa, constants.poisson);
  material::LawExtensions extensions = material::law_extensions(simulation.parameters.extensions);
  extensions.shrinkage = 0.0;  // it shrinks freely, and is measured afterwards
  if (!extensions.any()) return material::ExtendedLaw{.lame = lame};
  const double threshold =
      material::mixture(material::phases_of(simulation.parameters.toughness), mixture->rigid_fraction)
          .threshold_j_per_m3;
  return material::extended_law(extensions, lame, threshold, mixture->rigid_fraction);
}

}  // namespace nacre::tester
