#pragma once
// The one search for the optimum of a model: descents from a list of starts.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/fit.hpp"
#include "diagnosis/signatures.hpp"

namespace nacre::diagnosis {

/// A place where a descent may begin.
struct Start {
  StartKind kind = StartKind::centre;
  /// Coordinates there, given the best fit so far (none before the first descent).
  std::function<Eigen::VectorXd(const FittedModel* best)> u;
  std::optional<double> promise = {};  ///< chi squared that is reached there, or was with an effect more
};

/// The best of descents (fit_model) from these starts, in their order. Where a start promises a chi squared, it is
/// tried when that lies below the best by more than FitRules::converged; any other, unless noise explains the best
/// already (chi squared of at most rows + FitRules::noise_sd sqrt(2 rows)) or the descent before lowered it by less
/// than FitRules::better. `known`: a fit of this model that counts as the first descent.
FittedModel global_fit(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                       const std::vector<std::string>& effects, const std::vector<Start>& starts,
                       std::optional<FittedModel> known = std::nullopt);

/// Base constants at the centre of the search, effects as in the best fit so far; of an effect of the machine, which
/// costs no simulation, that of some larger sizes too, whichever fits best there.
Start at_centre(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                const std::vector<std::string>& effects);

/// Where a fit of the same model ended under another covariance or emulator.
Start at_earlier(const FittedModel& fit);

/// Where a model with an effect more ended: what it gains must not be better optimisation.
Start at_relative(const FittedModel& richer, Eigen::Index coordinates);

/// All starts of an anchor and one effect more: the size of its signature that lowers the misfit most; the centre; the
/// anchor itself, with the effect at zero.
std::vector<Start> starts_on(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                             const FittedModel& anchor, const Signature& signature);

}  // namespace nacre::diagnosis
