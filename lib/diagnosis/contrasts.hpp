#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "diagnosis/observations.hpp"

namespace nacre::diagnosis {

/// A pre-declared feature of specimens along which residuals may line up; one value per group, mean 0 and length 1.
struct ContrastDirection {
  std::string name;
  Eigen::VectorXd values;
};

/// All contrasts that vary over these specimens: rigid fraction, interface length along and across the load, run length of either
/// phase, corner contacts, percolation of the rigid phase, orientation, rate, thickness, print order and
/// stiffness level (`predicted`, log E of the base fit).
std::vector<ContrastDirection> contrast_directions(const Observations& observations, const Eigen::VectorXd& predicted);

}  // namespace nacre::diagnosis
