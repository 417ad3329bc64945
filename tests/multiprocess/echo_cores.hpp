#pragma once
// Two tiny cores with the real messages: the asker sends requests in batches, the farm responds by long work.
// What the asker sends in the end depends on every message that reached its core, so that one too many or too few
// shows.

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "base/hash.hpp"
#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::echo {

inline constexpr int kRequests = 60;
inline constexpr int kBatch = 10;
inline const std::vector<std::string> kParticipants = {"proposal_agent", "simulator_farm"};

inline pattern::Design design_of(int request) {
  return pattern::Pattern(static_cast<std::uint64_t>(request) * 12345 + 7);
}

class AskerCore : public runtime::NodeCore {
 public:
  runtime::Outputs step(const runtime::Input& input) override {
    runtime::Outputs outputs;
    const auto* message = std::get_if<runtime::Message>(&input);
    if (!message) return outputs;
    ++inputs_;
    if (message->channel == "RUN") {
      outputs.log.push_back({runtime::LogLevel::info, "the run begins"});
      ask(outputs);
    } else if (message->channel == "SIMULATED") {
      const auto result = wire::read<wire::SimulateResult>(message->payload);
      if (!result) return outputs;
      const int request = std::stoi(result->request_id.substr(result->request_id.rfind('/') + 1));
      responses_[request] = result->results.at(0).modulus_pa;
      if (static_cast<int>(responses_.size()) == asked_ && asked_ < kRequests) ask(outputs);
      if (static_cast<int>(responses_.size()) == kRequests) conclude(outputs);
    }
    return outputs;
  }

  runtime::Status status() const override {
    return {.phase = "asking",
            .round = 0,
            .progress = static_cast<double>(responses_.size()) / kRequests,
            .finished = finished_};
  }

 private:
  void ask(runtime::Outputs& outputs) {
    for (const int end = asked_ + kBatch; asked_ < end; ++asked_) {
      wire::SimulateRequest request;
      request.request_id = "proposal_agent/0/" + std::to_string(asked_);
      request.modulus = true;
      request.fidelity = tester::Fidelity::tiny;
      request.parameters = material::default_parameters();
      request.designs = {design_of(asked_)};
      outputs.messages.push_back({"SIMULATE", wire::write(request)});
    }
  }

  void conclude(runtime::Outputs& outputs) {
    wire::Proposal proposal;
    proposal.fidelity = tester::Fidelity::tiny;
    proposal.simulations = inputs_;
    for (const auto& [request, modulus_pa] : responses_)
      proposal.designs.push_back({.design = design_of(request), .modulus_pa = modulus_pa, .reason = "echo"});
    outputs.messages.push_back({"PROPOSAL", wire::write(proposal)});
    finished_ = true;
  }

  int inputs_ = 0;
  int asked_ = 0;
  bool finished_ = false;
  std::map<int, double> responses_;
};

class FarmCore : public runtime::NodeCore {
 public:
  runtime::Outputs step(const runtime::Input& input) override {
    runtime::Outputs outputs;
    if (const auto* message = std::get_if<runtime::Message>(&input); message && message->channel == "SIMULATE") {
      const auto request = wire::read<wire::SimulateRequest>(message->payload);
      if (request) outputs.computes.push_back({request->request_id, "echo", message->payload});
    } else if (const auto* done = std::get_if<runtime::WorkDone>(&input)) {
      outputs.messages.push_back({"SIMULATED", done->result});
    }
    return outputs;
  }
  runtime::Status status() const override {
    return {.phase = "serving", .round = 0, .progress = -1.0, .finished = true};
  }
};

/// The modulus of a design is made up from its name; the work takes some milliseconds.
inline std::string echo_work(const std::string& spec) {
  const wire::SimulateRequest request = *wire::read<wire::SimulateRequest>(spec);
  wire::SimulateResult result{request.request_id, 0, 1, 0, {}};
  for (const pattern::Design& design : request.designs) {
    const double modulus_pa = 1e9 * (1.0 + static_cast<double>(content_hash64(design.name()) % 1000));
    result.results.push_back({design, "", modulus_pa, 0.0, 0.0, 0, 0.0, 0.0, {}});
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return wire::write(result);
}

inline std::map<std::string, runtime::WorkFunction> echo_functions() { return {{"echo", echo_work}}; }

inline std::unique_ptr<runtime::NodeCore> make_core(const std::string& node) {
  if (node == "proposal_agent") return std::make_unique<AskerCore>();
  return std::make_unique<FarmCore>();
}

}  // namespace nacre::echo
