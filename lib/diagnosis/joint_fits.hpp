#pragma once
// Base and single effects fitted jointly.

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Shares of the whole work between which a step lies.
struct Stretch {
  double begin = 0.0, end = 1.0;
};

/// The evidence with base and every single effect fitted to its observations (global_fit), where it has earlier fits
/// beginning at those.
Evidence with_fits(Evidence evidence, Stretch stretch);

/// These coordinates, base constants at the centre of the search.
Eigen::VectorXd with_constants_at_centre(const FeatureModel& model, Eigen::VectorXd u);

}  // namespace nacre::diagnosis
