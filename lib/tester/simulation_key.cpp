#include "tester/simulation_key.hpp"

#include <algorithm>

#include "base/hash.hpp"
#include "material/extensions.hpp"
#include "tester/strength_field.hpp"

namespace nacre::tester {
namespace {

/// Exact and the same on every machine: hexadecimal floating point, one zero.
std::string exact(double value) { return fmt::format("{:a}", value == 0.0 ? 0.0 : value); }

template <class Vector>
std::string exact_values(const Vector& values) {
  std::string text;
  for (const double value : values) text += " " + exact(value);
  return text;
}

/// theta without gamma, which the static solution does not depend on; or eta.
std::string parameter_text(const material::ParameterSet& parameters, TestKind kind) {
  if (kind == TestKind::toughness) return exact_values(material::to_vector(parameters.toughness));
  material::ModulusParameters theta = parameters.modulus;
  theta.gamma_per_s = 0.0;
  return exact_values(material::to_vector(theta));
}

/// Whether the simulated result can depend on this extension.
bool acts(std::string_view name, const std::vector<double>& values, TestKind kind) {
  if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; })) return false;
  const material::Effect* effect = material::find_effect(name);
  if (effect == nullptr) return true;
  if (effect->side == material::EffectSide::measurement) return false;
  return kind == TestKind::modulus     ? effect->acts_on_modulus
         : kind == TestKind::toughness ? effect->acts_on_toughness
                                       : effect->acts_on_tensile;
}

/// Extensions in the order of their names, then the conditions that they make the simulation depend on.
std::string model_text(const Simulation& simulation, TestKind kind) {
  std::string text;
  for (const auto& [name, values] : simulation.parameters.extensions) {
    if (!acts(name, values, kind)) continue;
    text += fmt::format("extension {}{}\n", name, exact_values(values));
    // The base model depends on neither rate nor thickness; of the extensions these do.
    if (const material::Effect* effect = material::find_effect(name); effect != nullptr && effect->family == "rate")
      text += fmt::format("strain_rate_per_s {}\n", exact(simulation.conditions.strain_rate_per_s));
    if (name == "plane_strain") text += fmt::format("thickness_mm {}\n", exact(simulation.conditions.thickness_mm));
  }
  return text;
}

/// What a fracture test depends on beside the thesis' model; empty where it is that.
std::string failure_text(const Simulation& simulation) {
  const material::ParameterSet& parameters = simulation.parameters;
  const material::FailureCriterion& criterion = parameters.criterion;
  std::string text;
  if (parameters.strength_cv != 0.0) text += fmt::format("strength_cv {}\n", exact(parameters.strength_cv));
  if (criterion.kind == material::CriterionKind::neighbourhood)
    text += fmt::format("criterion neighbourhood {}\n", exact(criterion.radius_m));
  if (criterion.kind == material::CriterionKind::crack_band)
    text += fmt::format("criterion crack_band {}\n", exact(criterion.softening));
  if (simulation.specimen != 0 && specimens_differ(parameters))
    text += fmt::format("specimen {}\n", simulation.specimen);
  return text;
}

}  // namespace

std::string simulation_key(const Simulation& simulation, TestKind kind) {
  // Cached results of a turned coupon may be those of its layout turned against the pull, as in earlier versions.
  const bool is_turned_coupon = simulation.conditions.orientation_deg == 90.0 && simulation.design.layout() &&
                                !simulation.design.layout()->has_eightfold_symmetry();
  const std::string inputs =
      fmt::format("kernel {}\ntest {}\nfidelity {}\ndesign {}\norientation_deg {}{}\nparameters{}\n{}{}",
                  kKernelVersion, to_string(kind), to_string(simulation.fidelity), simulation.design.name(),
                  exact(simulation.conditions.orientation_deg), is_turned_coupon ? " with its layout" : "",
                  parameter_text(simulation.parameters, kind), model_text(simulation, kind),
                  kind == TestKind::toughness ? failure_text(simulation) : "");
  return content_hash(inputs);
}

}  // namespace nacre::tester
