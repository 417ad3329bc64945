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
  Eigen::MatrixXd changes;         ///< rows x sizes, the negative ones of a two-sided effect behind the positive
  Eigen::MatrixXd elsewhere = {};  ///< rows x values: at usual size, with other values of further parameters (a time)
  std::vector<Eigen::VectorXd> at_elsewhere = {};  ///< the effect's own coordinates there
  bool one_sided = false;                          ///< the parameter cannot be negative
};

/// Signatures of every effect on top of a fitted model, at these shares of its range.
std::vector<Signature> signatures_on(const FeatureModel& model, const FittedModel& anchor,
                                     const std::vector<std::string>& effects, std::span<const double> sizes);

/// The change by an effect of usual size, the index `usual` of its sizes: of its further parameters those values that
/// leave most beyond the anchor.
Eigen::VectorXd usual_change(const Signature& signature, int usual, const FittedModel& anchor,
                             const Whitener& whitener);

/// Initial guess of a joint fit of a fitted model and one effect more: the size of its signature that lowers the misfit
/// most.
Eigen::VectorXd best_initial_guess(const FeatureModel& model, const Observations& observations,
                                   const FittedModel& anchor, const Signature& signature, const FitRules& rules);

}  // namespace nacre::diagnosis
