#include "analyser/analyser_core.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/ranges.h>

#include "analyser/diagnosis_work.hpp"
#include "analyser/works.hpp"
#include "base/counted.hpp"
#include "base/expected.hpp"
#include "base/files.hpp"
#include "base/hash.hpp"
#include "diagnosis/fracture_discretisation.hpp"
#include "diagnosis/modulus_floor.hpp"
#include "game/model.hpp"
#include "game/starting_point.hpp"
#include "runtime/journal.hpp"
#include "wire/channels.hpp"

namespace nacre::analyser {
namespace {

bool is_kept(const std::string& channel) {
  static const std::set<std::string> kKept = {"PARAMETERS", "GAMUT",    "PROPOSAL", "MEASUREMENT",  "REVIEW", "ROUND",
                                              "SIMULATED",  "FRACTURE", "FAMILY",   "FAMILY_GAMUT", "REVEAL"};
  return kKept.contains(channel);
}

}  // namespace

AnalyserCore::AnalyserCore(const game::Scenario& scenario, const material::ParameterRanges& ranges,
                           std::string floor_toml)
    : scenario_(scenario), ranges_(ranges), floor_toml_(std::move(floor_toml)) {}

runtime::Outputs AnalyserCore::step(const runtime::Input& input) {
  outputs_ = {};
  if (const auto* message = std::get_if<runtime::Message>(&input)) accept_message(*message);
  if (const auto* work = std::get_if<runtime::WorkDone>(&input)) accept_work(*work);
  return std::move(outputs_);
}

void AnalyserCore::accept_message(const runtime::Message& message) {
  const wire::Channel* channel = wire::find_channel(message.channel);
  if (channel == nullptr) return;
  if (const auto sound = channel->validate(message.payload); !sound) {
    outputs_.log.push_back(
        {runtime::LogLevel::warning, fmt::format("{} ignored: {}", message.channel, sound.error().message)});
    return;
  }
  if (message.channel == "MEASUREMENT" && !is_of_this_game(message.payload)) return;
  if (is_kept(message.channel)) store(message.channel, message.payload);
  if (message.channel == "PARAMETERS") {
    const auto model = wire::read<wire::AdoptedModel>(message.payload);
    models_.emplace(model->round, *model);
    request_measured_designs();
    request_films();
  } else if (message.channel == "PROPOSAL") {
    const auto proposal = wire::read<wire::Proposal>(message.payload);
    // Tiny specimens are for processes: nobody looks at them.
    if (scenario_.fidelity != tester::Fidelity::tiny && proposed_.insert(proposal->round).second) {
      std::vector<pattern::Design>& designs = unfilmed_[proposal->round];
      for (const wire::ProposedDesign& proposed : proposal->designs) designs.push_back(proposed.design);
      request_films();
    }
  } else if (message.channel == "FAMILY") {
    const auto family = wire::read<wire::CalibratedFamily>(message.payload);
    if (scenario_.fidelity != tester::Fidelity::tiny && filmed_families_.insert(family->number).second) {
      std::vector<pattern::Design> designs;
      for (const game::FamilyDesign& each : family->designs) designs.emplace_back(each.pattern);
      request_films_of(fmt::format("family{}", family->number), family->parameters, designs);
    }
  } else if (message.channel == "MEASUREMENT") {
    accept_measurement(message.payload);
  } else if (message.channel == "DIAGNOSE") {
    accept_request(*wire::read<wire::DiagnoseRequest>(message.payload));
  } else if (message.channel == "SIMULATED") {
    if (!take_for_diagnosis(message.payload)) accept_response(*wire::read<wire::SimulateResult>(message.payload));
  } else if (message.channel == "FRACTURE") {
    accept_fracture(*wire::read<wire::Fracture>(message.payload));
  } else if (message.channel == "ROUND") {
    close_round(*wire::read<wire::RoundSummary>(message.payload));
  }
}

/// The validation agent refuses specimens of another fidelity, and what it does not know must not be reported.
bool AnalyserCore::is_of_this_game(const std::string& measurement) {
  const auto measured = wire::read<wire::Measurement>(measurement);
  if (measured->fidelity == scenario_.fidelity) return true;
  outputs_.refusal =
      fmt::format("specimen {} ignored: measured at fidelity {}, the game is played at {}", measured->record.specimen,
                  tester::to_string(measured->fidelity), tester::to_string(scenario_.fidelity));
  outputs_.log.push_back({runtime::LogLevel::warning, outputs_.refusal});
  return false;
}

void AnalyserCore::store(const std::string& channel, const std::string& payload) {
  const std::string id = "store/" + content_hash(channel + payload);
  if (!kept_.insert(id).second) return;
  storing_.insert(id);
  outputs_.computes.push_back({.id = id, .kind = "store", .spec = store_spec(channel, payload)});
  if (last_) report_due_ = round_;  // the game is over: no later round would show it
}

void AnalyserCore::accept_request(const wire::DiagnoseRequest& request) {
  if (!diagnosed_.insert(request.round).second) return;
  waiting_diagnosis_ = request;
  phase_ = "diagnosing";
  phase_round_ = request.round;
  diagnose_when_complete();
}

/// Specimens of the diagnosis asked for whose measurements are still on their way.
std::vector<std::string> AnalyserCore::missing_specimens() const {
  std::vector<std::string> missing;
  for (const wire::NamedSpecimen& specimen : waiting_diagnosis_->specimens)
    if (!measurements_.contains({specimen.name, specimen.revision})) missing.push_back(specimen.name);
  return missing;
}

void AnalyserCore::diagnose_when_complete() {
  if (!waiting_diagnosis_ || !missing_specimens().empty()) return;
  diagnosis_ = OpenDiagnosis{
      .request = *std::exchange(waiting_diagnosis_, std::nullopt), .awaited = {}, .simulated = {}, .collector = {}};
  if (scenario_.diagnosis.simulations == 0 || !has_fractures(*diagnosis_)) return diagnose();
  plan_diagnosis();
}

void AnalyserCore::plan_diagnosis() {
  outputs_.computes.push_back({.id = fmt::format("plan/r{}/{}", diagnosis_->request.round, diagnosis_->plans++),
                               .kind = "plan",
                               .spec = diagnosis_spec(),
                               .by_hash = true});
}

bool AnalyserCore::has_fractures(const OpenDiagnosis& diagnosis) const {
  return std::ranges::any_of(diagnosis.request.specimens, [&](const wire::NamedSpecimen& specimen) {
    const std::string& payload = measurements_.at({specimen.name, specimen.revision});
    return wire::read<wire::Measurement>(payload)->record.test == tester::TestKind::toughness;
  });
}

std::string AnalyserCore::diagnosis_spec() const {
  DiagnosisTask task{.request = diagnosis_->request,
                     .measurements = {},
                     .bootstraps = scenario_.diagnosis.bootstraps,
                     .seed = scenario_.seed,
                     .simulations = scenario_.diagnosis.simulations,
                     .ranges = ranges_,
                     .floor_toml = floor_toml_,
                     .simulated = {}};
  for (const wire::NamedSpecimen& specimen : task.request.specimens)
    task.measurements.push_back(measurements_.at({specimen.name, specimen.revision}));
  for (const auto& [place, payload] : diagnosis_->simulated) task.simulated.push_back(payload);
  return analyser::diagnosis_spec(task);
}

void AnalyserCore::request_for_diagnosis(const std::string& plan) {
  for (std::string& payload : expected(runtime::unpack(plan))) {
    diagnosis_->awaited.insert(wire::read<wire::SimulateRequest>(payload)->request_id);
    outputs_.messages.push_back({"SIMULATE", std::move(payload)});
  }
  if (diagnosis_->awaited.empty()) diagnose();
}

/// Whether the diagnosis in progress awaited it.
bool AnalyserCore::take_for_diagnosis(const std::string& payload) {
  wire::SimulateResult part = *wire::read<wire::SimulateResult>(payload);
  if (!diagnosis_ || !diagnosis_->awaited.contains(part.request_id)) return false;
  diagnosis_->simulated.emplace(std::pair(part.request_id, part.chunk), payload);
  const std::string request_id = part.request_id;
  if (diagnosis_->collector.add(std::move(part))) diagnosis_->awaited.erase(request_id);
  if (diagnosis_->awaited.empty()) plan_diagnosis();
  return true;
}

void AnalyserCore::diagnose() {
  outputs_.computes.push_back({.id = fmt::format("diagnose/r{}", diagnosis_->request.round),
                               .kind = "diagnose",
                               .spec = diagnosis_spec(),
                               .by_hash = true});
  diagnosis_.reset();
}

void AnalyserCore::close_round(const wire::RoundSummary& round) {
  if (!closed_.insert(round.round).second) {
    if (!round.last || last_) return;
    last_ = true;  // the family stage is over, too
    report_due_ = round_;
    return report_when_ready();
  }
  round_ = std::max(round_, round.round);
  last_ = last_ || round.last;
  report_due_ = round_;
  phase_ = "writing the report";
  phase_round_ = round_;
  request_measured_designs();
  report_when_ready();
}

void AnalyserCore::accept_measurement(const std::string& payload) {
  const auto measured = wire::read<wire::Measurement>(payload);
  measurements_.emplace(std::pair(measured->record.specimen, measured->revision), payload);
  const bool upright = measured->record.conditions.orientation_deg == 0.0;
  if (measured->record.design.layout() && upright) {
    // What nobody ordered belongs to the round that is played.
    const int round = measured->round >= 0 ? measured->round : closed_.empty() ? 0 : round_ + 1;
    const auto known =
        measured_designs_.try_emplace(measured->record.design.name(), MeasuredDesign{measured->record.design, round});
    known.first->second.round = std::min(known.first->second.round, round);
    request_measured_designs();
  }
  diagnose_when_complete();
}

/// What was measured up to a closed round is simulated with the model of that round, once per model, whichever of them
/// comes last: what is simulated must not depend on the order of arrival.
void AnalyserCore::request_measured_designs() {
  for (const int round : closed_) {
    const auto model = models_.find(round), before = models_.find(round - 1);
    if (model == models_.end() || (round > 0 && before == models_.end())) continue;  // still on its way
    const bool repeats =
        round > 0 && game::material_side(before->second.parameters) == game::material_side(model->second.parameters);
    std::set<std::string>& asked = asked_designs_[round];
    const std::size_t asked_before = asked.size();
    std::vector<pattern::Design> designs;
    for (const auto& [name, measured] : measured_designs_) {
      const bool is_asked_before = repeats && measured.round < round;
      if (measured.round <= round && !is_asked_before && asked.insert(name).second) designs.push_back(measured.design);
    }
    for (std::size_t first = 0; first < designs.size(); first += wire::kMaximumDesigns) {
      const std::size_t end = std::min(designs.size(), first + wire::kMaximumDesigns);
      wire::SimulateRequest request;
      request.request_id = fmt::format("analyser/r{}/measured/{}", round, asked_before + first);
      request.modulus = request.toughness = true;
      request.fidelity = scenario_.fidelity;
      request.parameters = game::material_side(model->second.parameters);
      request.curve_points = kCurvePoints;
      request.designs.assign(designs.begin() + static_cast<std::ptrdiff_t>(first),
                             designs.begin() + static_cast<std::ptrdiff_t>(end));
      send_request(std::move(request));
    }
  }
}

void AnalyserCore::send_request(wire::SimulateRequest request) {
  request = wire::with_content_id(std::move(request));
  open_responses_[request.request_id].with_fractures = request.crack || request.film;
  finished_ = false;
  outputs_.messages.push_back({"SIMULATE", wire::write(request)});
}

void AnalyserCore::request_films() {
  for (auto proposal = unfilmed_.begin(); proposal != unfilmed_.end();) {
    const auto model = models_.find(proposal->first);
    if (model == models_.end()) {  // still on its way
      ++proposal;
      continue;
    }
    request_films_of(fmt::format("r{}", proposal->first), model->second.parameters, proposal->second);
    proposal = unfilmed_.erase(proposal);
  }
}

void AnalyserCore::request_films_of(const std::string& whose, const material::ParameterSet& model,
                                    const std::vector<pattern::Design>& designs) {
  for (std::size_t first = 0; first < designs.size(); first += wire::kMaximumDesigns) {
    const std::size_t end = std::min(designs.size(), first + wire::kMaximumDesigns);
    wire::SimulateRequest request;
    request.request_id = fmt::format("analyser/{}/films", whose);
    if (first > 0) request.request_id += fmt::format("/{}", first);
    request.toughness = request.crack = request.film = true;
    request.fidelity = scenario_.fidelity;
    request.parameters = game::material_side(model);
    request.designs.assign(designs.begin() + static_cast<std::ptrdiff_t>(first),
                           designs.begin() + static_cast<std::ptrdiff_t>(end));
    send_request(std::move(request));
  }
}

void AnalyserCore::accept_response(const wire::SimulateResult& part) {
  const auto open = open_responses_.find(part.request_id);
  if (open == open_responses_.end()) return;
  OpenResponse& response = open->second;
  response.chunks = part.chunks;
  response.chunk.insert(part.chunk);
  for (std::size_t i = 0; i < part.results.size(); ++i)
    if (part.results[i].failure.empty()) response.broke.insert(static_cast<std::size_t>(part.first) + i);
  close_when_complete(part.request_id);
}

void AnalyserCore::accept_fracture(const wire::Fracture& fracture) {
  const auto open = open_responses_.find(fracture.request_id);
  if (open == open_responses_.end()) return;
  open->second.fracture.insert(static_cast<std::size_t>(fracture.design_index));
  close_when_complete(fracture.request_id);
}

void AnalyserCore::close_when_complete(const std::string& request_id) {
  const auto open = open_responses_.find(request_id);
  const OpenResponse& response = open->second;
  const bool numbers = response.chunks > 0 && response.chunk.size() == response.chunks;
  if (numbers && (!response.with_fractures || response.fracture.size() >= response.broke.size()))
    open_responses_.erase(open);
}

void AnalyserCore::report_when_ready() {
  const bool all_asked = std::ranges::all_of(
      closed_, [&](int round) { return models_.contains(round) && (round == 0 || models_.contains(round - 1)); });
  const bool all_known = storing_.empty() && all_asked && open_responses_.empty();
  if (!report_due_ || reporting_ || !all_known) return;
  outputs_.computes.push_back({.id = fmt::format("report/r{}/{}", *report_due_, ++reports_),
                               .kind = "report",
                               .spec = std::to_string(*report_due_)});
  reporting_ = true;
  finished_ = false;
  report_due_.reset();
}

void AnalyserCore::accept_work(const runtime::WorkDone& work) {
  if (work.id.starts_with("store/")) {
    storing_.erase(work.id);
  } else if (work.id.starts_with("plan/")) {
    request_for_diagnosis(work.result);
  } else if (work.id.starts_with("diagnose/")) {
    const auto diagnosis = wire::read<wire::Diagnosis>(work.result);
    if (diagnosis) {
      outputs_.log.push_back(
          {runtime::LogLevel::info, fmt::format("round {}: {}", diagnosis->round, diagnosis->summary)});
      outputs_.messages.push_back({"DIAGNOSIS", work.result});
      store("DIAGNOSIS", work.result);
    }
    phase_ = "idle";
  } else if (work.id.starts_with("report/")) {
    reporting_ = false;
    outputs_.log.push_back({runtime::LogLevel::info, work.result});
    phase_ = last_ ? "the report is complete" : "idle";
    finished_ = last_ && !report_due_;
  }
  report_when_ready();
}

runtime::Status AnalyserCore::status() const {
  std::string phase = phase_;
  if (waiting_diagnosis_) {  // and waits for ever where nobody sends the missing ones again: name them
    constexpr std::size_t kNamed = 3;
    std::vector<std::string> missing = missing_specimens();
    const std::size_t count = missing.size();
    if (count > kNamed) {
      missing.resize(kNamed);
      missing.emplace_back("...");
    }
    phase = fmt::format("waiting for measurements of {} of {}: {}", count,
                        counted(std::ssize(waiting_diagnosis_->specimens), "specimen"), fmt::join(missing, ", "));
  }
  if (diagnosis_ && !diagnosis_->awaited.empty()) phase = "waiting for fracture tests to diagnose with";
  return {.phase = std::move(phase), .round = phase_round_, .progress = -1.0, .finished = finished_};
}

std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario) {
  const material::ParameterRanges ranges = game::starting_model(scenario).ranges;
  const std::string& file = scenario.discretisation_floor_file;
  std::string floor_toml;
  if (!file.empty()) {
    floor_toml = read_file(file);
    (void)diagnosis::modulus_floor_from(floor_toml, file, scenario.fidelity);
    (void)diagnosis::fracture_discretisation_from(floor_toml, file, scenario.fidelity);
  }
  return std::make_unique<AnalyserCore>(scenario, ranges, std::move(floor_toml));
}

}  // namespace nacre::analyser
