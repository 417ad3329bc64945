#pragma once
// One half of a calibration: the search for theta or for eta, by ask and tell over the unit cube of its ranges.

#include <memory>
#include <span>
#include <vector>

#include "optimize/batch_optimizer.hpp"
#include "sysid/calibration.hpp"
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

/// What the data tell of one coordinate of a fit's best point.
struct CoordinateInterval {
  double low90 = 0.0, high90 = 1.0;  ///< 90 % interval
  double deviation = 0.0;            ///< standard deviation
};

class ParameterFit {
 public:
  virtual ~ParameterFit() = default;
  /// The points to evaluate next; empty when the fit has ended. The first point ever asked for is the start.
  virtual std::vector<Point> ask() = 0;
  /// Predictions for the points last asked for, in their order; each covers all designs of the data.
  virtual void tell(std::vector<std::vector<Prediction>> predictions) = 0;
  virtual double progress() const = 0;  ///< 0..1
  /// The start, and the best trial so far (penalty included in the comparison); only after the first tell().
  virtual const FitTrial& first() const = 0;
  virtual const FitTrial& best() const = 0;
  /// What fits of one kind and the same data are compared by, the smaller the better.
  virtual double cost() const { return best().objective; }
  /// Everything evaluated, in order.
  virtual const std::vector<FitTrial>& trials() const = 0;
  /// Of every coordinate of best().point; the whole axis where the data tell nothing, or were not asked.
  virtual std::vector<CoordinateInterval> intervals() const = 0;
  /// Degrees of freedom that the fit took from what was measured of E or of T (spread.hpp); 0 when nothing moved.
  virtual double freedom_taken() const { return 0.0; }
  /// Points drawn from what the data leave possible around best().point; empty from fits that cannot tell.
  virtual std::vector<Point> plausible(int /*count*/) const { return {}; }
  /// Objective of the best trial of each search, when there are several side by side.
  virtual std::vector<double> best_objectives() const { return {best().objective}; }
};

struct FitSettings {
  Point start;  ///< also the centre of a weak prior, or of a pull
  int budget = 1;
  int batch = thesis::kCalibrationBatch;
  std::uint64_t seed = 1;
  DiscretisationFloor floor;
};

/// Gauss-Newton steps with Levenberg-Marquardt damping on the residuals log E_simulated - log E_measured in the six
/// dimensions of theta that act (gamma does not, in the static tester). Residuals are reweighted towards the absolute
/// error of (2.8). Jacobian by finite differences: one batch of six evaluations.
std::unique_ptr<ParameterFit> make_modulus_fit(FitData data, const FitSettings& settings);

/// Search for eta with an emulator of features (emulator.hpp): every batch holds the points whose predicted objective,
/// less a share of its uncertainty, is smallest within a trust region around the best trial. Poisson's ratios stay at
/// the start: T hardly depends on them, and a few tens of evaluations cannot tell. `others` are further points to begin
/// with.
std::unique_ptr<ParameterFit> make_emulator_fit(FitData data, const FitSettings& settings,
                                                std::span<const material::ParameterRange> ranges,
                                                std::vector<Point> others);

/// The most probable eta. Residuals of log T and log peak stress are normal, of a variance that is learnt with the
/// floor and the scatter of replicates as its prior, and the start is the centre of a weak prior. Features come from
/// the emulator with jumps averaged out, so that neither search nor answer follow the luck of single fracture
/// simulations: the answer is the trial that is most probable by its neighbours' testimony too. Every batch holds the
/// most probable point of a trust region and draws from what is possible around it.
std::unique_ptr<ParameterFit> make_posterior_fit(FitData data, const FitSettings& settings,
                                                 std::span<const material::ParameterRange> ranges,
                                                 std::vector<Point> others);

/// Gauss-Newton steps with Levenberg-Marquardt damping on log T and log peak stress, slopes by differences that are
/// wide enough to step over the jumps; one batch of seven evaluations each.
std::unique_ptr<ParameterFit> make_gauss_newton_fit(FitData data, const FitSettings& settings);

/// Search for eta by an algorithm that sees objective (2.8) only, in all ten dimensions, begun at the start and
/// `others`; the trust region also at the best of them rescaled by the emulator's prior.
std::unique_ptr<ParameterFit> make_objective_fit(FitData data, const FitSettings& settings,
                                                 std::span<const material::ParameterRange> ranges,
                                                 std::vector<Point> others, optimize::Algorithm algorithm);

/// Several fits side by side, each asked for its own batch; the best trial of all counts.
std::unique_ptr<ParameterFit> make_parallel_fit(std::vector<std::unique_ptr<ParameterFit>> fits);

/// mean((point - start)^2) times `strength`: keeps parameters that the data do not determine where they were.
double pull_to_start(std::span<const double> point, std::span<const double> start, double strength);

}  // namespace nacre::sysid
