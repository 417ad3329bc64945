#pragma once
// The testers in this process, on all cores, for calibration and diagnosis.

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "measurement/summary.hpp"
#include "sysid/prediction.hpp"
#include "sysid/wanted_evaluation.hpp"
#include "tester/names.hpp"

namespace nacre::sysid {

/// Simulates every measured design of an evaluation under its conditions; equal simulations are done once. Failed
/// simulations give predictions without value.
class LocalSimulator {
 public:
  /// `store`: a file of predictions that are not simulated again (PredictionStore); empty: remembered while this object
  /// lives.
  LocalSimulator(tester::Fidelity fidelity, int threads, const std::filesystem::path& store = {});
  ~LocalSimulator();
  /// One prediction per item of each evaluation. `done` is called after each simulation (from any thread, one at a
  /// time).
  std::vector<std::vector<Prediction>> simulate(const std::vector<measurement::Replicates>& measured,
                                                const std::vector<WantedEvaluation>& evaluations,
                                                const std::function<void()>& done = {});
  int simulations() const;  ///< those that were not in memory or in the store

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre::sysid
