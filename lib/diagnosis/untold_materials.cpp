#include "diagnosis/untold_materials.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/misfit.hpp"
#include "diagnosis/other_materials.hpp"

namespace nacre::diagnosis {
namespace {

/// Base materials whose E only layouts tell.
std::vector<int> untold(const Observations& observations) {
  std::vector<int> materials;
  for (int material = 0; material < static_cast<int>(kConstantMaterials.size()); ++material)
    if (!is_told_by_own_specimens(observations, material)) materials.push_back(material);
  return materials;
}

/// Those which layouts want beyond the bounds of the search.
std::vector<ModulusAtBound> untold_moduli_at_bounds(const Evidence& evidence, const FittedModel& model) {
  std::vector<ModulusAtBound> moduli = evidence.model.base_map().moduli_at_bounds(model.u.head(model.base_count));
  std::erase_if(moduli, [&](const ModulusAtBound& each) {
    return each.of_coupons || is_told_by_own_specimens(evidence.observations, each.material);
  });
  return moduli;
}

/// The model where E of these materials is searched in ranges of so many times the width, in log.
FittedModel fitted_within(const Evidence& evidence, const FittedModel& model, const std::vector<int>& materials,
                          double width) {
  Basis basis = evidence.model.basis();
  for (const int material : materials) {
    material::ParameterRange& range = basis.ranges.microstructure_modulus[material];
    const double further = std::pow(range.maximum / range.minimum, 0.5 * (width - 1.0));
    range.minimum /= further;
    range.maximum *= further;
  }
  const FeatureModel other = evidence.model.with_basis(basis);
  Eigen::VectorXd start = model.u;
  start.head(model.base_count) = other.base_map().coordinates(model.parameters);
  return fit_model(other, evidence.observations, evidence.settings.procedure.fit, model.effects, start);
}

bool is_noise(const Evidence& evidence, const FittedModel& fit) {
  return chance_of_misfit(evidence, fit) >= evidence.settings.procedure.levels.unexplained;
}

/// The model with these moduli searched three times as far as usual; nothing where it explains the data with all E
/// that only layouts tell within the inks' own ranges: it does not need other materials.
std::optional<FittedModel> of_other_materials(const Evidence& evidence, const FittedModel& model,
                                              const std::vector<ModulusAtBound>& moduli) {
  constexpr double kWider = 3.0;
  if (moduli.empty()) return std::nullopt;
  const double as_inks = 1.0 / evidence.settings.procedure.constants.widening;
  if (is_noise(evidence, fitted_within(evidence, model, untold(evidence.observations), as_inks))) return std::nullopt;
  std::vector<int> materials;
  for (const ModulusAtBound& each : moduli) materials.push_back(each.material);
  return fitted_within(evidence, model, materials, kWider);
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
  const std::vector<ModulusAtBound> moduli = untold_moduli_at_bounds(evidence, evidence.base.fit);
  const std::optional<FittedModel> fit = of_other_materials(evidence, evidence.base.fit, moduli);
  return fit && is_noise(evidence, *fit) ? as_found(moduli, *fit) : std::vector<ModulusAtBound>();
}

std::vector<ModulusAtBound> untold_materials_of(const Evidence& evidence, const FittedModel& model) {
  const std::vector<ModulusAtBound> moduli = untold_moduli_at_bounds(evidence, model);
  const std::optional<FittedModel> fit = of_other_materials(evidence, model, moduli);
  return fit ? as_found(moduli, *fit) : std::vector<ModulusAtBound>();
}

}  // namespace nacre::diagnosis
