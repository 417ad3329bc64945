#pragma once
// The library of effects that extend the base model. Each is exactly the base model at zero. Material-side effects
// change the simulator; measurement-side effects act only in measurement::observe().

#include <span>
#include <string_view>

#include "material/parameters.hpp"

namespace nacre::material {

enum class EffectSide { material, measurement };

/// One parameter of an effect: what it means, its unit and the range it may take.
struct EffectParameter {
  std::string_view meaning;
  std::string_view unit;
  double minimum = 0.0;
  double maximum = 0.0;
};

/// A named extension of the model. `family` groups effects that one set of data may not tell apart.
struct Effect {
  std::string_view name;
  std::string_view family;
  EffectSide side = EffectSide::material;
  std::span<const EffectParameter> parameters;
  bool acts_on_modulus = false;
  bool acts_on_toughness = false;
  std::string_view explanation;
};

/// All effects that the model can be extended by, in a fixed order.
std::span<const Effect> effect_library();

/// The effect of that name, or nullptr.
const Effect* find_effect(std::string_view name);

/// Value of parameter `index` of extension `name`; 0 when the extension is absent.
double extension_value(const Extensions& extensions, std::string_view name, int index = 0);

}  // namespace nacre::material
