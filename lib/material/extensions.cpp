#include "material/extensions.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "material/effect_library.hpp"

namespace nacre::material {
namespace {

double largest_size(const EffectParameter& parameter) {
  return std::max(std::abs(parameter.minimum), std::abs(parameter.maximum));
}

}  // namespace

bool EffectParameter::allows(double value) const {
  return value == 0.0 || (value >= minimum && value <= maximum && value >= (smallest > 0.0 ? smallest : minimum));
}

std::string EffectParameter::range() const {
  return smallest > 0.0 ? fmt::format("0 or {} to {}", smallest, maximum) : fmt::format("{} to {}", minimum, maximum);
}

double value_at_strength(const EffectParameter& parameter, double strength) {
  switch (parameter.strength) {
    case Strength::proportional:
      return strength * largest_size(parameter);
    case Strength::reciprocal:
      return strength * parameter.maximum > parameter.smallest ? parameter.smallest / strength : 0.0;
    case Strength::scale:
      return parameter.smallest * std::pow(parameter.maximum / parameter.smallest, strength);
  }
  return 0.0;
}

double strength_of(const EffectParameter& parameter, double value) {
  switch (parameter.strength) {
    case Strength::proportional:
      return value / largest_size(parameter);
    case Strength::reciprocal:
      return value > 0.0 ? parameter.smallest / value : 0.0;
    case Strength::scale:
      return std::log(value / parameter.smallest) / std::log(parameter.maximum / parameter.smallest);
  }
  return 0.0;
}

const Effect* find_effect(std::string_view name) {
  for (const std::span<const Effect> table : {effect_library(), condition_laws()}) {
    const auto found = std::ranges::find(table, name, &Effect::name);
    if (found != table.end()) return &*found;
  }
  return nullptr;
}

bool acts_in_measurement(std::string_view name) {
  const Effect* effect = find_effect(name);
  return effect != nullptr && effect->side == EffectSide::measurement;
}

double extension_value(const Extensions& extensions, std::string_view name, int index) {
  const auto found = extensions.find(name);
  if (found == extensions.end() || index >= static_cast<int>(found->second.size())) return 0.0;
  return found->second[index];
}

}  // namespace nacre::material
