#include "tester/usable.hpp"

#include <cmath>

#include "tester/strength_field.hpp"

namespace nacre::tester {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

std::string simulation_fault(const Simulation& simulation, TestKind kind) {
  const TestConditions& conditions = simulation.conditions;
  if (conditions.orientation_deg != 0.0 && conditions.orientation_deg != 90.0)
    return fmt::format("orientation {} degrees, expected 0 or 90", conditions.orientation_deg);
  if (!positive(conditions.strain_rate_per_s))
    return fmt::format("strain rate {} /s, expected a number above 0", conditions.strain_rate_per_s);
  if (!positive(conditions.thickness_mm))
    return fmt::format("thickness {} mm, expected a number above 0", conditions.thickness_mm);
  if (kind == TestKind::toughness && !is_strength_cv(simulation.strength_cv))
    return fmt::format("strength_cv {}, expected 0 or {} to {}", simulation.strength_cv, kSmallestStrengthCv,
                       kLargestStrengthCv);
  if (const std::string fault = criterion_fault(simulation.criterion); kind == TestKind::toughness && !fault.empty())
    return fault;
  // Only the parameters of the test that is run must be usable: a file may hold one table alone.
  material::ParameterSet needed = material::default_parameters();
  needed.extensions = simulation.parameters.extensions;
  if (kind == TestKind::toughness)
    needed.toughness = simulation.parameters.toughness;
  else
    needed.modulus = simulation.parameters.modulus;
  return material::parameter_fault(needed);
}

}  // namespace nacre::tester
