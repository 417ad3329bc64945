#include "game/model.hpp"

#include <algorithm>

#include "sysid/objective.hpp"

namespace nacre::game {
namespace {

bool of_machine(const material::Extensions::value_type& extension) {
  return material::acts_in_measurement(extension.first);
}

}  // namespace

material::ParameterSet material_side(material::ParameterSet parameters) {
  std::erase_if(parameters.extensions, of_machine);
  return parameters;
}

bool has_measurement_side(const material::ParameterSet& parameters) {
  return std::any_of(parameters.extensions.begin(), parameters.extensions.end(), of_machine);
}

sysid::Prediction through_machine(const sysid::Prediction& prediction, const material::ParameterSet& model) {
  return has_measurement_side(model) ? sysid::observed(prediction, model.extensions) : prediction;
}

optimize::Performance through_machine(const optimize::Performance& performance, const material::ParameterSet& model) {
  return {measurement::observe_modulus(performance.modulus_pa, model.extensions),
          measurement::observe_toughness(performance.toughness_pa, model.extensions)};
}

optimize::Performance behind_machine(const optimize::Performance& measured, const material::ParameterSet& model) {
  const double shown_of_one = measurement::observe_toughness(1.0, model.extensions);
  return {measurement::modulus_behind(measured.modulus_pa, model.extensions), measured.toughness_pa / shown_of_one};
}

}  // namespace nacre::game
