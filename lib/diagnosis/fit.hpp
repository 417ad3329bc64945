#pragma once
// Weighted least squares over the coordinates u: chi2 = (y - f(u))' C^-1 (y - f(u)) + ((u - 1/2) / prior_sd)^2.

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "diagnosis/model.hpp"

namespace nacre::diagnosis {

/// Where the descent to a fit began (global_fit.hpp).
enum class StartKind { centre, earlier, signature, anchor, relative };

/// A model fitted to observations by weighted least squares, with its local linearisation. The base coordinates carry a
/// wide Gaussian prior about the middle of their ranges, so that parameters that the data do not determine stay put.
struct FittedModel {
  std::vector<std::string> effects;  ///< extensions fitted with the base; empty: the base model
  int base_count = 0;                ///< coordinates that are base constants: the first ones
  Eigen::VectorXd prior_sd;          ///< of the base coordinates, about their middle 0.5
  Eigen::VectorXd u;                 ///< coordinates of the optimum (CoordinateMap)
  Eigen::VectorXd lower, upper;      ///< their bounds
  material::ParameterSet parameters;
  Eigen::VectorXd predicted;  ///< per row
  Eigen::MatrixXd jacobian;   ///< rows x coordinates
  std::vector<int> free;      ///< coordinates that may move; the others are held by a bound that they would leave
  double chi2 = 0.0;          ///< weighted sum of squares, prior included
  StartKind from = StartKind::centre;
  bool extension_on_bound = false;  ///< an extension parameter is at its bound (zero does not count)
  /// Of the prior at coordinates of this model.
  double prior_chi2(const Eigen::VectorXd& at) const;
  void free_all();  ///< every coordinate may move, also one at its bound
  /// Whitened columns of the free coordinates: rows, then those of the prior.
  Eigen::MatrixXd whitened_columns(const Whitener& whitener) const;
  /// Whitened residual of data: rows, then those of the prior.
  Eigen::VectorXd whitened_residual(const Eigen::VectorXd& y, const Whitener& whitener) const;
  /// The same fit over some of its rows.
  FittedModel restricted(const std::vector<Eigen::Index>& rows) const;
  /// Variance of one coordinate; 0 when it is held.
  double variance(int coordinate, const Whitener& whitener) const;
};

/// Levenberg-Marquardt from `start` (coordinates of the map for `effects`), inside the bounds, on the local model of
/// the points it passed (local_model.hpp), damped as Nielsen's (IMM-REP-1999-05). Slopes and one or two predictions of
/// all rows an iteration. Coordinates that are `held` stay where they start.
FittedModel fit_model(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                      const std::vector<std::string>& effects, const Eigen::VectorXd& start,
                      const std::vector<int>& held = {});

/// Initial guess of a model with one effect more than `fit` has: the same coordinates, the new effect at zero, its
/// further parameters at their usual values.
Eigen::VectorXd widened_start(const FittedModel& fit, const CoordinateMap& map);

/// Base and effects at given coordinates, with the linearisation there and every coordinate free; chi2 is not computed.
FittedModel linearised(const FeatureModel& model, const std::vector<std::string>& effects, const Eigen::VectorXd& u);

/// The smallest weighted sum of squares that the linearised fit reaches on other data: min over delta of
/// |y - predicted - J delta|^2, whitened, + prior, over the free coordinates inside their bounds. `delta` returns the
/// minimiser when wanted. `effect_sd`: of a prior of the effects' coordinates about where they are; none where empty.
double linear_refit(const FittedModel& fit, const Eigen::VectorXd& y, const Whitener& whitener,
                    Eigen::VectorXd* delta = nullptr, const Eigen::VectorXd& effect_sd = {});

}  // namespace nacre::diagnosis
