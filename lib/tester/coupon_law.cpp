#include "tester/coupon_law.hpp"

#include "material/mixture.hpp"
#include "tester/assembly.hpp"
#include "tester/usable.hpp"

namespace nacre::tester {
namespace {

/// From the first reading to a path of a few hundred percent of strain.
material::TimeSpan span_of(double strain_rate_per_s, double pauses_s) {
  constexpr double kFirstStrain = 1e-6, kLongestPath = 4.0;
  return {kFirstStrain / strain_rate_per_s, kLongestPath / strain_rate_per_s + pauses_s};
}

}  // namespace

Result<CouponLaw> coupon_law(const Simulation& simulation, double pauses_s) {
  if (std::string fault = simulation_fault(simulation, TestKind::tensile); !fault.empty())
    return fail("tensile tester: {}", fault);
  const pattern::Mixture* mixture = simulation.design.mixture();
  if (mixture == nullptr)
    return fail(
        "tensile tester: {} is not homogeneous; only soft, interface, rigid and mix: are pulled as unnotched coupons",
        simulation.design.name());
  const material::ModulusParameters& modulus = simulation.parameters.modulus;
  // Laws that its memory follows are none of its stiffness.
  material::Extensions others = simulation.parameters.extensions;
  for (const char* remembered : {"rate_power_law", "rate_by_phase", "rate_prony"}) others.erase(remembered);
  const material::Constants constants = elastic_coupon_constants(modulus, *mixture, others, simulation.conditions);
  const material::Lame lame = material::lame_from_engineering(constants.young_pa, constants.poisson);
  CouponLaw coupon{.law = {.lame = lame},
                   .relaxation = relaxation_function(material::phases_of(modulus), simulation.parameters.extensions,
                                                     mixture->rigid_fraction,
                                                     span_of(simulation.conditions.strain_rate_per_s, pauses_s))};
  material::LawExtensions extensions = material::law_extensions(simulation.parameters.extensions);
  extensions.shrinkage = 0.0;  // it shrinks freely, and is measured afterwards
  if (!extensions.any()) return coupon;
  const double threshold =
      material::mixture(material::phases_of(simulation.parameters.toughness), mixture->rigid_fraction)
          .threshold_j_per_m3;
  coupon.law = material::extended_law(extensions, lame, threshold, mixture->rigid_fraction);
  return coupon;
}

}  // namespace nacre::tester
