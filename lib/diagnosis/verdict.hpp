#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/bootstrap.hpp"
#include "diagnosis/diagnosis.hpp"
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
  Observations& observations;  ///< with what numerics leave, shared directions included
  const DiagnosisSettings& settings;
  Anchor base;
  std::vector<std::string> effects;        ///< candidates, in the order of the library
  std::vector<FittedModel> singles;        ///< one per effect
  std::vector<ModelPoint> discretisation;  ///< models whose change with finer elements the shared directions are
  DrawStatistics base_statistics;
  std::vector<DrawStatistics> base_draws;
};

/// What was decided: models that stay possible, the best first; empty with `base_sufficient` and `unexplained`.
struct Decision {
  Verdict verdict = Verdict::base_sufficient;
  std::vector<FittedModel> possible;
  std::optional<FittedModel> partial;  ///< best model of an unexplained misfit
  std::vector<double> p_fit;  ///< per effect: chance of a misfit as large when base + effect is true; 1 where no name
                              ///< was in question, 0 too far behind the best to be tested
  std::vector<double> p_family_wise;  ///< per effect
  double p_misfit = 1.0;
  double p_outside = 1.0;  ///< chance that a cause outside the library would lead to a name as surely (outsider.hpp); 1
                           ///< when not tested
  std::vector<Contrast> contrasts;  ///< of the base model's residuals, strongest first
  std::size_t loudest_part = 0;     ///< of the rows, that the base is farthest off from (Anchor::parts)
  std::string reason;               ///< the step that decided, in words
};

/// Fits base and single effects and bootstraps the base: steps 2 to 6 of the procedure. With a floor that has a common
/// direction the fits are done first with independent layouts and again with the directions along which finer elements
/// move these models.
Evidence gather_evidence(Workbench& workbench, const DiagnosisSettings& settings);

/// Signatures of every effect on top of a fitted model, at these shares of its range.
std::vector<Signature> signatures_on(const FeatureModel& model, const FittedModel& anchor,
                                     const std::vector<std::string>& effects, std::span<const double> sizes = kSizes);

/// Start of a joint fit of a fitted model and one effect more: the size of its signature that lowers the misfit most.
Eigen::VectorXd best_initial_guess(const FeatureModel& model, const Observations& observations,
                                   const FittedModel& anchor, const Signature& signature);

/// The one that leaves less.
FittedModel better_of(FittedModel a, FittedModel b);

/// What finer elements change along the shared directions of the evidence in the rows of `model`, one standard
/// deviation each, rows x directions: at the base, and by how much otherwise where an effect of the material is true.
/// Each has a factor of its own, because an effect that smooths or sharpens a layout changes what its elements cost.
Eigen::MatrixXd shared_directions(const Evidence& evidence, const FeatureModel& model);

/// These coordinates, base constants where the search for the base began.
Eigen::VectorXd at_first_constants(const Evidence& evidence, Eigen::VectorXd u);

/// A model that explains much of the base's misfit is fitted once more from the constants where the search for the base
/// began: a base that bent itself towards the data may stand behind a hill, with constants on their bounds. So are
/// coupons' curves behind much slack: what acts in the measurement and stays far off begins at a promising size. The
/// best of all.
FittedModel restarted(const Evidence& evidence, FittedModel fit);

/// Rows with what finer elements change at this model, in place of what they change at the base and all its rivals.
Observations with_discretisation_at(const Evidence& evidence, const CoordinateMap& map, const Eigen::VectorXd& u);

/// A model fitted with its own numerics.
struct ProfileFit {
  FittedModel fit;
  double deviance = 0.0;  ///< -2 log likelihood of the data, up to a constant; prior of the base constants included
};

/// Fits with the numerics of where it starts, and once more with those of where that ended; what is `hopeless` after
/// the first is left at that. Coordinates that are `held` stay.
ProfileFit fit_with_own_discretisation(const Evidence& evidence, const std::vector<std::string>& effects,
                                       const Eigen::VectorXd& start, const std::vector<int>& held = {},
                                       double hopeless = std::numeric_limits<double>::infinity());

/// Steps 7 and 8: select, keep the set of models that the data cannot tell apart, or say that none fits. A single
/// effect that fits better from where a pair ended is replaced in the evidence.
Decision decide(Evidence& evidence);

}  // namespace nacre::diagnosis
