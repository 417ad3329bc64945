#pragma once
// The proposal agent's decisions: for every model that it is given, the gamut (thesis 2.3.3) and the designs worth a
// measurement (2.3.4).

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "game/scenario.hpp"
#include "proposal_agent/branch.hpp"
#include "proposal_agent/predictions.hpp"
#include "proposal_agent/realisations.hpp"
#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::proposal_agent {

/// PARAMETERS(n) in; SIMULATE while searching, GAMUT(n) and PROPOSAL(n) out. Long work: choosing the next batch of a
/// search that learns (kind "search", see search_work.hpp) and the selection (kind "select", see selection_work.hpp).
class ProposalCore : public runtime::NodeCore {
 public:
  /// Throws InputError when the scenario's search settings cannot be used.
  explicit ProposalCore(const game::Scenario& scenario);
  runtime::Outputs step(const runtime::Input& input) override;
  runtime::Status status() const override;

 private:
  struct Round {
    wire::AdoptedModel model;
    std::vector<Branch> branches;
    std::vector<explore::Evaluated> found;     ///< by all branches, each T of one simulation
    std::optional<Realisations> realisations;  ///< once every branch has ended
    bool selecting = false;
    std::optional<Predictions> predictions;  ///< of the designs selected
  };

  void accept_model(const std::string& payload, runtime::Outputs& outputs);
  void accept_response(const std::string& payload, runtime::Outputs& outputs);
  void accept_work(const runtime::WorkDone& work, runtime::Outputs& outputs);
  void accept_batch(const runtime::WorkDone& work, runtime::Outputs& outputs);
  void accept_selection(const runtime::WorkDone& work, runtime::Outputs& outputs);
  void start_due_round(runtime::Outputs& outputs);
  explore::SearchSettings search_settings(int branch) const;
  void ask_next(Branch& branch, runtime::Outputs& outputs);
  void send(const std::vector<wire::SimulateRequest>& requests, runtime::Outputs& outputs);
  wire::SimulateRequest request_to_farm() const;
  void request_realisations(runtime::Outputs& outputs);
  void publish_gamut(runtime::Outputs& outputs);
  void publish_proposal(wire::Proposal proposal, runtime::Outputs& outputs);
  int simulations() const;

  game::Scenario scenario_;
  std::map<int, wire::AdoptedModel> waiting_;  // models of rounds to come
  std::set<int> known_rounds_;
  std::optional<Round> round_;
  wire::ResponseCollector collector_;
  // What was found last and its model: when a round brings the same model again, nothing of it is requested anew; under
  // another model a search that learns begins with what it found under the last one.
  std::optional<material::ParameterSet> last_parameters_;
  std::vector<explore::Evaluated> last_found_;
  std::vector<explore::Evaluated> last_gamut_;  // as published, which the next one may add to
  int last_round_ = -1;                         // that was played to its end; every game begins with round 0
  bool finished_ = false;
};

std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario);

}  // namespace nacre::proposal_agent
