#pragma once
// The discretisation error that moduli of layouts share, and models fitted with their own.

#include <limits>
#include <string>
#include <vector>

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Changes by a refined mesh along the shared directions of the evidence in the rows of `model`, one standard deviation
/// each, rows x directions: at the base, and the difference from it where an effect of the material is true. Each has a
/// factor of its own, because an effect that smooths or sharpens a layout changes its discretisation error.
Eigen::MatrixXd shared_directions(const Evidence& evidence, const FeatureModel& model);

/// Rows with the change of this model on a refined mesh, in place of the changes of the base and all its rivals.
Observations with_discretisation_at(const Evidence& evidence, const CoordinateMap& map, const Eigen::VectorXd& u);

/// A model fitted with its own discretisation error.
struct ProfileFit {
  FittedModel fit;
  double deviance = 0.0;  ///< -2 log likelihood of the data, up to a constant; prior of the base constants included
};

/// Fits with the discretisation error at the start, and once more with that at the end of this fit; where the first
/// deviance is `hopeless` it is left at that. Coordinates that are `held` stay.
ProfileFit fit_with_own_discretisation(const Evidence& evidence, const std::vector<std::string>& effects,
                                       const Eigen::VectorXd& start, const std::vector<int>& held = {},
                                       double hopeless = std::numeric_limits<double>::infinity());

}  // namespace nacre::diagnosis
