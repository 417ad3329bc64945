#pragma once
// One half of a calibration: the search for theta or for eta, by ask and tell over the unit cube of its ranges.

#include <cstdint>
#include <span>
#include <vector>

#include "measurement/summary.hpp"
#include "optimize/batch_optimizer.hpp"
#include "sysid/discretisation_floor.hpp"
#include "sysid/prediction.hpp"
#include "thesis/constants.hpp"

namespace nacre::sysid {

using optimize::Point;

/// What a fit compares with: the measured designs that its test covers, with their weights.
struct FitData {
  std::vector<measurement::Replicates> measured;
  std::vector<double> weights;
  std::vector<double> evidence = {};  ///< how much of a design each counts as in the likelihood; empty: 1
};

/// One parameter set and what it predicts, measurement-side extensions applied; `objective` is that of (2.8) without
/// penalty.
struct FitTrial {
  Point point;
  std::vector<Prediction> predictions;  ///< of FitData::measured, in order
  double objective = 0.0;
};

/// Interval of one coordinate of a fit's best point, given the data.
struct CoordinateInterval {
  double low90 = 0.0, high90 = 1.0;  ///< 90 % interval
  double deviation = 0.0;            ///< standard deviation
};

/// A search for the parameters of one tester.
class ParameterFit {
 public:
  virtual ~ParameterFit() = default;
  /// The points to evaluate next; empty when the fit has ended. The first point ever asked for is the initial guess.
  virtual std::vector<Point> ask() = 0;
  /// Predictions for the points last asked for, in their order; each covers all designs of the data.
  virtual void tell(std::vector<std::vector<Prediction>> predictions) = 0;
  virtual double progress() const = 0;  ///< 0..1
  /// The initial guess, and the best trial so far (penalty included in the comparison); only after the first tell().
  virtual const FitTrial& first() const = 0;
  virtual const FitTrial& best() const = 0;
  /// By which fits of one kind and the same data are compared, the smaller the better.
  virtual double cost() const { return best().objective; }
  /// Everything evaluated, in order.
  virtual const std::vector<FitTrial>& trials() const = 0;
  /// Of every coordinate of best().point; the whole axis where the data say nothing, or were not asked.
  virtual std::vector<CoordinateInterval> intervals() const = 0;
  /// Degrees of freedom that the fit took from the measured E or T (spread.hpp); 0 when nothing moved.
  virtual double freedom_taken() const { return 0.0; }
  /// Points drawn from what the data leave possible around best().point; empty from fits that cannot tell.
  virtual std::vector<Point> plausible(int /*count*/) const { return {}; }
  /// Objective of the best trial of each search, when there are several side by side.
  virtual std::vector<double> best_objectives() const { return {best().objective}; }
};

struct FitSettings {
  Point start;  ///< initial guess; also the centre of a weak prior, or of a pull
  int budget = 1;
  int batch = thesis::kCalibrationBatch;
  std::uint64_t seed = 1;
  DiscretisationFloor floor;
};

/// mean((point - start)^2) times `strength`: keeps parameters that the data do not determine where they were.
inline double pull_to_start(std::span<const double> point, std::span<const double> start, double strength) {
  double sum = 0.0;
  for (std::size_t j = 0; j < point.size(); ++j) sum += (point[j] - start[j]) * (point[j] - start[j]);
  return point.empty() ? 0.0 : strength * sum / static_cast<double>(point.size());
}

}  // namespace nacre::sysid
