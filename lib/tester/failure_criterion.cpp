#include "tester/failure_criterion.hpp"

#include <fmt/format.h>

namespace nacre::tester {
namespace {

/// Of a neighbourhood in unrefined elements, and of a tail.
constexpr double kLargestRadius = 20.0, kSmallestSoftening = 0.1, kLargestSoftening = 30.0;

}  // namespace

std::string criterion_fault(const FailureCriterion& criterion) {
  const double radius = criterion.radius_m / thesis::kElementSize;
  if (criterion.kind == CriterionKind::neighbourhood && !(radius > 0.0 && radius <= kLargestRadius))
    return fmt::format("radius of the neighbourhood {} m, expected above 0, at most {}", criterion.radius_m,
                       kLargestRadius * thesis::kElementSize);
  if (criterion.kind == CriterionKind::crack_band &&
      !(criterion.softening >= kSmallestSoftening && criterion.softening <= kLargestSoftening))
    return fmt::format("softening of the crack band {}, expected {} to {}", criterion.softening, kSmallestSoftening,
                       kLargestSoftening);
  return "";
}

void set_criterion(fem::Grid& grid, int refinement, const FailureCriterion& criterion) {
  if (criterion.kind == CriterionKind::element) return;
  for (double& threshold : grid.threshold_j_per_m3) threshold /= refinement;
  double& softening = grid.laws.softening;
  if (criterion.kind == CriterionKind::neighbourhood) {
    grid.neighbourhood_m = criterion.radius_m;
  } else {
    grid.laws.is_crack_band = true;
    if (softening == 0.0) softening = criterion.softening;
  }
  if (softening > 0.0) softening = (1.0 + softening) * refinement - 1.0;
}

}  // namespace nacre::tester
