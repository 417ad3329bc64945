#pragma once
// Calibration in this process, on all cores: what `nacre calibrate` does.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/read_set.hpp"
#include "sysid/calibration.hpp"

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
  std::vector<std::string> left_out;          ///< homogeneous specimens beside patterns, mixtures beside base materials
  std::vector<measurement::Replicates> measured;  ///< what was fitted, as Calibrated::predictions orders it
  int simulations = 0;                            ///< really done, held-out ones included
  int begun_simulations = 0;                      ///< of OfflineSettings::begin_at
};

/// Called after every simulation with the share done (0..1) and what is being done.
using ProgressCallback = std::function<void(double, std::string_view)>;

/// Simulates every measured design of an evaluation under its conditions; equal questions are answered once. Failed
/// simulations give predictions without value.
class LocalSimulator {
 public:
  /// `store`: a file of answers that are not simulated again (PredictionStore); empty: remembered while this object
  /// lives.
  LocalSimulator(tester::Fidelity fidelity, int threads, const std::filesystem::path& store = {});
  ~LocalSimulator();
  /// One prediction per item of each evaluation. `done` is called after each simulation (from any thread, one at a
  /// time).
  std::vector<std::vector<Prediction>> simulate(const std::vector<measurement::Replicates>& measured,
                                                const std::vector<WantedEvaluation>& evaluations,
                                                const std::function<void()>& done = {});
  int simulations() const;  ///< not answered from memory

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Runs a calibration of designs (FitTarget::microstructures) or of base materials one by one (FitTarget::base) to its
/// end.
Calibrated run_calibration(const std::vector<measurement::Replicates>& measured, const CalibrationSettings& settings,
                           LocalSimulator& simulator, const ProgressCallback& progress = {});

/// Calibrates on smaller specimens (`cheaper`, with the numerics floor of its fidelity), and begins the real
/// calibration where that one ended: at its parameters and at draws of what it left possible. Small specimens find the
/// region at a tenth of the cost; the larger ones then only correct what depends on size.
Calibrated calibrate_cheaply_first(const std::vector<measurement::Replicates>& measured,
                                   const CalibrationSettings& settings, LocalSimulator& cheaper,
                                   const DiscretisationFloor& cheaper_floor, LocalSimulator& simulator,
                                   const ProgressCallback& progress = {});

/// What the testers say of every measured design (the tests that were measured), one vector per parameter set,
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
