#pragma once
// The library of effects that extend the base model. Each is exactly the base model at zero. Material-side effects
// change the simulator; measurement-side effects act only in measurement::observe().

#include <span>
#include <string>
#include <string_view>

#include "material/parameters.hpp"

namespace nacre::material {

enum class EffectSide { material, measurement };

/// How an effect's strength depends on the value of a parameter.
enum class Strength {
  proportional,  ///< grows with the value; 0 is the base model
  reciprocal,    ///< a limit: the smaller, the stronger; 0 means no limit, the base model
  scale,         ///< where or when the effect acts, not how strongly; searched in log10
};

/// One parameter of an effect: its meaning, its unit and the values it may take: 0, and from `minimum` or, where that
/// is given, `smallest` up to `maximum`.
struct EffectParameter {
  std::string_view meaning;
  std::string_view unit;
  double minimum = 0.0;
  double maximum = 0.0;
  Strength strength = Strength::proportional;
  double smallest = 0.0;  ///< smallest value above 0 of a limit or a scale

  bool allows(double value) const;
  /// The allowed values in words, for messages.
  std::string range() const;
};

/// Value of a parameter at `strength`, -1 or 0 to 1, where 0 is the base model and 1 the strongest allowed: strength
/// times the largest effect size, the smallest limit over strength (0 where that is beyond the range), or, for a scale,
/// the point between smallest and largest in log10.
double value_at_strength(const EffectParameter& parameter, double strength);
/// The inverse of value_at_strength().
double strength_of(const EffectParameter& parameter, double value);

/// A number that follows from an effect's parameters and says more than they do.
struct DerivedNumber {
  std::string_view name;  ///< in files
  std::string_view meaning;
  double (*of)(std::span<const double> parameters) = nullptr;
  std::string_view unit = "1";
};

/// A named extension of the model. `family` groups effects whose signatures may be collinear in one set of data.
struct Effect {
  std::string_view name;
  std::string_view family;
  EffectSide side = EffectSide::material;
  std::span<const EffectParameter> parameters;
  bool acts_on_modulus = false;
  bool acts_on_toughness = false;
  bool acts_on_tensile = false;  ///< the unnotched homogeneous coupon
  std::string_view explanation;
  std::string_view form_of = {};  ///< the effect of which this is another form; empty: of none
  std::string_view form = {};     ///< of effects with several forms: which
  std::span<const DerivedNumber> derived = {};
  std::string_view law_of = {};  ///< the condition of which it is a law (condition_laws()); empty: of none
  /// Where its one parameter has a value for each of several: "material" (homogeneous ones, by name) or "machine" (but
  /// for the first, by name).
  std::string_view one_for_each = {};
  bool is_by_phase = false;  ///< its last two parameters are those of interface and rigid phase over the first
  /// Parameter of a value in Extensions.
  const EffectParameter& parameter(std::size_t index) const {
    return one_for_each.empty() ? parameters[index] : parameters.front();
  }
  bool takes(std::size_t values) const { return one_for_each.empty() ? values == parameters.size() : values > 0; }
  /// What people call the cause: all forms of one effect alike.
  std::string_view cause() const { return form_of.empty() ? name : form_of; }
};

/// The effect of that name, or nullptr.
const Effect* find_effect(std::string_view name);
/// Whether that effect acts in the testing machine; false for an unknown name.
bool acts_in_measurement(std::string_view name);

/// Value of parameter `index` of extension `name`; 0 when the extension is absent.
double extension_value(const Extensions& extensions, std::string_view name, int index = 0);

}  // namespace nacre::material
