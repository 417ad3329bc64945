#pragma once
// Calibration in this process, on all cores: what `nacre calibrate` does.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/read_set.hpp"
#include "sysid/calibration.hpp"
#include "sysid/local_simulator.hpp"

namespace nacre::sysid {

struct OfflineSettings {
  CalibrationSettings calibration;  ///< its seed also chooses the patterns held out
  tester::Fidelity fidelity = tester::Fidelity::full;
  std::optional<tester::Fidelity> begin_at;  ///< a cheaper one that is calibrated first: see calibrate_cheaply_first
  int hold_out = 0;                          ///< whole patterns kept out of the fit
  DiscretisationFloor begin_at_floor;        ///< of `begin_at`
  int threads = 0;                           ///< 0 all allowed cores
  std::filesystem::path
      store;  ///< file that keeps simulations, so that the same calibration goes on from them; empty: none
};

struct OfflineCalibration {
  Calibrated calibrated;
  bool base_materials = false;  ///< the set holds no patterns: round 0, each material by itself
  PredictionErrors before_fitted, before_held_out;
  PredictionErrors after_fitted, after_held_out;
  PredictionErrors ensemble_held_out;         ///< of the mean over `parameters` and the ensemble, when there is one
  std::vector<std::string> fitted, held_out;  ///< names of designs
  std::vector<std::string> left_out;  ///< homogeneous specimens where there are patterns, other mixtures where there
                                      ///< are base materials
  std::vector<measurement::Replicates> measured;  ///< what was fitted, as Calibrated::predictions orders it
  int simulations = 0;                            ///< really done, held-out ones included
  int begun_simulations = 0;                      ///< of OfflineSettings::begin_at
};

/// Called after every simulation with the share done (0..1) and the present step.
using ProgressCallback = std::function<void(double, std::string_view)>;

/// Called with every evaluation and its predictions, one per item, before measurement-side extensions.
using EvaluationObserver = std::function<void(const WantedEvaluation&, const std::vector<Prediction>&)>;

/// Runs a calibration of designs (FitTarget::microstructures) or of base materials one by one (FitTarget::base) to its
/// end.
Calibrated run_calibration(const std::vector<measurement::Replicates>& measured, const CalibrationSettings& settings,
                           LocalSimulator& simulator, const ProgressCallback& progress = {},
                           const EvaluationObserver& observe = {});

/// Calibrates on smaller specimens (`cheaper`, with the discretisation floor of its fidelity), and takes the result as
/// initial guesses of the real calibration: its parameters, and draws of what it left possible. Small specimens find
/// the region at a tenth of the cost; the larger ones then only correct what depends on size.
Calibrated calibrate_cheaply_first(const std::vector<measurement::Replicates>& measured,
                                   const CalibrationSettings& settings, LocalSimulator& cheaper,
                                   const DiscretisationFloor& cheaper_floor, LocalSimulator& simulator,
                                   const ProgressCallback& progress = {});

/// Simulated values of every measured design (of the tests that were measured), one vector per parameter set,
/// measurement-side extensions applied.
std::vector<std::vector<Prediction>> predict(const std::vector<material::ParameterSet>& parameters,
                                             const std::vector<measurement::Replicates>& measured,
                                             LocalSimulator& simulator, const std::function<void()>& done = {});

/// Geometric mean over the members, design by design; curves are those of the first member. A member that failed is
/// left out.
std::vector<Prediction> mean_prediction(const std::vector<std::vector<Prediction>>& members);

/// Fits the patterns of a measurement set, as the thesis does (homogeneous specimens are left out), or, when it holds
/// no patterns, soft, rigid and interface of it one by one over the ranges of Table A.1 (other mixtures are left out).
/// Throws InputError when there is nothing to fit, or fewer than hold_out + 1 patterns.
OfflineCalibration calibrate_offline(const measurement::MeasurementSet& set, const OfflineSettings& settings,
                                     const ProgressCallback& progress = {});

}  // namespace nacre::sysid
