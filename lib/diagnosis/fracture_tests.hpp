#pragma once
// Fracture tests simulated for a diagnosis: every group of a set at chosen parameters, each simulation done once and
// kept.

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "diagnosis/observations.hpp"
#include "measurement/observe.hpp"
#include "measurement/summary.hpp"
#include "sysid/local_simulator.hpp"
#include "sysid/offline.hpp"

namespace nacre::diagnosis {

/// Predictions of every fracture group at one parameter set, before the testing machine.
struct FractureRun {
  material::ParameterSet parameters;           ///< material side only
  std::vector<sysid::Prediction> predictions;  ///< per fracture group; without values where the simulation failed
};

/// The groups of a set that are fracture tests.
struct FractureGroups {
  std::vector<int> groups;                        ///< indices of the observations' groups
  std::vector<measurement::Replicates> measured;  ///< the same in the form that a calibration uses
};
FractureGroups fracture_groups(const Observations& observations);

/// The features of a prediction as recorded by a machine with these measurement-side extensions.
FeatureValues shown_features(const sysid::Prediction& prediction, const material::Extensions& extensions,
                             const CurveReading& reading, const measurement::PrintContext& context = {});

/// A search for eta: the most probable one, and what was simulated on the way, a specimen of its own in every run.
struct FractureSearch {
  material::ToughnessParameters best;
  std::vector<FractureRun> runs;
};

/// The fracture tests of a set, to be simulated at any parameters; each simulation is done once and kept.
class FractureTests {
 public:
  /// `store`: a file of predictions that are kept (sysid::PredictionStore); empty: remembered while this object lives.
  FractureTests(const Observations& observations, tester::Fidelity fidelity, const std::filesystem::path& store,
                int threads);
  /// Indices of the observations' groups that are fracture tests.
  const std::vector<int>& groups() const { return of_set_.groups; }
  /// All groups at each of these sets that is not among the `known` runs; `done` after every simulation.
  std::vector<FractureRun> runs_at(const std::vector<material::ParameterSet>& sets, std::span<const FractureRun> known,
                                   const std::function<void()>& done = {}) const;
  /// Up to `rules.refined_layouts` of the upright layouts, spread over their rigid fractions, on elements of h and of
  /// h/2 at these parameters: specimens that nothing else is learnt from. Those of which some specimen failed are left
  /// out.
  std::vector<RefinedLayout> refined_layouts(const material::ParameterSet& set, const CurveReading& reading,
                                             const EmulatorRules& rules, const std::function<void()>& done = {}) const;
  /// Simulations really done.
  int simulations() const { return simulator_->simulations(); }
  /// A calibration of the base model to the measured toughness and peaks, from `start` in `ranges`.
  FractureSearch search(const material::ParameterSet& start, const material::ParameterRanges& ranges, int budget,
                        std::uint64_t seed, const sysid::ProgressCallback& progress) const;

 private:
  /// What a search simulates: one of each design, and which of them stands for each group; none: behind the last.
  struct Designs {
    std::vector<measurement::Replicates> measured;
    std::vector<std::size_t> of_group;
  };
  Designs designs() const;

  FractureGroups of_set_;
  std::unique_ptr<sysid::LocalSimulator> simulator_;
};

/// The set without measurement-side extensions: the part that a simulation depends on.
material::ParameterSet simulated_side(const material::ParameterSet& set);

}  // namespace nacre::diagnosis
