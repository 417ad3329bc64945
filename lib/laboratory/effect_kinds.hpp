#pragma once
// The table of effects that the laboratory can hide.

#include <span>
#include <string_view>

#include "laboratory/truth.hpp"

namespace nacre::laboratory {

/// One number of an effect: what it means, which values are allowed in a file and which are drawn.
struct EffectNumber {
  std::string_view unit;
  std::string_view meaning;
  double minimum = 0.0, maximum = 0.0;
  double drawn_minimum = 0.0, drawn_maximum = 0.0;  ///< magnitudes drawn, log-uniform
  double HiddenEffects::*value = nullptr;
};

/// One sort of hidden effect: its name in LAB.toml, what its value means, which values are allowed and which are drawn.
struct EffectKind {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  double minimum = 0.0, maximum = 0.0;              ///< allowed in a file
  double drawn_minimum = 0.0, drawn_maximum = 0.0;  ///< magnitudes drawn, log-uniform
  bool either_sign = false;                         ///< the drawn value takes a sign by the toss of a coin
  bool drawn_unasked = false;                       ///< a laboratory without file may hide it
  bool in_library = true;                           ///< false: the diagnosis has no name for it
  std::string_view family = {};                     ///< of the library's that it belongs to nevertheless, or empty
  bool even = false;                                ///< acts on all specimens of one condition by one factor
  bool bulk = false;                                ///< told by homogeneous specimens alone
  double HiddenEffects::*value = nullptr;
  EffectNumber second = {};  ///< its second number, where it has one (second.value not null)
};
std::span<const EffectKind> effect_kinds();

}  // namespace nacre::laboratory
