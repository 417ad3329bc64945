#pragma once
// When material fails in the toughness tester, which length the criterion has, and how strengths vary between regions
// (docs/studies/toughness.md).

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "thesis/constants.hpp"

namespace nacre::material {

/// The energy density at which an element of the toughness tester fails is
enum class CriterionKind {
  element,        ///< its own, the threshold growing as 1/h so that the fracture energy stays (thesis 2.3.1)
  neighbourhood,  ///< the mean over a neighbourhood of a pixel or so (fem/neighbourhood.hpp), W at every h
  crack_band,     ///< its own, W at every h, beyond which a linear tail softens it, the longer the smaller h
};
std::string_view to_string(CriterionKind kind);
Result<CriterionKind> criterion_from_string(std::string_view name);

/// Numbers that a criterion does not use are kept, and change nothing.
struct FailureCriterion {
  CriterionKind kind = CriterionKind::element;
  double radius_m = 2.0 * thesis::kElementSize;  ///< R of `neighbourhood`: a pixel
  double softening = 3.0;                        ///< v0 of `crack_band`, of unrefined elements
  bool operator==(const FailureCriterion&) const = default;
};
/// Of the base model, where neither file nor option names another
/// (docs/decisions/0026-toughness-is-an-expectation.md).
FailureCriterion base_criterion();
double base_strength_cv();

/// A sentence when the kind is none, or a number that it uses is out of range; else empty.
std::string criterion_fault(const FailureCriterion& criterion);

/// Values that strength_cv, the coefficient of variation of W between regions of half a pixel, may take beside 0.
/// Prior of a fit: log-normal, median 0.10, factor 1.5.
inline constexpr double kSmallestStrengthCv = 0.02, kLargestStrengthCv = 0.4;
bool is_strength_cv(double value);

}  // namespace nacre::material
