#include <cmath>

#include "material/neo_hookean.hpp"
#include "tester/assembly.hpp"
#include "tester/tester.hpp"
#include "tester/usable.hpp"

namespace nacre::tester {

Result<Curve> test_tensile(const Simulation& simulation, const std::vector<double>& strain_history) {
  if (std::string fault = simulation_fault(simulation, TestKind::tensile); !fault.empty())
    return fail("tensile tester: {}", fault);
  const pattern::Mixture* mixture = simulation.design.mixture();
  if (mixture == nullptr)
    return fail(
        "tensile tester: {} is not homogeneous; only soft, interface, rigid and mix: are pulled as unnotched coupons",
        simulation.design.name());
  const material::Constants constants =
      coupon_constants(material::phases_of(simulation.parameters.modulus), *mixture, simulation.parameters.extensions,
                       simulation.conditions);
  const material::Lame lame = material::lame_from_engineering(constants.young_pa, constants.poisson);
  Curve curve;
  for (std::size_t i = 0; i < strain_history.size(); ++i) {
    const double strain = strain_history[i];
    if (!(std::isfinite(strain) && strain > -1.0))
      return fail("tensile tester: strain {} at sample {}, expected a number above -1", strain, i);
    curve.strain.push_back(strain);
    curve.stress_pa.push_back(material::uniaxial_stress(strain, lame).nominal_stress_pa);
  }
  return curve;
}

}  // namespace nacre::tester
