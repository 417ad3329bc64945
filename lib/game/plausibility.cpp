#include "game/plausibility.hpp"

#include <fmt/format.h>

#include "measurement/reduction.hpp"
#include "measurement/summary.hpp"
#include "tester/modulus.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::game {
namespace {

/// No usable model is further off.
constexpr double kFar = 8.0;
/// A notch reduces a specimen's stiffness considerably.
constexpr double kFarWithNotch = 20.0;

/// The stiffness that the specimen was measured to have; nothing where it has none.
std::optional<double> measured_modulus(const measurement::SpecimenRecord& specimen) {
  if (specimen.test == tester::TestKind::modulus) return measurement::modulus_of(specimen);
  const auto beginning = measurement::linear_part(specimen.curve);
  if (!beginning) return std::nullopt;
  return beginning->slope_pa;
}

}  // namespace

std::optional<double> UnitDoubts::simulated_pa(const measurement::SpecimenRecord& specimen) {
  const tester::Simulation simulation{specimen.design, model_, specimen.conditions, fidelity_};
  const auto [known, is_new] = simulated_pa_.try_emplace(tester::simulation_key(simulation, tester::TestKind::modulus));
  if (is_new) {
    if (const auto simulated = tester::test_modulus(simulation)) known->second = simulated->modulus_pa;
  }
  return known->second;
}

std::optional<std::string> UnitDoubts::about(const measurement::SpecimenRecord& specimen) {
  if (!specimen.valid) return std::nullopt;
  const auto measured_pa = measured_modulus(specimen);
  if (!measured_pa) return std::nullopt;
  const std::optional<double> modulus_pa = simulated_pa(specimen);
  if (!modulus_pa) return std::nullopt;
  const bool is_notched = specimen.test == tester::TestKind::toughness;
  const double ratio = *measured_pa / *modulus_pa;
  if (ratio < kFar && ratio > 1.0 / (is_notched ? kFarWithNotch : kFar)) return std::nullopt;
  return fmt::format("specimen {} of {}, {} test: {} {:.3g} GPa, the model predicts a modulus of {:.3g}: {}",
                     specimen.specimen, specimen.design.name(), tester::to_string(specimen.test),
                     is_notched || !specimen.modulus_pa ? "its curve begins with a slope of" : "its modulus is",
                     1e-9 * *measured_pa, 1e-9 * *modulus_pa,
                     "is a unit wrong (stress in Pa, strain as a ratio, size in mm)?");
}

}  // namespace nacre::game
