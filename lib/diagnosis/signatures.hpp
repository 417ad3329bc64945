#pragma once
// Signatures of effects on top of a fitted model.

#include <Eigen/Dense>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/fit.hpp"

namespace nacre::diagnosis {

/// Signature of an effect: the change of all predictions by adding it to an anchor model, at several effect sizes.
struct Signature {
  std::string effect;
  Eigen::MatrixXd changes;  ///< rows x sizes
  bool one_sided = false;   ///< the parameter cannot be negative
};

/// Signatures of every effect on top of a fitted model, at these shares of its range.
std::vector<Signature> signatures_on(const FeatureModel& model, const FittedModel& anchor,
                                     const std::vector<std::string>& effects, std::span<const double> sizes);

/// Initial guess of a joint fit of a fitted model and one effect more: the size of its signature that lowers the misfit
/// most.
Eigen::VectorXd best_initial_guess(const FeatureModel& model, const Observations& observations,
                                   const FittedModel& anchor, const Signature& signature, const FitRules& rules);

}  // namespace nacre::diagnosis
