#include "game/model.hpp"

#include <algorithm>

#include "sysid/objective.hpp"

namespace nacre::game {
namespace {

bool acts_in_measurement(const material::Extensions::value_type& extension) {
  const material::Effect* effect = material::find_effect(extension.first);
  return effect != nullptr && effect->side == material::EffectSide::measurement;
}

}  // namespace

material::ParameterSet material_side(material::ParameterSet parameters) {
  std::erase_if(parameters.extensions, acts_in_measurement);
  return parameters;
}

bool has_measurement_side(const material::ParameterSet& parameters) {
  return std::any_of(parameters.extensions.begin(), parameters.extensions.end(), acts_in_measurement);
}

sysid::Prediction through_machine(const sysid::Prediction& prediction, const material::ParameterSet& model) {
  return has_measurement_side(model) ? sysid::observed(prediction, model.extensions) : prediction;
}

}  // namespace nacre::game
