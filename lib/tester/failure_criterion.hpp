#pragma once
// When elements of the fracture tester fail, and which length the criterion has (docs/studies/toughness.md).

#include <string>

#include "fem/grid.hpp"
#include "tester/names.hpp"
#include "thesis/constants.hpp"

namespace nacre::tester {

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
