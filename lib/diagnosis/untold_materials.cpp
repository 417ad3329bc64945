#include "diagnosis/untold_materials.hpp"

#include <algorithm>

#include "diagnosis/misfit.hpp"
#include "diagnosis/other_materials.hpp"

namespace nacre::diagnosis {
namespace {

/// Base materials whose E only layouts tell, and which those want beyond the bounds of the search.
std::vector<ModulusAtBound> untold_moduli_at_bounds(const Evidence& evidence, const FittedModel& model) {
  std::vector<ModulusAtBound> moduli = evidence.model.base_map().moduli_at_bounds(model.u.head(model.base_count));
  std::erase_if(moduli, [&](const ModulusAtBound& each) {
    return each.of_coupons || is_told_by_own_specimens(evidence.observations, each.material);
  });
  return moduli;
}

/// The model where these moduli are searched three times as far.
FittedModel with_other_materials(const Evidence& evidence, const FittedModel& model,
                                 const std::vector<ModulusAtBound>& moduli) {
  Basis basis = evidence.model.basis();
  for (const ModulusAtBound& each : moduli) {
    material::ParameterRange& range = basis.ranges.microstructure_modulus[each.material];
    const double ratio = range.maximum / range.minimum;
    range.minimum /= ratio;
    range.maximum *= ratio;
  }
  const FeatureModel wider = evidence.model.with_basis(basis);
  Eigen::VectorXd start = model.u;
  start.head(model.base_count) = wider.base_map().coordinates(model.parameters);
  return fit_model(wider, evidence.observations, evidence.settings.procedure.fit, model.effects, start);
}

std::vector<ModulusAtBound> as_found(std::vector<ModulusAtBound> moduli, const FittedModel& fit) {
  const material::ModulusVector found = to_vector(fit.parameters.modulus);
  for (ModulusAtBound& each : moduli) each.modulus_pa = found[each.material];
  return moduli;
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
  std::vector<ModulusAtBound> moduli = untold_moduli_at_bounds(evidence, evidence.base.fit);
  if (moduli.empty()) return {};
  const FittedModel fit = with_other_materials(evidence, evidence.base.fit, moduli);
  if (chance_of_misfit(evidence, fit) < evidence.settings.procedure.levels.unexplained) return {};
  return as_found(std::move(moduli), fit);
}

std::vector<ModulusAtBound> untold_materials_of(const Evidence& evidence, const FittedModel& model) {
  std::vector<ModulusAtBound> moduli = untold_moduli_at_bounds(evidence, model);
  if (moduli.empty()) return {};
  return as_found(std::move(moduli), with_other_materials(evidence, model, moduli));
}

}  // namespace nacre::diagnosis
