#pragma once
// Coordinates u of a fit: the base constants of each kind of specimen, then one per parameter of the effects that
// extend the model. log p = low + u (high - low) for moduli, energies and damping; p linear in u for Poisson's ratios.

#include <Eigen/Dense>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/material_constants.hpp"
#include "diagnosis/procedure.hpp"
#include "material/extensions.hpp"
#include "material/ranges.hpp"

namespace nacre::diagnosis {

/// Which base constants are free. Kinds of specimens have constants of their own (thesis 2.3.1, 3.2.4) and share
/// effects.
struct Basis {
  bool modulus =
      true;  ///< theta of modulus tests of layouts: E and nu of three materials (gamma has no effect on a static test)
  bool toughness = false;  ///< eta of fracture tests: E and W of three materials, gamma
  bool coupon = false;     ///< E and nu of the bulk materials: homogeneous coupons
  material::ParameterSet centre =
      material::default_parameters();  ///< centre of the search for eta, and values of constants that are not searched
  material::ParameterRanges ranges = material::default_ranges();  ///< of theta and the bulk constants
  ConstantRules rules = {};
  int machines = 1, materials = 1;  ///< of the data, homogeneous materials
};

/// One parameter of one effect.
struct EffectCoordinate {
  const material::Effect* effect = nullptr;
  int parameter = 0;
};

/// Bounds of a search: the range widened about its middle, of the logarithm where `logarithmic` (moduli);
/// ratios are kept physical.
struct Bounds {
  double low = 0.0, high = 0.0;
};
Bounds searched_bounds(const material::ParameterRange& range, bool logarithmic, const ConstantRules& rules);

/// theta and the bulk constants in the unit cube of their ranges widened three-fold (moduli in log scale); eta within a
/// factor e^1.5 of the centre, in log scale; effects by their strength (material::value_at_strength), -1 or 0 to 1.
class CoordinateMap {
 public:
  CoordinateMap(const Basis& basis, std::span<const std::string> effects);
  int size() const { return base_count() + static_cast<int>(extension_.size()); }
  int base_count() const { return base_.size(); }
  const std::vector<std::string>& effects() const { return effects_; }
  double lower(int i) const;
  double upper(int i) const;
  /// Standard deviation of the prior of a base coordinate about its middle, 0.5.
  double prior_sd(int i) const { return base_[i].prior_sd; }
  /// Young's moduli at their bounds.
  std::vector<ModulusAtBound> moduli_at_bounds(const Eigen::VectorXd& u) const;
  /// Physical value of coordinate i at u.
  double value(int i, double u) const;
  /// Coordinate of the second parameter of an effect (a time, a shape) while the first is tried.
  double usual(int i) const;
  /// Number of coordinates of an effect.
  int count_of(const material::Effect& effect) const;
  /// First coordinate of the effect with this index among effects().
  int first_coordinate(std::size_t effect) const;
  /// Parameters of layouts.
  material::ParameterSet parameters(const Eigen::VectorXd& u) const;
  /// Parameters of homogeneous coupons: E and nu of the bulk in place of theta's, where they are free.
  material::ParameterSet coupon_parameters(const Eigen::VectorXd& u) const;
  /// Base coordinates of `parameters`, moved into the ranges; extension coordinates 0. The bulk begins where theta
  /// does.
  Eigen::VectorXd coordinates(const material::ParameterSet& parameters) const;

 private:
  enum class Block { modulus, toughness, coupon };
  struct BaseCoordinate {
    Block block;
    int index;         ///< in the vector of the block's parameters
    double low, high;  ///< of the logarithm where `logarithmic`
    bool logarithmic;
    double prior_sd;
  };
  double plain(const BaseCoordinate& c, double u) const;
  const material::EffectParameter& parameter_of(int i) const;
  material::ParameterSet with_extensions(material::ParameterSet set, const Eigen::VectorXd& u) const;

  material::ParameterSet centre_;
  ConstantRules rules_;
  int machines_ = 1, materials_ = 1;
  std::vector<BaseCoordinate> base_;
  std::vector<std::string> effects_;
  std::vector<EffectCoordinate> extension_;
};

}  // namespace nacre::diagnosis
