#include "tester/failure_criterion.hpp"

namespace nacre::tester {

void set_criterion(fem::Grid& grid, int refinement, const material::FailureCriterion& criterion) {
  if (criterion.kind == material::CriterionKind::element) return;
  for (double& threshold : grid.threshold_j_per_m3) threshold /= refinement;
  double& softening = grid.laws.softening;
  if (criterion.kind == material::CriterionKind::neighbourhood) {
    grid.neighbourhood_m = criterion.radius_m;
  } else {
    grid.laws.is_crack_band = true;
    softening += criterion.softening;
  }
  if (softening > 0.0) softening = (1.0 + softening) * refinement - 1.0;
}

}  // namespace nacre::tester
