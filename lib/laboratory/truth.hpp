#pragma once
// What the virtual laboratory knows and nobody else may: the constants of its materials, its hidden effects and its
// scatter. Only the laboratory itself, `nacre measure` and the program that scores blind trials include headers of this
// folder.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "material/parameters.hpp"
#include "tester/names.hpp"

namespace nacre::laboratory {

/// Relative standard deviations between replicates of one design; all lognormal with median 1.
struct ReplicateNoise {
  double modulus = 0.015;
  double toughness = 0.08;  ///< of T: stress and strain scatter together
  double strain = 0.01;     ///< of the strain axis of a curve; 0 <= strain <= toughness for T to scatter as declared
  bool operator==(const ReplicateNoise&) const = default;
};

/// Strength of every effect that the laboratory can hide, in the units of `effect_kinds()`; 0 is no effect, exactly.
struct HiddenEffects {
  double machine_compliance_per_pa = 0.0;
  double droplet_mixing_pixels = 0.0;
  double interface_anisotropy = 0.0;
  double corner_debonding = 0.0;
  double diagonal_debonding = 0.0;
  double load_cell_gain = 0.0;
  double toe_slack = 0.0;
  double rigid_overprint_pixels = 0.0;
  double rigid_yield_pa = 0.0;
  double soft_stiffening_limit = 0.0;
  double rate_overstress = 0.0, rate_relaxation_s = 0.0;
  double progressive_damage = 0.0;
  double tension_only_failure = 0.0;
  double strength_scatter = 0.0;
  double blunt_notch = 0.0;
  double residual_strain = 0.0;
  double plane_strain = 0.0;
  double batch_drift = 0.0;
  // Other forms of effects that the diagnosis knows.
  double smooth_mixing_pixels = 0.0;
  double longer_notch = 0.0;
  double soft_overstress = 0.0, soft_relaxation_s = 0.0;
  double drawn_out_damage = 0.0;
  double order_drift = 0.0;
  // Effects that it does not know.
  double void_gradient = 0.0;
  double edge_layer = 0.0;
  double weak_layers = 0.0;
  double undercured_features = 0.0;
  double grip_friction = 0.0;
  double grip_tilt = 0.0;
  double bulk_anisotropy = 0.0;
  double thickness_error_mm = 0.0;
  bool operator==(const HiddenEffects&) const = default;
};

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
  std::string_view family = {};                     ///< of the library that it belongs to all the same, or empty
  bool even = false;                                ///< acts on all specimens of one condition by one factor
  double HiddenEffects::*value = nullptr;
  EffectNumber second = {};  ///< its second number, where it has one (second.value not null)
};
std::span<const EffectKind> effect_kinds();

/// The hidden truth of one laboratory.
struct Truth {
  std::uint64_t seed = 1;
  tester::Fidelity fidelity = tester::Fidelity::full;
  int replicates = 4;
  ReplicateNoise noise;
  material::ModulusParameters modulus;
  material::ToughnessParameters toughness;  ///< thresholds as the testers mean them: at element size h
  HiddenEffects effects;
  bool operator==(const Truth&) const = default;
};

/// Material constants of this seed, near those that microstructures show (Table A.2) and different from the bulk's.
material::ModulusParameters draw_modulus_parameters(std::uint64_t seed);
material::ToughnessParameters draw_toughness_parameters(std::uint64_t seed);

/// None, one or two effects (30, 50, 20 %) with magnitudes that matter.
HiddenEffects draw_effects(std::uint64_t seed);
/// The magnitude that this seed gives to one effect, and to its second number.
double draw_effect_value(std::uint64_t seed, const EffectKind& kind);
double draw_second_value(std::uint64_t seed, const EffectKind& kind);

/// The truth of a laboratory that has no file: everything drawn from the seed.
Truth draw_truth(std::uint64_t seed, tester::Fidelity fidelity);

/// Reads LAB.toml. Tables that it lacks are drawn from its seed, which is `seed` where the file names none. Throws
/// InputError naming file, line, key and what was expected.
Truth read_laboratory(const std::filesystem::path& path, std::uint64_t seed = 1);
/// The same from text; `source` names the place in errors.
Truth parse_laboratory(std::string_view toml, std::string_view source, std::uint64_t seed = 1);

/// The whole truth as TOML: parse_laboratory(to_toml(truth)) == truth.
std::string to_toml(const Truth& truth);

/// Writes the truth for the scoring program alone: mode 0400. Throws InputError.
void write_sealed(const std::filesystem::path& path, const Truth& truth);

}  // namespace nacre::laboratory
