#pragma once
// The analyser's decisions: what is kept of a run, when a diagnosis can start, when a report is due.

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "game/scenario.hpp"
#include "material/ranges.hpp"
#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::analyser {

/// Points of the simulated curves shown with measured ones.
inline constexpr int kCurvePoints = 64;

/// Keeps every message of the game in run.db (Compute kind "store"), responds to DIAGNOSE with DIAGNOSIS (kinds "plan"
/// and "diagnose") once all measurements meant and the farm's responses have arrived, has the farm simulate at the end
/// of each round the measured designs with the round's model, and the fracture of proposed designs and those of
/// families (films in RUN/films), and then has the report written (kind "report"). See works.hpp.
class AnalyserCore : public runtime::NodeCore {
 public:
  /// `floor_toml`: the discretisation floor of diagnoses; empty: none.
  AnalyserCore(const game::Scenario& scenario, const material::ParameterRanges& ranges, std::string floor_toml);
  runtime::Outputs step(const runtime::Input& input) override;
  runtime::Status status() const override;

 private:
  /// A diagnosis whose measurements are complete.
  struct OpenDiagnosis {
    wire::DiagnoseRequest request;
    int plans = 0;                                                 ///< that were asked for
    std::set<std::string> awaited;                                 ///< ids of requests
    std::map<std::pair<std::string, int>, std::string> simulated;  ///< payloads by request id and chunk
    wire::ResponseCollector collector;
  };

  void accept_message(const runtime::Message& message);
  void accept_work(const runtime::WorkDone& work);
  void accept_request(const wire::DiagnoseRequest& request);
  void accept_response(const wire::SimulateResult& part);
  void accept_fracture(const wire::Fracture& fracture);
  void store(const std::string& channel, const std::string& payload);
  std::vector<std::string> missing_specimens() const;
  void diagnose_when_complete();
  bool has_fractures(const OpenDiagnosis& diagnosis) const;
  std::string diagnosis_spec() const;
  void plan_diagnosis();
  void request_for_diagnosis(const std::string& plan);
  bool take_for_diagnosis(const std::string& payload);
  void diagnose();
  void close_round(const wire::RoundSummary& round);
  bool is_of_this_game(const std::string& measurement);
  void accept_measurement(const std::string& payload);
  void request_measured_designs();
  void request_films();
  void request_films_of(const std::string& whose, const material::ParameterSet& model,
                        const std::vector<pattern::Design>& designs);
  void send_request(wire::SimulateRequest request);
  void close_when_complete(const std::string& request_id);
  void report_when_ready();

  game::Scenario scenario_;
  material::ParameterRanges ranges_;
  std::string floor_toml_;
  runtime::Outputs outputs_;  // of the present step

  std::map<std::pair<std::string, int>, std::string> measurements_;  // payloads by specimen and revision
  std::map<int, wire::AdoptedModel> models_;
  std::set<int> diagnosed_;  // rounds that a diagnosis was asked for
  std::optional<wire::DiagnoseRequest> waiting_diagnosis_;
  std::optional<OpenDiagnosis> diagnosis_;
  std::set<std::string> kept_;     // ids of "store" work ever asked for
  std::set<std::string> storing_;  // ids of "store" work in progress
  std::set<int> closed_;           // rounds
  /// A pattern and the first round that measured it.
  struct MeasuredDesign {
    pattern::Design design;
    int round = 0;
  };
  std::map<std::string, MeasuredDesign> measured_designs_;  // by name
  std::map<int, std::set<std::string>> asked_designs_;      // of the model of a round, beside those of the one before
  std::set<int> proposed_;                                  // rounds
  std::map<int, std::vector<pattern::Design>> unfilmed_;    // proposals whose films have not been asked for, by round
  std::set<int> filmed_families_;                           // by number
  /// What has come of the responses to a request.
  struct OpenResponse {
    bool with_fractures = false;
    std::size_t chunks = 0;  ///< in all; 0 before the first has come
    std::set<int> chunk;
    std::set<std::size_t> broke;     ///< designs that a FRACTURE is sent for
    std::set<std::size_t> fracture;  ///< designs whose FRACTURE has come
  };
  std::map<std::string, OpenResponse> open_responses_;  // by request id
  std::optional<int> report_due_;                       // round
  bool reporting_ = false;
  int reports_ = 0;
  int round_ = 0;
  bool last_ = false;
  bool finished_ = false;
  std::string phase_ = "idle";
  int phase_round_ = 0;
};

/// With the ranges of scenario.ranges_file and the floor of scenario.discretisation_floor_file; the thesis' ranges, no
/// floor when those are empty. Throws InputError when one cannot be used.
std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario);

}  // namespace nacre::analyser
