#pragma once
// The evidence of a decision: base model and base + one effect, fitted jointly, and bootstrap draws of the base. Chi
// squared r' C^-1 r with the covariance C of scatter, discretisation floor and emulator.

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/bootstrap.hpp"
#include "diagnosis/fit.hpp"
#include "diagnosis/settings.hpp"
#include "diagnosis/workbench.hpp"

namespace nacre::diagnosis {

/// A model at some of its coordinates.
struct ModelPoint {
  std::vector<std::string> effects;
  Eigen::VectorXd u;
};

/// Everything the decision rests on: the base model, every effect (and pair, when needed) fitted jointly with it.
struct Evidence {
  const FeatureModel& model;
  Observations& observations;  ///< with their discretisation error, shared directions included
  const DiagnosisSettings& settings;
  Anchor base;
  std::vector<std::string> effects;        ///< candidates, in the order of material::effect_library()
  std::vector<FittedModel> singles;        ///< one per effect
  std::vector<ModelPoint> discretisation;  ///< models whose change on a refined mesh gives the shared directions
  DrawStatistics base_statistics;
  std::vector<DrawStatistics> base_draws;
};

/// Fits base and single effects and bootstraps the base: steps 2 to 6 of the procedure. With a floor that has a common
/// direction the fits are done first with independent layouts and again with the directions along which a refined mesh
/// moves these models.
Evidence gather_evidence(Workbench& workbench, const DiagnosisSettings& settings);

/// Signatures of every effect on top of a fitted model, at these shares of its range.
std::vector<Signature> signatures_on(const FeatureModel& model, const FittedModel& anchor,
                                     const std::vector<std::string>& effects, std::span<const double> sizes);

/// Initial guess of a joint fit of a fitted model and one effect more: the size of its signature that lowers the misfit
/// most.
Eigen::VectorXd best_initial_guess(const FeatureModel& model, const Observations& observations,
                                   const FittedModel& anchor, const Signature& signature, const FitRules& rules);

/// The one of smaller chi squared.
FittedModel better_of(FittedModel a, FittedModel b);

/// Changes by a refined mesh along the shared directions of the evidence in the rows of `model`, one standard deviation
/// each, rows x directions: at the base, and the difference from it where an effect of the material is true. Each has a
/// factor of its own, because an effect that smooths or sharpens a layout changes its discretisation error.
Eigen::MatrixXd shared_directions(const Evidence& evidence, const FeatureModel& model);

/// These coordinates, base constants at the initial guess of the base.
Eigen::VectorXd at_first_constants(const Evidence& evidence, Eigen::VectorXd u);

/// A model that explains much of the base's misfit is restarted from the initial guess of the base: a base that bent
/// itself towards the data may be caught behind a local maximum, with constants at their bounds. So are curves of
/// coupons with much slack: an effect on the measurement that stays far off restarts at a promising size. The best of
/// all.
FittedModel restarted(const Evidence& evidence, FittedModel fit);

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
