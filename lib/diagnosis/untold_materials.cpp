#include "diagnosis/untold_materials.hpp"

#include <algorithm>
#include <optional>

#include "diagnosis/misfit.hpp"
#include "diagnosis/other_materials.hpp"

namespace nacre::diagnosis {
namespace {

/// Base materials whose E only layouts tell, and which those want beyond the bounds of the search.
std::vector<ModulusAtBound> untold_moduli_at_bounds(const Evidence& evidence) {
  std::vector<ModulusAtBound> moduli = evidence.model.base_map().moduli_at_bounds(evidence.base.fit.u);
  std::erase_if(moduli, [&](const ModulusAtBound& each) {
    return each.of_coupons || is_told_by_own_specimens(evidence.observations, each.material);
  });
  return moduli;
}

/// The base where these moduli are searched three times as far; nothing where it misfits there too.
std::optional<FittedModel> base_of_other_materials(const Evidence& evidence,
                                                   const std::vector<ModulusAtBound>& moduli) {
  Basis basis = evidence.model.basis();
  for (const ModulusAtBound& each : moduli) {
    material::ParameterRange& range = basis.ranges.microstructure_modulus[each.material];
    const double ratio = range.maximum / range.minimum;
    range.minimum /= ratio;
    range.maximum *= ratio;
  }
  const FeatureModel wider = evidence.model.with_basis(basis);
  FittedModel fit = fit_model(wider, evidence.observations, evidence.settings.procedure.fit, {},
                              wider.base_map().coordinates(evidence.base.fit.parameters));
  if (chance_of_misfit(evidence, fit) < evidence.settings.procedure.levels.unexplained) return std::nullopt;
  return fit;
}

/// Base materials of which blends alone want an E beyond the ranges, where the base fits with it.
std::vector<ModulusAtBound> told_by_blends(const Evidence& evidence) {
  const Procedure& rules = evidence.settings.procedure;
  std::vector<ModulusAtBound> moduli;
  if (evidence.p_misfit < rules.levels.unexplained) return moduli;
  for (const OtherMaterial& other : other_materials(evidence.observations, evidence.settings.ranges, rules.constants))
    if (!other.by_own_specimens) moduli.push_back({other.material, other.modulus_pa, true});
  return moduli;
}

}  // namespace

std::vector<ModulusAtBound> untold_materials(const Evidence& evidence) {
  if (std::vector<ModulusAtBound> of_blends = told_by_blends(evidence); !of_blends.empty()) return of_blends;
  std::vector<ModulusAtBound> moduli = untold_moduli_at_bounds(evidence);
  if (moduli.empty()) return {};
  const std::optional<FittedModel> fit = base_of_other_materials(evidence, moduli);
  if (!fit) return {};
  const material::ModulusVector found = to_vector(fit->parameters.modulus);
  for (ModulusAtBound& each : moduli) each.modulus_pa = found[each.material];
  return moduli;
}

}  // namespace nacre::diagnosis
