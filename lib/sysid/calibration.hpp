#pragma once
// System identification (thesis 2.3.2): parameters that make the testers agree with measurements.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "material/ranges.hpp"
#include "measurement/summary.hpp"
#include "sysid/calibration_protocol.hpp"
#include "sysid/discretisation_floor.hpp"
#include "sysid/errors.hpp"
#include "sysid/likelihood.hpp"
#include "sysid/prediction.hpp"
#include "sysid/strength_variation.hpp"
#include "sysid/toughness_search.hpp"
#include "thesis/constants.hpp"

namespace nacre::sysid {

struct CalibrationSettings {
  material::FitTarget target = material::FitTarget::microstructures;
  material::ParameterRanges ranges = material::default_ranges();  ///< no fitted parameter leaves them
  material::ParameterSet start;                      ///< initial guess; its extensions are kept as they are
  std::vector<material::ParameterSet> other_starts;  ///< further initial guesses for eta, in its first batch; empty:
                                                     ///< chosen in the ranges
  int modulus_budget = 120;                          ///< evaluations of the modulus set; 0 keeps theta
  int toughness_budget = 25;                         ///< evaluations of the toughness set, of each search; 0 keeps eta
  int batch = thesis::kCalibrationBatch;  ///< parameter sets asked for at once (a Jacobian of the modulus fit: six)
  ToughnessSearch toughness_search = ToughnessSearch::posterior;
  int searches = 1;  ///< for eta, side by side, each with a seed of its own; the best is kept and their spread reported
  bool strength_variation = true;  ///< first fit strength_cv to the scatter of replicates, where eta is fitted and the
                                   ///< start has any: breaks kScatterSpecimens of every replicated design
  int ensemble_size = 0;           ///< further parameter sets drawn from what the data leave possible
  DiscretisationFloor floor;
  std::vector<double> weights;  ///< of the measured designs in place of (2.9)-(2.11), above 0, at most 1: a weight of
                                ///< 0.1 counts as a tenth of a design
  std::uint64_t seed = 1;
};

/// The fitted value of one parameter and its interval.
struct ParameterEstimate {
  std::string name;  ///< `modulus.e_tb_pa`, `toughness.w_if_j_per_m3`, ...
  double value = 0.0;
  double low90 = 0.0, high90 = 0.0;  ///< 90 % interval; the whole range when the parameter is not determined
  bool determined = false;           ///< its 90 % interval is less than half of the one that its range alone gives
  bool operator==(const ParameterEstimate&) const = default;
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
  std::optional<StrengthVariation> strength_variation;  ///< where it was fitted
  /// Smallest toughness objective of each search, when there were several.
  std::vector<double> search_objectives;
  /// Sets drawn from what the data leave possible, `parameters` not among them: the spread of their predictions is the
  /// uncertainty of a prediction, and their mean averages over the jumps of single fracture simulations.
  std::vector<material::ParameterSet> ensemble;
  int simulations = 0;
};

/// Specimens of a design that tell its scatter, at each of two variations of strength.
inline constexpr int kScatterSpecimens = 3;

/// Of designs whose microstructures were measured.
class Calibration final : public CalibrationProtocol {
 public:
  Calibration(std::vector<measurement::Replicates> measured, const CalibrationSettings& settings);
  ~Calibration() override;
  Calibration(Calibration&&) noexcept;
  Calibration& operator=(Calibration&&) noexcept;
  const std::vector<WantedEvaluation>& wanted() const override;
  void tell(std::size_t index, const std::vector<Prediction>& predictions) override;
  double progress() const override;
  const Calibrated& result() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre::sysid
