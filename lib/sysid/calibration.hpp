#pragma once
// System identification (thesis 2.3.2): parameters that make the testers agree with measurements. Ask and tell, so that
// the simulations may run on the farm or in this process.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "material/parameters.hpp"
#include "measurement/measurement.hpp"
#include "tester/tester.hpp"

namespace nacre::sysid {

/// Relative errors over a set of designs (the figures of Tables 3.5, A.3, A.4). A count of 0: nothing to compare,
/// errors 0.
struct PredictionErrors {
  int modulus_count = 0;
  double modulus_mean = 0.0, modulus_max = 0.0;
  int toughness_count = 0;
  double toughness_mean = 0.0, toughness_max = 0.0;
  double toughness_spearman = 0.0;  ///< 0 below three designs
  bool operator==(const PredictionErrors&) const = default;
};

/// What a tester said about one design; each part only when it was asked for and succeeded.
struct Prediction {
  std::optional<double> modulus_pa;
  std::optional<double> toughness_pa;
  tester::Curve curve;
};

/// Errors of predictions[i] on measured[i]; measurement-side extensions must already be in the predictions.
PredictionErrors prediction_errors(const std::vector<measurement::Replicates>& measured,
                                   const std::vector<Prediction>& predictions);

/// Sample weights w1 w2 (Eqs. 2.9-2.11) of measured designs that have both E and T; designs with one of them get
/// weight 1.
std::vector<double> sample_weights(const std::vector<measurement::Replicates>& measured);

/// Modulus part of objective (2.8), divided by the sum of weights: 0.1 means 10 % weighted mean error.
double modulus_objective(const std::vector<measurement::Replicates>& measured, const std::vector<double>& weights,
                         const std::vector<Prediction>& predictions);
/// Toughness part of (2.8) with lambda~ = 1, divided by the sum of weights; the curve term only where a curve was
/// measured.
double toughness_objective(const std::vector<measurement::Replicates>& measured, const std::vector<double>& weights,
                           const std::vector<Prediction>& predictions);

/// How eta is searched: by an emulator of T and peak stress per design, or by NLopt's algorithms on the objective alone
/// (docs/studies/calibration-first.md compares them).
enum class ToughnessSearch { emulator, nlopt };

struct CalibrationSettings {
  material::FitTarget target = material::FitTarget::microstructures;
  material::ParameterSet start;  ///< where to begin; its extensions are kept as they are
  int modulus_budget = 120;      ///< evaluations of the modulus set; 0 keeps theta
  int toughness_budget = 25;     ///< evaluations of the toughness set; 0 keeps eta
  int batch = 3;                 ///< parameter sets asked for at once (a Jacobian of the modulus fit: six)
  ToughnessSearch toughness_search = ToughnessSearch::emulator;
  std::uint64_t seed = 1;
};

/// One evaluation wanted: the `tests` of all `designs` with these parameters.
struct WantedEvaluation {
  std::string id;  ///< unique within the calibration
  material::ParameterSet parameters;
  bool modulus = false;
  bool toughness = false;
  std::vector<std::size_t> items;  ///< indices into the measured designs
};

/// What the calibration says of one parameter.
struct ParameterEstimate {
  std::string name;  ///< `modulus.e_tb_pa`, `toughness.w_if_j_per_m3`, ...
  double value = 0.0;
  double low90 = 0.0, high90 = 0.0;  ///< 90 % interval; the whole range when the parameter is not determined
  bool determined = false;           ///< the data narrow the parameter to less than half of what its range alone says
};

/// Result of a calibration.
struct Calibrated {
  material::ParameterSet parameters;
  PredictionErrors before, after;  ///< of `start` and of `parameters`, on the calibration set
  double modulus_objective_before = 0.0, modulus_objective_after = 0.0;
  double toughness_objective_before = 0.0, toughness_objective_after = 0.0;
  std::vector<Prediction> predictions;  ///< of `parameters`, per measured design
  /// All of theta and eta, in the order of their vectors. Intervals hold near the optimum (a linear model of the
  /// residuals, in which misfit counts as noise). None from BaseCalibration.
  std::vector<ParameterEstimate> estimates;
  /// Objective of every parameter set evaluated, in order: how the search converged. None from BaseCalibration.
  std::vector<double> modulus_objectives, toughness_objectives;
  int simulations = 0;
};

/// A calibration in progress. Deterministic in its settings and in what it was told.
class Calibration {
 public:
  Calibration(std::vector<measurement::Replicates> measured, const CalibrationSettings& settings);
  ~Calibration();
  Calibration(Calibration&&) noexcept;
  Calibration& operator=(Calibration&&) noexcept;
  /// Evaluations wanted next; empty when finished. The same answer until tell() has received them all.
  const std::vector<WantedEvaluation>& wanted() const;
  /// Predictions of wanted()[index], one per item of it, in order. Measurement-side extensions are applied here.
  void tell(std::size_t index, const std::vector<Prediction>& predictions);
  bool finished() const;
  double progress() const;  ///< 0..1
  const Calibrated& result() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Round 0 (thesis 3.2): each of soft, rigid and interface is fitted by itself, to the parameters that it depends on,
/// at a damping that suits all three; when there is none, the one at which the worst of them misses least. (The thesis
/// keeps the median of three separate estimates; thresholds fitted at another damping then miss.) Same protocol as
/// Calibration; toughness_budget is per material and damping.
class BaseCalibration {
 public:
  BaseCalibration(std::vector<measurement::Replicates> base_materials, const CalibrationSettings& settings);
  ~BaseCalibration();
  BaseCalibration(BaseCalibration&&) noexcept;
  BaseCalibration& operator=(BaseCalibration&&) noexcept;
  const std::vector<WantedEvaluation>& wanted() const;
  void tell(std::size_t index, const std::vector<Prediction>& predictions);
  bool finished() const;
  double progress() const;
  const Calibrated& result() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre::sysid
