#pragma once
// The hidden truth of a virtual laboratory, which nobody else may know: the constants of its materials, its hidden
// effects and its scatter. Only the laboratory itself, `nacre measure` and the program that scores blind trials include
// headers of this folder.

#include <cmath>
#include <cstdint>

#include "material/parameters.hpp"
#include "tester/names.hpp"

namespace nacre::laboratory {

/// Relative standard deviations between replicates of one design; all lognormal with median 1.
struct ReplicateNoise {
  double modulus = 0.015;
  double toughness = 0.03;  ///< of measuring T: stress and strain scatter together; specimens differ besides
  double strain = 0.01;     ///< of the strain axis of a curve; 0 <= strain <= toughness for T to scatter as declared
  bool operator==(const ReplicateNoise&) const = default;
};

/// Of two relaxation times (two_overstresses) the longer over the shorter.
inline constexpr double kLongerRelaxation = 1000.0;

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
  double rate_exponent = 0.0, rate_exponent_ratio = 0.0;
  double two_overstresses = 0.0, shorter_relaxation_s = 0.0;
  double blend_bulge = 0.0;
  double compliance_of_one_machine_per_pa = 0.0;
  double gain_of_one_machine = 0.0;
  // Other forms of effects of the diagnosis' library.
  double smooth_mixing_pixels = 0.0;
  double longer_notch = 0.0;
  double soft_overstress = 0.0, soft_relaxation_s = 0.0;
  double drawn_out_damage = 0.0;
  double order_drift = 0.0;
  // Unmodelled causes: not in its library.
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

/// E of homogeneous specimens over E of the same material in a layout (thesis 3.2.4: voxels do not have bulk
/// constants).
struct CouponRatios {
  double soft = 1.0, rigid = 1.0, interface = 1.0;
  bool operator==(const CouponRatios&) const = default;
};

/// The hidden truth of one laboratory.
struct Truth {
  std::uint64_t seed = 1;
  tester::Fidelity fidelity = tester::Fidelity::full;
  int replicates = 4;
  ReplicateNoise noise;
  material::ModulusParameters modulus;  ///< of layouts
  CouponRatios coupons;
  material::ToughnessParameters toughness;    ///< thresholds as the testers mean them: at element size h
  material::FailureCriterion criterion = {};  ///< `element`, 0: the thesis' model, where nothing else was read or drawn
  double strength_cv = 0.0;                   ///< of W between voxels of half a pixel, by a law of its own (Weibull)
  HiddenEffects effects;
  bool operator==(const Truth&) const = default;
};

/// Variation of W between voxels: `strength_scatter` adds to what there is.
inline double variation_of_strength(const Truth& truth) {
  return std::hypot(truth.effects.strength_scatter, truth.strength_cv);
}

}  // namespace nacre::laboratory
