#pragma once
// The optimisable parameters of the two virtual testers (thesis Eq. 2.7) and the extensions of the model.
// Index of materials everywhere: 0 soft (TB, TangoBlackPlus), 1 rigid (VW, VeroWhitePlus), 2 interface (IF).

#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "base/result.hpp"
#include "material/failure_criterion.hpp"

namespace nacre::material {

/// theta: the modulus tester's parameters.
struct ModulusParameters {
  double e_tb_pa = 0.0, e_vw_pa = 0.0, e_if_pa = 0.0;
  double nu_tb = 0.0, nu_vw = 0.0, nu_if = 0.0;
  double gamma_per_s = 0.0;
  bool operator==(const ModulusParameters&) const = default;
};

/// eta: the toughness tester's parameters.
struct ToughnessParameters {
  double e_tb_pa = 0.0, e_vw_pa = 0.0, e_if_pa = 0.0;
  double nu_tb = 0.0, nu_vw = 0.0, nu_if = 0.0;
  double w_tb_j_per_m3 = 0.0, w_vw_j_per_m3 = 0.0, w_if_j_per_m3 = 0.0;
  double gamma_per_s = 0.0;
  bool operator==(const ToughnessParameters&) const = default;
};

inline constexpr int kModulusParameterCount = 7;
inline constexpr int kToughnessParameterCount = 10;
using ModulusVector = std::array<double, kModulusParameterCount>;
using ToughnessVector = std::array<double, kToughnessParameterCount>;

/// Names in the order of the vectors: e_tb_pa, e_vw_pa, e_if_pa, nu_tb, nu_vw, nu_if, [w_tb_j_per_m3, ...,]
/// gamma_per_s.
std::span<const std::string_view> modulus_parameter_names();
std::span<const std::string_view> toughness_parameter_names();

ModulusVector to_vector(const ModulusParameters& parameters);
ToughnessVector to_vector(const ToughnessParameters& parameters);
ModulusParameters modulus_from_vector(const ModulusVector& vector);
ToughnessParameters toughness_from_vector(const ToughnessVector& vector);

/// Extensions of the base model by name, each with its one or two parameters in the units of extensions.hpp. An
/// absent extension and one at zero are the same model.
using Extensions = std::map<std::string, std::vector<double>, std::less<>>;

/// All parameters of the material model.
struct ParameterSet {
  ModulusParameters modulus;
  ToughnessParameters toughness;
  Extensions extensions;
  FailureCriterion criterion = {};  ///< of the toughness tester
  /// Of the toughness tester: coefficient of variation of W between regions of half a pixel
  /// (tester/strength_field.hpp). 0, the thesis' model, or 0.02 to 0.4. Calibrations do not fit it yet.
  double strength_cv = 0.0;
  bool operator==(const ParameterSet&) const = default;
};

/// eta with every parameter multiplied by 1 + relative x a standard normal number (nu held below 0.5): a draw from the
/// uncertainty of the parameters.
ToughnessParameters perturbed(const ToughnessParameters& eta, double relative, RandomStream& random);

/// Built-in parameters (of the base model's criterion: the content of data/defaults.toml): the measured base materials
/// of Table 3.4 for the modulus tester, the geometric middle of Table A.2 for the toughness tester, W for that
/// criterion, the base model's strength_cv.
ParameterSet default_parameters(const FailureCriterion& criterion = base_criterion());

/// The same by the thesis' model: every element fails by itself, and specimens are all alike.
ParameterSet thesis_parameters();

/// A sentence when the set lies outside what the testers can compute (E <= 0, nu outside [0, 0.5], W <= 0, unknown
/// extension, extension parameter outside its range, strength_cv or a number of the criterion out of range, anything
/// not finite); empty when it is usable.
std::string parameter_fault(const ParameterSet& parameters);

}  // namespace nacre::material
