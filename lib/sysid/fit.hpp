#pragma once
// One half of a calibration: the search for theta or for eta, by ask and tell over the unit cube of its ranges.

#include <memory>
#include <span>
#include <vector>

#include "optimize/batch_optimizer.hpp"
#include "sysid/calibration.hpp"

namespace nacre::sysid {

using optimize::Point;

/// What a fit compares with: the measured designs that its test covers, with their weights.
struct FitData {
  std::vector<measurement::Replicates> measured;
  std::vector<double> weights;
};

/// One parameter set and what it predicts, measurement-side extensions applied; `objective` is that of (2.8) without
/// penalty.
struct Trial {
  Point point;
  std::vector<Prediction> predictions;  ///< of FitData::measured, in order
  double objective = 0.0;
};

class Fit {
 public:
  virtual ~Fit() = default;
  /// The points to evaluate next; empty when the fit has ended. The first point ever asked for is the start.
  virtual std::vector<Point> ask() = 0;
  /// Predictions for the points last asked for, in their order; each covers all designs of the data.
  virtual void tell(std::vector<std::vector<Prediction>> predictions) = 0;
  virtual double progress() const = 0;  ///< 0..1
  /// The start, and the best trial so far (penalty included in the comparison); only after the first tell().
  virtual const Trial& first() const = 0;
  virtual const Trial& best() const = 0;
  /// Everything evaluated, in order.
  virtual const std::vector<Trial>& trials() const = 0;
  /// Standard deviation of every coordinate of best().point as far as the data tell it (spread.hpp); kUnknownDeviation
  /// where they do not, or were not asked.
  virtual std::vector<double> deviations() const = 0;
};

struct FitSettings {
  Point start;
  int budget = 1;
  int batch = 3;
  std::uint64_t seed = 1;
};

/// Gauss-Newton steps with Levenberg-Marquardt damping on the residuals log E_simulated - log E_measured in the six
/// dimensions of theta that act (gamma does not, in the static tester). Residuals are reweighted towards the absolute
/// error of (2.8). Jacobian by finite differences: one batch of six evaluations.
std::unique_ptr<Fit> make_modulus_fit(FitData data, const FitSettings& settings);

/// Search for eta with an emulator of features (emulator.hpp): every batch holds the points whose predicted objective,
/// less a share of its uncertainty, is smallest within a trust region around the best trial. Poisson's ratios stay at
/// the start: T hardly depends on them, and a few tens of evaluations cannot tell. `others` are further points to begin
/// with.
std::unique_ptr<Fit> make_emulator_fit(FitData data, const FitSettings& settings,
                                       std::span<const material::ParameterRange> ranges, std::vector<Point> others);

/// Search for eta by optimize::make_nlopt_optimizer in all ten dimensions, begun at the start, `others` and the best of
/// them rescaled by the emulator's prior.
std::unique_ptr<Fit> make_nlopt_fit(FitData data, const FitSettings& settings,
                                    std::span<const material::ParameterRange> ranges, std::vector<Point> others);

/// mean((point - start)^2) times `strength`: keeps parameters that the data do not determine where they were.
double pull_to_start(std::span<const double> point, std::span<const double> start, double strength);

}  // namespace nacre::sysid
