#pragma once
// System identification (thesis 2.3.2): parameters that make the testers agree with measurements. Ask and tell, so that
// the simulations may run on the farm or in this process.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "material/ranges.hpp"
#include "measurement/summary.hpp"
#include "thesis/constants.hpp"

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

/// How eta is searched (docs/studies/calibration compares them at equal simulations).
enum class ToughnessSearch {
  posterior,     ///< most probable parameters by an emulator of features that averages over the testers' jumps
  emulator,      ///< smallest objective (2.8) by the same emulator, which trusts the best evaluation
  gauss_newton,  ///< least squares of the features, slopes by finite differences
  bayesian,      ///< batch Bayesian optimisation of the objective, as the thesis does
  trust_region,  ///< NLopt's BOBYQA and Nelder-Mead on the objective
  random,
  direct_l,
  crs2,
  cma_es,
};
std::string_view to_string(ToughnessSearch search);
/// Whether the seed decides where a search goes: several of one that does not are all the same.
bool draws(ToughnessSearch search);
Result<ToughnessSearch> toughness_search_from_string(std::string_view name);

/// What remains between two numerics of one truth, so between any laboratory and the testers, beside scatter and
/// physics: standard deviations of natural logarithms, per design (after parameters have taken over what they can) and
/// common to all designs. `trend`: growing along the rigid fraction.
struct DiscretisationFloor {
  double log_modulus_sd = 0.006, log_toughness_sd = 0.22, log_peak_sd = 0.10;
  double log_modulus_common_sd = 0.06, log_toughness_common_sd = 0.27, log_peak_common_sd = 0.10;
  double log_modulus_trend_sd = 0.024;  ///< over the designs: thin soft joints are computed softer than thick ones
  double log_toughness_trend_sd = 0.05, log_peak_trend_sd = 0.07;  ///< per 0.1 of rigid fraction
  /// Of eta's parameters: another mesh needs others to break alike, beyond what the above say.
  material::ToughnessVector log_eta_sd = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1.7};
  /// No floor at all: residuals are scatter or physics.
  static DiscretisationFloor none();
};
/// From data/discretisation_floor.toml, the table of this fidelity; what the table lacks keeps its default. Throws
/// InputError.
DiscretisationFloor read_discretisation_floor(const std::filesystem::path& file, tester::Fidelity fidelity);

struct CalibrationSettings {
  material::FitTarget target = material::FitTarget::microstructures;
  material::ParameterRanges ranges = material::thesis_ranges();  ///< no fitted parameter leaves them
  material::ParameterSet start;  ///< where to begin; its extensions are kept as they are
  std::vector<material::ParameterSet>
      other_starts;                       ///< beside it in the first batch for eta; empty: chosen in the ranges
  int modulus_budget = 120;               ///< evaluations of the modulus set; 0 keeps theta
  int toughness_budget = 25;              ///< evaluations of the toughness set, of each search; 0 keeps eta
  int batch = thesis::kCalibrationBatch;  ///< parameter sets asked for at once (a Jacobian of the modulus fit: six)
  ToughnessSearch toughness_search = ToughnessSearch::posterior;
  int searches = 1;  ///< for eta, side by side, each with a seed of its own; the best is kept and their spread reported
  int ensemble_size = 0;  ///< further parameter sets drawn from what the data leave possible
  DiscretisationFloor floor;
  std::vector<double> weights;  ///< of the measured designs in place of (2.9)-(2.11), above 0, at most 1: a weight of
                                ///< 0.1 counts as a tenth of a design
  std::uint64_t seed = 1;
};

/// One evaluation wanted: the tests named, of all `items`, with these parameters.
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
  bool operator==(const ParameterEstimate&) const = default;
};

/// A simulated fracture test that ended at its strain limit (thesis 2.3.1; pure soft specimens have none that counts):
/// its toughness is the area until there.
bool is_unbroken(const Prediction& prediction, const pattern::Design& design);

/// Whether residuals are of the size that replicates and the numerics floor explain.
struct GoodnessOfFit {
  int count = 0;    ///< designs; 0: nothing to judge
  int freedom = 0;  ///< designs less the degrees of freedom that the fit took from them; 0: less than one, not tested
  double chi_squared = 0.0;  ///< squared residuals of log E or log T over their variances, the floor included
  double chi_squared_replicates = 0.0;  ///< the same against the scatter of replicates alone
  double p_value = 1.0;                 ///< chance of so large a chi squared when the model is right; 1 when not tested
  bool tested() const { return freedom > 0; }
  bool misfit() const { return count > 0 && p_value < 0.01; }
  bool operator==(const GoodnessOfFit&) const = default;
};

/// Where parameters come from and how far they can be trusted: what goes out with them.
struct Provenance {
  std::string search;  ///< `base_materials`, `begun_with` (nothing was fitted), or how eta was searched
  double modulus_objective = 0.0, toughness_objective = 0.0;  ///< (2.8) of these parameters on their calibration set
  GoodnessOfFit modulus_fit, toughness_fit;
  std::vector<ParameterEstimate> estimates;
  bool operator==(const Provenance&) const = default;
};

/// Result of a calibration.
struct Calibrated {
  material::ParameterSet parameters;
  PredictionErrors before, after;  ///< of `start` and of `parameters`, on the calibration set
  double modulus_objective_before = 0.0, modulus_objective_after = 0.0;
  double toughness_objective_before = 0.0, toughness_objective_after = 0.0;
  std::vector<Prediction> predictions;  ///< of `parameters`, per measured design
  /// All of theta and eta, in the order of their vectors. Intervals hold near the optimum (a linear model of the
  /// residuals, in which misfit counts as noise). From BaseCalibration whole ranges, none determined.
  std::vector<ParameterEstimate> estimates;
  /// Objective of every parameter set evaluated, in order: how the search converged. None from BaseCalibration.
  std::vector<double> modulus_objectives, toughness_objectives;
  /// -2 log likelihood of E and T with replicate covariance and floor, constants left out: what (2.8) does not weigh.
  double modulus_deviance = 0.0, toughness_deviance = 0.0;
  GoodnessOfFit modulus_fit, toughness_fit;
  /// Smallest toughness objective of each search, when there were several.
  std::vector<double> search_objectives;
  /// Sets drawn from what the data leave possible, `parameters` not among them: the spread of their predictions is the
  /// uncertainty of a prediction, and their mean averages over the jumps of single fracture simulations.
  std::vector<material::ParameterSet> ensemble;
  int simulations = 0;
};

Provenance provenance_of(const Calibrated& calibrated, std::string_view search);

/// The parameters that stand exactly at an end of their range, those that the data determine first: they would
/// go further, and may push the others aside.
std::vector<ParameterEstimate> at_an_end(const Calibrated& calibrated, const material::ParameterRanges& ranges,
                                         material::FitTarget target);

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

/// Whether a design is soft, rigid or interface alone: what BaseCalibration fits.
bool is_base_material(const pattern::Design& design);

/// Round 0 (thesis 3.2): each of soft, rigid and interface is fitted by itself, to the parameters that it depends on,
/// at a damping that suits all three; when there is none, the one at which the worst of them misses least. (The thesis
/// keeps the median of three separate estimates; thresholds fitted at another damping then miss.) Same protocol as
/// Calibration; toughness_budget is per material, over all dampings.
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
