#include "proposal_agent/proposal_core.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/random.hpp"
#include "explore/merge.hpp"
#include "game/budget.hpp"
#include "game/model.hpp"
#include "proposal_agent/search_work.hpp"
#include "proposal_agent/selection_work.hpp"

namespace nacre::proposal_agent {
namespace {

constexpr int kGenerationOffspring = 10;  // patterns of one generation (thesis 3.2.5)

void log(runtime::Outputs& outputs, runtime::LogLevel level, std::string text) {
  outputs.log.push_back({level, std::move(text)});
}

void post(const std::vector<wire::SimulateRequest>& requests, runtime::Outputs& outputs) {
  for (const wire::SimulateRequest& request : requests) outputs.messages.push_back({"SIMULATE", wire::write(request)});
}

}  // namespace

ProposalCore::ProposalCore(const game::Scenario& scenario) : scenario_(scenario) {
  for (int branch = 0; branch < scenario_.proposal.seeds; ++branch) explore::make_search(search_settings(branch));
}

runtime::Outputs ProposalCore::step(const runtime::Input& input) {
  runtime::Outputs outputs;
  if (const auto* message = std::get_if<runtime::Message>(&input)) {
    if (message->channel == "PARAMETERS") accept_model(message->payload, outputs);
    if (message->channel == "SIMULATED") accept_response(message->payload, outputs);
    if (message->channel == "ROUND") {
      const auto summary = wire::read<wire::RoundSummary>(message->payload);
      if (summary && summary->last) finished_ = true;
    }
  } else if (const auto* work = std::get_if<runtime::WorkDone>(&input)) {
    accept_work(*work, outputs);
  }
  return outputs;
}

void ProposalCore::accept_work(const runtime::WorkDone& work, runtime::Outputs& outputs) {
  if (work.id.starts_with("search/")) return accept_batch(work, outputs);
  accept_selection(work, outputs);
}

void ProposalCore::accept_model(const std::string& payload, runtime::Outputs& outputs) {
  auto model = wire::read<wire::AdoptedModel>(payload);
  if (!model) return log(outputs, runtime::LogLevel::warning, "a PARAMETERS is ignored: " + model.error().message);
  if (model->fidelity != scenario_.fidelity) {
    return log(outputs, runtime::LogLevel::warning,
               fmt::format("PARAMETERS({}) is ignored: its fidelity is {}, the game's {}", model->round,
                           tester::to_string(model->fidelity), tester::to_string(scenario_.fidelity)));
  }
  if (!known_rounds_.insert(model->round).second) return;
  waiting_.emplace(model->round, *std::move(model));
  start_due_round(outputs);
}

explore::SearchSettings ProposalCore::search_settings(int branch) const {
  const game::ProposalSettings& settings = scenario_.proposal;
  explore::SearchSettings search;
  search.algorithm = settings.algorithm;
  search.budget = settings.samples / settings.seeds + (branch < settings.samples % settings.seeds ? 1 : 0);
  search.population = settings.population;
  search.batch = std::min(kGenerationOffspring, settings.population);
  // The same streams in every round: gamuts of successive models differ by the models, not by their random starts.
  search.seed = RandomStream(scenario_.seed, fmt::format("gamut search {}", branch)).bits();
  return search;
}

/// Rounds are played one by one in their order, whatever the order in which their models come: a round begins with what
/// the last one found.
void ProposalCore::start_due_round(runtime::Outputs& outputs) {
  const auto next = waiting_.find(last_round_ + 1);
  if (round_ || next == waiting_.end()) return;
  round_.emplace();
  round_->model = std::move(next->second);
  waiting_.erase(next);
  const bool same_model = last_parameters_ == game::material_side(round_->model.parameters);
  log(outputs, runtime::LogLevel::info,
      fmt::format("round {}: searching with {} samples in {} searches{}", round_->model.round,
                  scenario_.proposal.samples, scenario_.proposal.seeds,
                  same_model ? ", the model is that of the round before" : ""));
  for (int number = 0; number < scenario_.proposal.seeds; ++number) {
    explore::SearchSettings settings = search_settings(number);
    (same_model ? settings.known : settings.former) = last_found_;
    round_->branches.emplace_back(number, settings, fmt::format("proposal_agent/r{}", round_->model.round));
  }
  for (Branch& branch : round_->branches) ask_next(branch, outputs);
}

wire::SimulateRequest ProposalCore::request_to_farm() const {
  wire::SimulateRequest model;
  model.modulus = model.toughness = true;
  model.fidelity = scenario_.fidelity;
  model.parameters = game::material_side(round_->model.parameters);
  return model;
}

void ProposalCore::ask_next(Branch& branch, runtime::Outputs& outputs) {
  if (const auto batch_request = branch.batch_request()) {
    outputs.computes.push_back({.id = branch.batch_id(),
                                .kind = "search",
                                .spec = search_spec(*batch_request, round_->model),
                                .by_hash = true});
  } else {
    send(branch.next(request_to_farm()), outputs);
  }
}

void ProposalCore::send(const std::vector<wire::SimulateRequest>& requests, runtime::Outputs& outputs) {
  post(requests, outputs);
  const bool all_finished =
      std::all_of(round_->branches.begin(), round_->branches.end(), [](const Branch& each) { return each.finished(); });
  if (all_finished && !round_->realisations) request_realisations(outputs);
}

void ProposalCore::accept_batch(const runtime::WorkDone& work, runtime::Outputs& outputs) {
  const auto batch = batch_from_result(work.result);
  Branch* branch = nullptr;
  if (round_) {
    for (Branch& each : round_->branches) {
      if (each.batch_id() == work.id && each.batch_request()) branch = &each;
    }
  }
  if (!branch || !batch)
    return log(outputs, runtime::LogLevel::warning, "the result of " + work.id + " is ignored: no batch is awaited");
  send(branch->next(request_to_farm(), *batch), outputs);
}

void ProposalCore::accept_response(const std::string& payload, runtime::Outputs& outputs) {
  auto part = wire::read<wire::SimulateResult>(payload);
  if (!part) return log(outputs, runtime::LogLevel::warning, "a SIMULATED is ignored: " + part.error().message);
  if (!round_) return;
  const std::string request_id = part->request_id;
  if (round_->realisations && round_->realisations->waits_for(request_id)) {
    const auto response = collector_.add(*std::move(part));
    if (response && round_->realisations->take(request_id, *response)) request_realisations(outputs);
    return;
  }
  if (round_->predictions && round_->predictions->waits_for(request_id)) {
    const auto response = collector_.add(*std::move(part));
    if (response && round_->predictions->take(request_id, *response))
      publish_proposal(round_->predictions->proposal(), outputs);
    return;
  }
  const auto branch = std::find_if(round_->branches.begin(), round_->branches.end(),
                                   [&](const Branch& each) { return each.waits_for(request_id); });
  if (branch == round_->branches.end()) return;  // answered before, or not ours
  const auto response = collector_.add(*std::move(part));
  if (response && branch->take(request_id, *response)) ask_next(*branch, outputs);
}

int ProposalCore::simulations() const {
  return std::accumulate(round_->branches.begin(), round_->branches.end(), 0,
                         [](int sum, const Branch& branch) { return sum + branch.simulated(); });
}

void ProposalCore::request_realisations(runtime::Outputs& outputs) {
  if (!round_->realisations) {
    std::vector<std::vector<explore::Evaluated>> gamuts;
    for (const Branch& branch : round_->branches) gamuts.push_back(branch.evaluated());
    round_->found = explore::merge_gamuts(gamuts);
    round_->realisations.emplace(round_->found, round_->model.measured, scenario_.proposal.realisations, scenario_.seed,
                                 fmt::format("proposal_agent/r{}", round_->model.round));
  }
  const auto requests = round_->realisations->next(request_to_farm());
  post(requests, outputs);
  if (requests.empty()) publish_gamut(outputs);
}

void ProposalCore::publish_gamut(runtime::Outputs& outputs) {
  round_->selecting = true;
  const std::vector<explore::Evaluated>& gamut = round_->realisations->gamut();
  for (const wire::GamutChunk& chunk :
       wire::gamut_chunks(round_->model.round, scenario_.fidelity, gamut, last_round_, last_gamut_))
    outputs.messages.push_back({"GAMUT", wire::write(chunk)});
  outputs.computes.push_back(
      {.id = fmt::format("select/r{}", round_->model.round),
       .kind = "select",
       .spec = selection_spec({.model = round_->model,
                               .gamut = round_->realisations->best(),
                               .count = game::within_budget(scenario_, round_->model.round + 1).proposal.designs,
                               .simulations = simulations() + round_->realisations->simulated()})});
}

void ProposalCore::accept_selection(const runtime::WorkDone& work, runtime::Outputs& outputs) {
  const auto proposal = wire::read<wire::Proposal>(work.result);
  if (!round_ || !proposal || proposal->round != round_->model.round) {
    return log(outputs, runtime::LogLevel::warning,
               "the result of " + work.id + " is ignored: no selection is awaited");
  }
  round_->predictions.emplace(*proposal);
  const auto requests = round_->predictions->requests(request_to_farm(),
                                                      fmt::format("proposal_agent/r{}/predicted", round_->model.round));
  post(requests, outputs);
  if (requests.empty()) publish_proposal(round_->predictions->proposal(), outputs);
}

/// Ends the round.
void ProposalCore::publish_proposal(wire::Proposal proposal, runtime::Outputs& outputs) {
  outputs.messages.push_back({"PROPOSAL", wire::write(proposal)});
  log(outputs, runtime::LogLevel::info,
      fmt::format("round {}: {} designs proposed from {} samples, their toughness from {} further fracture tests; "
                  "gamut hypervolume {:.4g} GPa MPa",
                  proposal.round, proposal.designs.size(), round_->found.size(), round_->realisations->simulated(),
                  proposal.gamut_hypervolume_staircase));
  last_parameters_ = game::material_side(round_->model.parameters);
  last_found_ = std::move(round_->found);
  last_gamut_ = round_->realisations->gamut();
  last_round_ = round_->model.round;
  round_.reset();
  start_due_round(outputs);
}

runtime::Status ProposalCore::status() const {
  if (!round_) {
    return {.phase = finished_ ? "the game is over" : "waiting for a model",
            .round = std::max(0, last_round_),
            .progress = -1.0,
            .finished = finished_};
  }
  if (round_->realisations && !round_->selecting)
    return {.phase = "simulating further specimens of the best designs",
            .round = round_->model.round,
            .progress = -1.0,
            .finished = false};
  if (round_->predictions)
    return {.phase = "simulating further specimens of the chosen designs",
            .round = round_->model.round,
            .progress = -1.0,
            .finished = false};
  if (round_->selecting)
    return {.phase = "selecting designs", .round = round_->model.round, .progress = -1.0, .finished = false};
  return {.phase = "searching",
          .round = round_->model.round,
          .progress = std::min(1.0, static_cast<double>(simulations()) / std::max(1, scenario_.proposal.samples)),
          .finished = false};
}

std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario) {
  return std::make_unique<ProposalCore>(scenario);
}

}  // namespace nacre::proposal_agent
