#pragma once
// Base materials, and what fits and measurements say of their Young's moduli.

#include <array>
#include <string_view>

namespace nacre::diagnosis {

/// Base materials whose E layouts and homogeneous specimens both tell, in the order of material::ModulusVector.
inline constexpr std::array<std::string_view, 3> kConstantMaterials = {"soft", "rigid", "interface"};

/// A Young's modulus of a fit that is at its bound: no prior would leave it there, the ranges are those of other inks.
struct ModulusAtBound {
  int material = 0;  ///< index in kConstantMaterials
  double modulus_pa = 0.0;
  bool of_coupons = false;  ///< in homogeneous specimens, else in layouts
};

/// A base material whose homogeneous specimens, or blends where it has none, measured an E outside the ranges of the
/// inks, widened as those of a fit are (CoordinateMap).
struct OtherMaterial {
  int material = 0;         ///< index in kConstantMaterials
  double modulus_pa = 0.0;  ///< geometric mean over the groups of its specimens: E, of coupons the first slope
  bool by_own_specimens = true;
};

}  // namespace nacre::diagnosis
