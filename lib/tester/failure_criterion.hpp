#pragma once
// When elements of the fracture tester fail, and which length the criterion has (docs/studies/toughness.md).

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "fem/grid.hpp"
#include "material/parameters.hpp"
#include "thesis/constants.hpp"

namespace nacre::tester {

/// The energy density at which an element fails is
enum class CriterionKind {
  element,        ///< its own, the threshold growing as 1/h so that the fracture energy stays (thesis 2.3.1)
  neighbourhood,  ///< the mean over a neighbourhood of a pixel or so (fem/neighbourhood.hpp), W at every h
  crack_band,     ///< its own, W at every h, beyond which a linear tail softens it, the longer the smaller h
};
std::string_view to_string(CriterionKind kind);
/// Error: the names there are.
Result<CriterionKind> criterion_from_string(std::string_view name);

struct FailureCriterion {
  CriterionKind kind = CriterionKind::element;
  double radius_m = 2.0 * thesis::kElementSize;  ///< R of `neighbourhood`: a pixel
  double softening = 3.0;                        ///< v0 of `crack_band`, of unrefined elements
  bool operator==(const FailureCriterion&) const = default;
};

/// A sentence when a number that the criterion uses is out of range; else empty.
std::string criterion_fault(const FailureCriterion& criterion);

/// Sets the criterion of a grid of refined elements whose thresholds are those of `element`. The effect
/// `progressive_damage` is the total v of a crack band; an element that its neighbourhood fails softens by it. Tails
/// are 1 + v(h) = (1 + v) h0 / h, where h0 is the size of unrefined elements. No change for `element`.
void set_criterion(fem::Grid& grid, int refinement, const FailureCriterion& criterion);

}  // namespace nacre::tester
