#pragma once
// The proposal agent's decisions: for every model that it is given, the gamut (thesis 2.3.3) and the designs worth a
// measurement (2.3.4).

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "explore/search.hpp"
#include "game/scenario.hpp"
#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::proposal_agent {

/// One of the searches that are merged into a gamut. Searches do not wait for each other: what one asks for depends on
/// the answers to its own questions alone, so the farm stays busy while the merged result is the same.
class Branch {
 public:
  Branch(int number, const explore::SearchSettings& settings, std::string request_prefix);

  /// What must be worked out before next() (a learned search trains); nothing for a search that answers at once.
  std::optional<explore::Question> question() const { return search_->question(); }
  /// SIMULATE requests for the next generation; empty when the search has ended.
  std::vector<wire::SimulateRequest> next(const wire::SimulateRequest& model);
  /// The same, with the answer to question().
  std::vector<wire::SimulateRequest> next(const wire::SimulateRequest& model, std::span<const pattern::Pattern> answer);
  /// Takes the answer to one of the requests. Returns whether the generation is complete (then ask for next()).
  bool take(const std::string& request_id, const std::vector<wire::SimulatedDesign>& answer);
  bool waits_for(const std::string& request_id) const { return first_.contains(request_id); }
  bool finished() const { return finished_; }
  /// Identity of the answer that the branch waits for or would ask for.
  std::string question_id() const;
  int simulated() const { return simulated_; }
  const std::vector<explore::Evaluated>& evaluated() const { return search_->evaluated(); }

 private:
  std::vector<wire::SimulateRequest> requests_for(const wire::SimulateRequest& model,
                                                  const std::vector<pattern::Pattern>& patterns);

  std::unique_ptr<explore::Search> search_;
  std::string prefix_;
  int generation_ = 0;
  std::map<std::string, std::size_t> first_;  // open request -> index of its first pattern
  std::vector<std::optional<optimize::Performance>> performances_;
  int simulated_ = 0;
  bool finished_ = false;
};

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
    bool selecting = false;
    std::vector<explore::Evaluated> gamut;
  };

  void accept_model(const std::string& payload, runtime::Outputs& outputs);
  void accept_answer(const std::string& payload, runtime::Outputs& outputs);
  void accept_work(const runtime::WorkDone& work, runtime::Outputs& outputs);
  void accept_batch(const runtime::WorkDone& work, runtime::Outputs& outputs);
  void accept_proposal(const runtime::WorkDone& work, runtime::Outputs& outputs);
  void start_next_round(runtime::Outputs& outputs);
  explore::SearchSettings search_settings(int branch) const;
  void ask_next(Branch& branch, runtime::Outputs& outputs);
  void send(const std::vector<wire::SimulateRequest>& requests, runtime::Outputs& outputs);
  wire::SimulateRequest question_to_farm() const;
  void publish_gamut(runtime::Outputs& outputs);
  int simulations() const;

  game::Scenario scenario_;
  std::map<int, wire::AdoptedModel> waiting_;  // models of rounds to come
  std::set<int> known_rounds_;
  std::optional<Round> round_;
  wire::AnswerCollector collector_;
  // The last gamut and its model: when a round brings the same model again, nothing of it is asked anew; under another
  // model a search that learns begins with what the last one said.
  std::optional<material::ParameterSet> last_parameters_;
  std::vector<explore::Evaluated> last_gamut_;
  int last_round_ = -1;
  bool finished_ = false;
};

std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario);

}  // namespace nacre::proposal_agent
