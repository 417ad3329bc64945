#include "tester/elastic_key.hpp"

#include <fmt/format.h>

#include "material/extensions.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::tester {
namespace {

/// The effect that tells the printer's directions apart.
constexpr const char* kDirectional = "interface_anisotropy";
/// The effect that is rate_factor().
constexpr const char* kFactor = "rate_dependence";

}  // namespace

std::string elastic_key(Simulation simulation, int refinement) {
  simulation.parameters.extensions.erase(kFactor);
  if (material::extension_value(simulation.parameters.extensions, kDirectional) == 0.0)
    simulation.conditions.orientation_deg = 0.0;
  return fmt::format("{}/{}", simulation_key(simulation, TestKind::modulus), refinement);
}

}  // namespace nacre::tester
