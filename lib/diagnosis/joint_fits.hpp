#pragma once
// Base and single effects fitted jointly, restarted where a fit may be caught in a local minimum.

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// The one of smaller chi squared.
FittedModel better_of(FittedModel a, FittedModel b);

/// These coordinates, base constants at the initial guess of the base.
Eigen::VectorXd at_first_constants(const Evidence& evidence, Eigen::VectorXd u);

/// A model that explains much of the base's misfit is restarted from the initial guess of the base: a base that bent
/// itself towards the data may be caught behind a local maximum, with constants at their bounds. So are curves of
/// coupons with much slack: an effect on the measurement that stays far off restarts at a promising size. The best of
/// all.
FittedModel restarted(const Evidence& evidence, FittedModel fit);

/// Shares of the whole work between which a step lies.
struct Stretch {
  double begin = 0.0, end = 1.0;
};

/// The evidence with base and every single effect fitted to its observations, beginning at `start`, and at earlier fits
/// of the effects where it has some.
Evidence with_fits(Evidence evidence, const Eigen::VectorXd& start, Stretch stretch);

}  // namespace nacre::diagnosis
