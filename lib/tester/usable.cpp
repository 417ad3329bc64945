#include "tester/usable.hpp"

#include <cmath>

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
  // Only the parameters of the test that is run must be usable: a file may hold one table alone.
  material::ParameterSet needed = material::default_parameters();
  needed.extensions = simulation.parameters.extensions;
  if (kind == TestKind::toughness) {
    needed.toughness = simulation.parameters.toughness;
    needed.criterion = simulation.parameters.criterion;
    needed.strength_cv = simulation.parameters.strength_cv;
  } else {
    needed.modulus = simulation.parameters.modulus;
  }
  return material::parameter_fault(needed);
}

}  // namespace nacre::tester
