#include "virtual_lab/virtual_lab_core.hpp"

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/random.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/effect_kinds.hpp"
#include "laboratory/laboratory_file.hpp"
#include "virtual_lab/experiment_text.hpp"

namespace nacre::virtual_lab {
namespace {

using runtime::LogLevel;
using runtime::Outputs;

constexpr const char* kOrderChannel = "TEST_ORDER";
constexpr const char* kRoundChannel = "ROUND";
constexpr const char* kMeasurementChannel = "MEASUREMENT";
constexpr const char* kRevealChannel = "REVEAL";
constexpr const char* kWorkKind = "measure";
constexpr int kPrintPositions = 1000;

/// Orders of as many specimens as the truth has share a simulation; one of more has its own.
Experiment experiment_of(const wire::TestOrder& order, const Truth& truth) {
  const bool of_more = order.test == tester::TestKind::toughness && order.replicates > truth.replicates;
  return {.design = order.design,
          .test = order.test,
          .conditions = order.conditions,
          .fidelity = order.fidelity,
          .loading = order.loading,
          .specimens = of_more ? order.replicates : 0};
}

/// Where on the print bed's list a specimen stands: drawn, so that it is known before the rest of the batch is.
int print_position(std::uint64_t seed, const std::string& batch, const std::string& specimen) {
  RandomStream stream(seed, fmt::format("print/{}/{}", batch, specimen));
  return 1 + stream.index(kPrintPositions);
}

wire::Reveal revealed(const Truth& truth) {
  wire::Reveal reveal{.parameters = {.modulus = truth.modulus,
                                     .toughness = truth.toughness,
                                     .extensions = {},
                                     .criterion = truth.criterion,
                                     .strength_cv = truth.strength_cv},
                      .modulus_noise = truth.noise.modulus,
                      .toughness_noise = truth.noise.toughness,
                      .causes = {}};
  for (const laboratory::EffectKind& kind : laboratory::effect_kinds()) {
    const double value = truth.effects.*kind.value;
    if (value == 0.0) continue;
    wire::HiddenCause cause{.name = std::string(kind.name),
                            .meaning = fmt::format("{}, {}", kind.meaning, kind.unit),
                            .in_library = kind.in_library,
                            .values = {value}};
    if (kind.second.value != nullptr) cause.values.push_back(truth.effects.*kind.second.value);
    reveal.causes.push_back(std::move(cause));
  }
  return reveal;
}

}  // namespace

Outputs VirtualLabCore::step(const runtime::Input& input) {
  Outputs outputs;
  if (const auto* message = std::get_if<runtime::Message>(&input)) {
    if (message->channel == kOrderChannel) accept(message->payload, outputs);
    if (message->channel == kRoundChannel) {
      const auto round = wire::read<wire::RoundSummary>(message->payload);
      if (round && round->last && !game_over_)
        outputs.messages.push_back({.channel = kRevealChannel, .payload = wire::write(revealed(truth_))});
      game_over_ = game_over_ || (round && round->last);
    }
  } else if (const auto* work = std::get_if<runtime::WorkDone>(&input)) {
    settle(*work, outputs);
  }
  return outputs;
}

void VirtualLabCore::accept(const std::string& payload, Outputs& outputs) {
  const Result<wire::TestOrder> order = wire::read<wire::TestOrder>(payload);
  if (!order) {
    outputs.log.push_back({LogLevel::warning, "TEST_ORDER refused: " + order.error().message});
    return;
  }
  const auto [known, is_new] = orders_.try_emplace(order->order_id, *order);
  if (!is_new) {
    if (known->second != *order) {
      outputs.log.push_back(
          {LogLevel::warning, fmt::format("TEST_ORDER {} came again with another content", order->order_id)});
    }
    return;
  }
  latest_round_ = std::max(latest_round_, order->round);
  const Experiment experiment = experiment_of(*order, truth_);
  const std::string spec = to_spec(experiment);
  const std::string id = "measure/" + content_hash(spec);
  const auto [simulation, first] =
      simulations_.try_emplace(id, Simulation{.experiment = experiment, .response = {}, .waiting = {}});
  if (simulation->second.response) {
    report(*order, experiment, *simulation->second.response, outputs);
    return;
  }
  simulation->second.waiting.push_back(order->order_id);
  if (!first) return;
  outputs.computes.push_back({.id = id, .kind = kWorkKind, .spec = spec});
  outputs.log.push_back(
      {LogLevel::info, fmt::format("{}: {} of {}, {} specimens", order->order_id, tester::to_string(order->test),
                                   order->design.name(), order->replicates)});
}

void VirtualLabCore::settle(const runtime::WorkDone& work, Outputs& outputs) {
  const auto found = simulations_.find(work.id);
  if (found == simulations_.end() || found->second.response) {
    outputs.log.push_back({LogLevel::warning, fmt::format("result {} was not asked for", work.id)});
    return;
  }
  Simulation& simulation = found->second;
  simulation.response = response_from_text(work.result);
  ++settled_;
  for (const std::string& order_id : simulation.waiting) {
    report(orders_.at(order_id), simulation.experiment, *simulation.response, outputs);
  }
  simulation.waiting.clear();
}

void VirtualLabCore::report(const wire::TestOrder& order, const Experiment& experiment,
                            const Result<TrueResponse>& response, Outputs& outputs) const {
  if (!response) {
    outputs.log.push_back(
        {LogLevel::warning, fmt::format("{}: no valid specimen: {}", order.order_id, response.error().message)});
  }
  for (int k = 1; k <= order.replicates; ++k) {
    const std::string specimen = fmt::format("{}/{}", order.order_id, k);
    const laboratory::Replicate replicate{.specimen = specimen,
                                          .batch = order.batch,
                                          .print_order = print_position(truth_.seed, order.batch, specimen),
                                          .number = k};
    const wire::Measurement measurement{.round = order.round,
                                        .order_id = order.order_id,
                                        .fidelity = order.fidelity,
                                        .record = record_specimen(truth_, experiment, response, replicate)};
    outputs.messages.push_back({.channel = kMeasurementChannel, .payload = wire::write(measurement)});
  }
}

runtime::Status VirtualLabCore::status() const {
  const auto total = static_cast<int>(simulations_.size());
  const bool busy = settled_ < total;
  return {.phase = busy ? fmt::format("measuring, {} of {} experiments done", settled_, total) : "waiting for orders",
          .round = latest_round_,
          .progress = busy ? settled_ / static_cast<double>(total) : -1.0,
          .finished = game_over_ && !busy};
}

Truth truth_of(const game::Scenario& scenario) {
  if (scenario.laboratory.file.empty()) {
    Truth drawn = laboratory::draw_truth(scenario.seed, scenario.fidelity);
    drawn.replicates = scenario.validation.replicates;  // each costs a simulation
    return drawn;
  }
  Truth truth = laboratory::read_laboratory(scenario.laboratory.file, scenario.seed);
  truth.fidelity = scenario.fidelity;
  return truth;
}

std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario) {
  return std::make_unique<VirtualLabCore>(truth_of(scenario));
}

std::map<std::string, runtime::WorkFunction> work_functions(const Truth& truth) {
  return {{kWorkKind, [truth](const std::string& spec) {
             const Result<Experiment> experiment = experiment_from_spec(spec);
             if (!experiment) return to_text(tl::unexpected(experiment.error()));
             return to_text(respond(truth, *experiment));
           }}};
}

}  // namespace nacre::virtual_lab
