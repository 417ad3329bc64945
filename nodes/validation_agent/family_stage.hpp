#pragma once
// The stage after the game (thesis 2.4.1 and 3.3.1): families of good designs, a model for each, variants around them,
// and whether the model was worth it.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "families/grouping.hpp"
#include "game/scenario.hpp"
#include "runtime/farm_requests.hpp"
#include "runtime/node_core.hpp"
#include "validation_agent/fitting.hpp"
#include "wire/convert.hpp"

namespace nacre::validation_agent {

/// What the game leaves to the stage.
struct StageBeginning {
  int round = 0;                                  ///< that the chosen designs are ordered in
  material::ParameterSet model;                   ///< of the last round
  std::vector<measurement::Replicates> measured;  ///< game::patterns_with_both()
  std::vector<optimize::Performance> benchmark;
  std::vector<pattern::Pattern> settled;  ///< not worth choosing again
  material::ParameterRanges ranges = material::default_ranges();
  sysid::DiscretisationFloor floor;
};

/// Grouping -> for each family in turn: calibration, dense sampling, simulation of the variants, selection of 2.3.4,
/// predictions of both models, FAMILY and FAMILY_GAMUT -> measurements, which whoever owns the stage orders -> FAMILY
/// with them. A function of its inputs, as every core.
class FamilyStage {
 public:
  /// Whether there is anything to begin with.
  static bool is_possible(const StageBeginning& beginning) { return !beginning.measured.empty(); }

  FamilyStage(const game::Scenario& scenario, StageBeginning beginning);
  void begin(runtime::Outputs& outputs);
  void accept_response(wire::SimulateResult part, runtime::Outputs& outputs);
  void accept_work(const runtime::WorkDone& work, runtime::Outputs& outputs);

  /// All families have their designs; chosen() are to be measured now.
  bool has_chosen() const { return has_chosen_; }
  std::vector<pattern::Design> chosen() const;
  /// Sends every family once more with what was measured of its designs, and warns where a model over-fits.
  void conclude(const std::vector<measurement::Replicates>& measured, runtime::Outputs& outputs);

  /// The present step, for people, and its progress (-1 unknown).
  std::string phase() const;
  double progress() const;

 private:
  enum class Step { grouping, calibrating, sampling, simulating, predicting, done };

  void begin_family(runtime::Outputs& outputs);
  void calibrate_on(runtime::Outputs& outputs);
  void sample(runtime::Outputs& outputs);
  void simulate_variants(runtime::Outputs& outputs);
  void choose(runtime::Outputs& outputs);
  void finish_family(runtime::Outputs& outputs);
  void ask(const runtime::FarmBatch& batch, runtime::Outputs& outputs);
  std::string label(const char* what) const;
  game::DesignValues measured_values(const pattern::Pattern& pattern) const;

  game::Scenario scenario_;
  StageBeginning beginning_;
  Step step_ = Step::grouping;
  bool has_chosen_ = false;

  std::vector<families::SeedFamily> groups_;
  std::vector<wire::CalibratedFamily> families_;  // one per group, the last one in work

  // Of the family in work.
  std::optional<Fitting> fitting_;
  std::vector<pattern::Pattern> variants_;
  std::vector<explore::Evaluated> gamut_;
  std::vector<measurement::Replicates> asked_;
  runtime::FarmRequests farm_;
};

}  // namespace nacre::validation_agent
