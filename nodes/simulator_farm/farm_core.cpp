#include "simulator_farm/farm_core.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/statistics.hpp"
#include "simulator_farm/test_request.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::simulator_farm {
namespace {

void warn(runtime::Outputs& outputs, std::string text) {
  outputs.log.push_back({runtime::LogLevel::warning, std::move(text)});
}

/// T, peak stress and failure strain are means over specimens.
void average(const std::vector<wire::SimulatedDesign>& specimens, wire::SimulatedDesign& whole) {
  const auto values = [&](double wire::SimulatedDesign::*field) {
    std::vector<double> all;
    for (const wire::SimulatedDesign& specimen : specimens) all.push_back(specimen.*field);
    return all;
  };
  whole.toughness_pa = mean(values(&wire::SimulatedDesign::toughness_pa));
  if (specimens.size() > 1) whole.toughness_sd_pa = standard_deviation(values(&wire::SimulatedDesign::toughness_pa));
  whole.peak_stress_pa = mean(values(&wire::SimulatedDesign::peak_stress_pa));
  whole.failure_strain = mean(values(&wire::SimulatedDesign::failure_strain));
}

}  // namespace

runtime::Outputs FarmCore::step(const runtime::Input& input) {
  runtime::Outputs outputs;
  if (const auto* message = std::get_if<runtime::Message>(&input)) {
    if (message->channel == "SIMULATE") accept(message->payload, outputs);
    if (message->channel == "ROUND") {
      const auto summary = wire::read<wire::RoundSummary>(message->payload);
      if (summary) {
        game_over_ = game_over_ || summary->last;
        round_ = std::max(round_, summary->last ? summary->round : summary->round + 1);
      }
    }
  } else if (const auto* work = std::get_if<runtime::WorkDone>(&input)) {
    settle(*work, outputs);
  }
  return outputs;
}

void FarmCore::accept(const std::string& payload, runtime::Outputs& outputs) {
  auto read = wire::read<wire::SimulateRequest>(payload);
  if (!read) return warn(outputs, fmt::format("a SIMULATE is ignored: {}", read.error().message));
  const std::string content = content_hash(wire::write(*read));
  const auto [position, is_new] = requests_.try_emplace(read->request_id, Request{.content = content});
  Request& entry = position->second;
  if (!is_new) {
    if (entry.content != content) {
      warn(outputs, fmt::format("request {} came again with other content and is ignored", read->request_id));
    } else if (entry.missing == 0) {
      respond(*read, outputs);
    }
    return;
  }
  const wire::SimulateRequest& request = *read;
  if (open_requests_ == 0) asked_ = done_ = 0;
  const std::vector<WantedTest> tests = tests_of(request);
  for (const pattern::Design& design : request.designs) {
    for (const WantedTest& wanted : tests) {
      const std::string key = tester::simulation_key(simulation_of(request, design, wanted.specimen), wanted.test);
      OpenTest& open_test = tests_[key];
      if (open_test.suffices(wanted.extras)) continue;
      open_test.test = wanted.test;
      open_test.specimen = wanted.specimen;
      // A design that stands twice in the request waits twice and is settled twice.
      open_test.waiting.push_back(request.request_id);
      ++entry.missing;
      ++asked_;
      if (!open_test.running) launch(key, request, design, wanted.extras, outputs);
    }
  }
  if (entry.missing == 0) return respond(request, outputs);
  ++open_requests_;
  entry.request = *std::move(read);
}

void FarmCore::launch(const std::string& key, const wire::SimulateRequest& request, const pattern::Design& design,
                      const Extras& wanted, runtime::Outputs& outputs) {
  OpenTest& open_test = tests_[key];
  open_test.running = true;
  open_test.computing = open_test.has | wanted;
  // More is wanted of a test that is done: the cache has the numbers, nothing is simulated twice for them.
  outputs.computes.push_back({.id = open_test.is_done ? fmt::format("{}/{}", key, to_string(open_test.computing)) : key,
                              .kind = "simulate",
                              .spec = wire::write(test_request_of(
                                  request, design, {open_test.test, open_test.specimen, open_test.computing}))});
}

void FarmCore::settle(const runtime::WorkDone& work, runtime::Outputs& outputs) {
  const auto position = tests_.find(work.id.substr(0, work.id.find('/')));
  if (position == tests_.end())
    return warn(outputs, fmt::format("the result of {} is ignored: nobody asked for it", work.id));
  auto result = read_response(work.result);
  if (!result) {
    // Whoever asked must not wait for ever: a response that says why there is no number.
    warn(outputs, fmt::format("the result of {} cannot be used: {}", work.id, result.error().message));
    result = TestResponse{};
    result->design.failure = "its result cannot be used";
  }
  OpenTest& open_test = position->second;
  open_test.running = false;
  if (open_test.is_done && open_test.response.design.failure.empty() && !result->design.failure.empty()) {
    // Numbers that were sent once stay: another's crack or film does not take them away.
    open_test.extras_failure = result->design.failure;
  } else {
    open_test.is_done = true;
    open_test.has = open_test.computing;
    open_test.response = *std::move(result);
  }
  const std::vector<std::string> waiting = std::exchange(open_test.waiting, {});
  for (const std::string& id : waiting) {
    Request& request = requests_.at(id);
    const Extras wanted = wanted_extras(request.request, open_test.test, open_test.specimen);
    if (!open_test.suffices(wanted)) {
      open_test.waiting.push_back(id);
      if (!open_test.running)
        launch(position->first, request.request, open_test.response.design.design, wanted, outputs);
      continue;
    }
    ++done_;
    if (--request.missing == 0) {
      --open_requests_;
      respond(std::exchange(request.request, {}), outputs);
    }
  }
}

bool FarmCore::OpenTest::suffices(const Extras& wanted) const {
  return is_done && (!failure(wanted).empty() || has.covers(wanted));
}

const std::string& FarmCore::OpenTest::failure(const Extras& wanted) const {
  return response.design.failure.empty() && !has.covers(wanted) ? extras_failure : response.design.failure;
}

const FarmCore::OpenTest& FarmCore::open_test(const wire::SimulateRequest& request, const pattern::Design& design,
                                              const WantedTest& wanted) const {
  return tests_.at(tester::simulation_key(simulation_of(request, design, wanted.specimen), wanted.test));
}

wire::SimulatedDesign FarmCore::assembled(const wire::SimulateRequest& request, const pattern::Design& design) const {
  wire::SimulatedDesign whole;
  whole.design = design;
  std::vector<wire::SimulatedDesign> specimens;
  for (const WantedTest& wanted : tests_of(request)) {
    const OpenTest& asked = open_test(request, design, wanted);
    if (const std::string& failure = asked.failure(wanted.extras); !failure.empty()) {
      const bool is_one_of_many = wanted.test == tester::TestKind::toughness && request.specimens > 1;
      const std::string which = is_one_of_many ? fmt::format(" of specimen {}", wanted.specimen) : "";
      wire::SimulatedDesign failed;
      failed.design = design;
      failed.failure = fmt::format("{}{}: {}", tester::to_string(wanted.test), which, failure);
      return failed;
    }
    if (wanted.test == tester::TestKind::modulus)
      whole.modulus_pa = asked.response.design.modulus_pa;
    else
      specimens.push_back(asked.response.design);
  }
  if (specimens.empty()) return whole;
  average(specimens, whole);
  whole.specimens = request.specimens;
  if (request.curve_points > 0) {
    const tester::Curve& curve = specimens.front().curve;
    whole.curve = request.curve_points < static_cast<int>(curve.size())
                      ? tester::resampled(curve, std::max(2, request.curve_points))
                      : curve;
  }
  return whole;
}

void FarmCore::respond(const wire::SimulateRequest& request, runtime::Outputs& outputs) const {
  std::vector<wire::SimulatedDesign> results;
  results.reserve(request.designs.size());
  for (const pattern::Design& design : request.designs) results.push_back(assembled(request, design));
  for (const wire::SimulateResult& part : wire::simulate_response(request.request_id, results)) {
    outputs.messages.push_back({"SIMULATED", wire::write(part)});
  }
  const std::vector<WantedTest> tests = tests_of(request);
  const auto filmed = std::ranges::find_if(tests, [](const WantedTest& each) { return each.extras.fracture(); });
  if (filmed == tests.end()) return;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].failure.empty()) continue;
    std::optional<wire::Fracture> fracture = open_test(request, request.designs[i], *filmed).response.fracture;
    if (!fracture) continue;
    fracture->request_id = request.request_id;
    fracture->design_index = i;
    if (!request.film) fracture->film.clear();  // the response does not depend on what others requested
    outputs.messages.push_back({"FRACTURE", wire::write(*fracture)});
  }
}

runtime::Status FarmCore::status() const {
  if (open_requests_ == 0) {
    return {
        .phase = game_over_ ? "the game is over" : "idle", .round = round_, .progress = -1.0, .finished = game_over_};
  }
  return {.phase = fmt::format("simulating, {} of {} tests done", done_, asked_),
          .round = round_,
          .progress = static_cast<double>(done_) / std::max(1, asked_),
          .finished = false};
}

std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario&) { return std::make_unique<FarmCore>(); }

}  // namespace nacre::simulator_farm
