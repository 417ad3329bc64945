#pragma once
// The validation agent's decisions: it has proposals measured, calibrates the model on everything measured so far, and
// decides when the game is over (docs/ARCHITECTURE.md; thesis 2.3.2 and 3.2).

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "game/equilibrium.hpp"
#include "game/extension_trial.hpp"
#include "game/measurement_book.hpp"
#include "game/scenario.hpp"
#include "optimize/pareto.hpp"
#include "runtime/farm_requests.hpp"
#include "runtime/node_core.hpp"
#include "validation_agent/family_stage.hpp"
#include "validation_agent/fitting.hpp"
#include "validation_agent/order_desk.hpp"
#include "wire/convert.hpp"

namespace nacre::validation_agent {

/// What a game starts from, read before it begins.
struct StartingPoint {
  material::ParameterSet model = material::default_parameters();
  std::vector<measurement::Replicates>
      base_materials;                            ///< that round 0 is fitted to; empty: the model is taken as it is
  std::vector<optimize::Performance> benchmark;  ///< used until mixtures are measured; may be empty
  material::ParameterRanges ranges = material::default_ranges();
  sysid::DiscretisationFloor floor;  ///< at the scenario's fidelity
};

/// Round 0: RUN -> fit of the base materials -> PARAMETERS(0) -> GAMUT(0), PROPOSAL(0) -> ROUND(0).
/// Round n: TEST_ORDERs -> MEASUREMENTs -> out-of-sample prediction errors -> calibration -> DIAGNOSE, DIAGNOSIS ->
/// PARAMETERS(n) -> GAMUT(n), PROPOSAL(n) -> ROUND(n). Where the scenario wants families, they follow the last ROUND,
/// which is then sent once more as the last (family_stage.hpp). An extension that the diagnosis names is calibrated in
/// addition to the adopted model and put on trial: before TEST_ORDERs go out it predicts the proposed designs. It is
/// adopted once it is still named and has predicted designs better (game::gain_is_established).
class ValidationCore : public runtime::NodeCore {
 public:
  ValidationCore(const game::Scenario& scenario, StartingPoint start);
  runtime::Outputs step(const runtime::Input& input) override;
  runtime::Status status() const override;
  std::vector<runtime::Message> open(std::string_view channel) const override;

 private:
  enum class Phase {
    waiting_for_run,
    predicting_trial,
    measuring,
    predicting,
    calibrating,
    diagnosing,
    waiting_for_proposal,
    working_out_families,
    finished
  };

  /// An extension that is named and not yet adopted.
  struct OnTrial {
    std::vector<std::string> effects;  ///< sorted
    material::ParameterSet model;      ///< the base refitted with them
    std::map<std::string, sysid::Prediction>
        predicted;  ///< its predictions for the designs of this round, as recorded by the testing machine
    std::map<std::string, sysid::Prediction>
        adopted;  ///< the adopted model's predictions for designs that separate the two, proposals aside
    game::ExtensionTrialErrors errors;  ///< of all rounds since it was first named
  };

  // Inputs (validation_core.cpp).
  void accept_message(const runtime::Message& message);
  void accept_run(const std::string& payload);
  void accept_response(const std::string& payload);
  void accept_gamut(const std::string& payload);
  void accept_proposal(const std::string& payload);
  void accept_diagnosis(const std::string& payload);
  void accept_measurement(const std::string& payload);
  void accept_review(const std::string& payload);
  void accept_approval(const std::string& payload);
  void accept_withdrawal(const std::string& payload);
  void accept_work(const runtime::WorkDone& work);
  void add_own_design(const wire::Approval& approval);

  // The course of a round (validation_rounds.cpp).
  void begin_round(int round);
  /// Experiments that the last diagnosis wants; none once the model holds what it names: they would tell it from the
  /// base.
  std::vector<game::DiscriminationTest> experiments() const;
  std::vector<pattern::Design> separating_designs() const;
  std::vector<measurement::Replicates> predicted_designs() const;
  void predict_for_trial();
  void finish_trial_predictions();
  void begin_unfitted();
  void order();
  void measure_on();
  void predict_out_of_sample();
  void finish_out_of_sample(const std::vector<sysid::Prediction>& predictions);
  void begin_calibration(const material::ParameterSet& start);
  void calibrate_on();
  void finish_calibration();
  void take_over(const sysid::Calibrated& result);
  /// What the present round is fitted to.
  material::FitTarget fit_target() const;
  std::vector<sysid::EvaluatedModel> latest_evaluated() const;
  void diagnose();
  std::optional<material::ParameterSet> extended_by(const wire::Diagnosis& diagnosis);
  bool model_holds(const wire::Diagnosis& diagnosis) const;
  void take_early_measurements();
  void take_diagnosis(const wire::Diagnosis& diagnosis);
  void weigh(const wire::Diagnosis& diagnosis);
  void finish_trial(const sysid::Calibrated& result);
  void publish_model();
  std::vector<optimize::Performance> benchmark() const;
  std::set<pattern::Pattern> settled_patterns() const;
  void close_round_when_proposed();
  wire::RoundSummary summary();

  // The stage after the last round.
  StageBeginning stage_beginning() const;
  void measure_families_when_chosen();
  void finish_families();

  // Shorthands for outputs.
  template <class Domain>
  void send(const char* channel, const Domain& value) {
    outputs_.messages.push_back({channel, wire::write(value)});
  }
  void say(runtime::LogLevel level, std::string text) { outputs_.log.push_back({level, std::move(text)}); }
  /// The message of this step changes nothing; its sender hears why.
  void refuse(const std::string& why);
  void ask_farm(const std::string& label, const std::vector<sysid::WantedEvaluation>& wanted,
                const std::vector<measurement::Replicates>& measured);
  void send_orders(const std::vector<game::Order>& orders);
  wire::TestOrder message_of(const game::Order& order) const;

  game::Scenario scenario_;
  StartingPoint start_;
  Phase phase_ = Phase::waiting_for_run;
  int round_ = 0;
  runtime::Outputs outputs_;  // of the present step

  game::MeasurementBook book_;
  OrderDesk desk_;
  material::ParameterSet model_;

  // Of the present round. The specimens are those that its calibration saw: later ones belong to the next round.
  std::vector<measurement::SpecimenRecord> specimens_;
  std::map<std::string, int> revisions_;  // of those specimens
  std::vector<measurement::Replicates> calibration_set_;
  runtime::FarmRequests farm_;
  std::optional<Fitting> fitting_;
  std::vector<sysid::EvaluatedModel> evaluated_;  // by the latest calibration of the adopted model
  std::vector<measurement::Replicates> predicted_set_;
  std::vector<sysid::Prediction> proposed_;  // for each of predicted_set_, by the proposal
  sysid::PredictionErrors before_, after_, out_of_sample_;
  sysid::Provenance provenance_;  ///< of model_
  int simulations_ = 0;
  bool extending_ = false;  // the calibration in progress is that of a named extension
  std::optional<OnTrial> trial_;

  std::set<std::string> calibrated_designs_;  // ever calibrated on: no longer out-of-sample
  wire::GamutCollector gamuts_;
  std::map<int, wire::Proposal> proposals_;
  std::map<int, std::vector<std::string>> early_measurements_;
  std::map<int, wire::Diagnosis>
      early_diagnoses_;                       // that came before they were requested: this agent's journal was lost
  std::optional<wire::Diagnosis> diagnosis_;  // of the last round that had one
  std::vector<game::RoundFigures> history_;

  std::optional<FamilyStage> families_;  // begun with the last round's end
  wire::RoundSummary last_round_;        // to be closed for good when the stage is over
};

/// Reads the scenario's tables. Throws InputError when one cannot be used.
std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario);

}  // namespace nacre::validation_agent
