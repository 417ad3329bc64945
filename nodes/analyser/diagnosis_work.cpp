#include "analyser/diagnosis_work.hpp"

#include <algorithm>
#include <optional>

#include <fmt/ranges.h>

#include "base/expected.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/fracture_plan.hpp"
#include "diagnosis/kept_emulator.hpp"
#include "diagnosis/words.hpp"
#include "material/effect_words.hpp"
#include "material/extensions.hpp"
#include "runtime/farm_requests.hpp"
#include "runtime/journal.hpp"
#include "store/kept_simulation.hpp"

namespace nacre::analyser {
namespace {

constexpr std::size_t kFixedFields = 7;
/// Of curves: as many as the farm keeps.
constexpr int kFracturePoints = store::kKeptCurvePoints;

DiagnosisTask task_from(const std::string& spec) {
  const std::vector<std::string> fields = expected(runtime::unpack(spec));
  DiagnosisTask task;
  task.request = expected(wire::read<wire::DiagnoseRequest>(fields.at(0)));
  task.bootstraps = std::stoi(fields.at(1));
  task.seed = std::stoull(fields.at(2));
  task.simulations = std::stoi(fields.at(3));
  task.ranges = material::parse_ranges(fields.at(4), "the ranges of a diagnosis");
  task.floor_toml = fields.at(5);
  task.simulated = expected(runtime::unpack(fields.at(6)));
  task.measurements.assign(fields.begin() + kFixedFields, fields.end());
  return task;
}

diagnosis::DiagnosisSettings settings_of(const DiagnosisTask& task) {
  constexpr std::string_view kSource = "the discretisation floor";
  diagnosis::DiagnosisSettings settings;
  settings.start = task.request.parameters;
  settings.ranges = task.ranges;
  settings.fidelity = task.request.fidelity;
  settings.bootstraps = task.bootstraps;
  settings.seed = task.seed;
  settings.procedure.curves.fracture_points = kFracturePoints;
  settings.procedure.emulator.refined_specimens = 1;  // a round does not wait for more
  settings.check_discretisation = false;
  if (task.floor_toml.empty()) return settings;
  settings.floor = diagnosis::modulus_floor_from(task.floor_toml, kSource, task.request.fidelity);
  settings.fracture_discretisation =
      diagnosis::fracture_discretisation_from(task.floor_toml, kSource, task.request.fidelity);
  return settings;
}

std::vector<measurement::SpecimenRecord> specimens_of(const DiagnosisTask& task) {
  std::vector<measurement::SpecimenRecord> specimens;
  for (const std::string& payload : task.measurements) {
    specimens.push_back(expected(wire::read<wire::Measurement>(payload)).record);
    specimens.back().valid = true;
  }
  return specimens;
}

runtime::FarmBatch batch_of(const diagnosis::FracturePlan& plan, const wire::DiagnoseRequest& request,
                            std::size_t stage) {
  return {.requester = "analyser",
          .label = fmt::format("r{}/diagnosis{}", request.round, stage),
          .wanted = plan.wanted,
          .measured = plan.measured,
          .fidelity = request.fidelity,
          .curve_points = kFracturePoints};
}

/// Plans that the farm has simulated, and the next one.
struct Fractures {
  std::vector<diagnosis::SimulatedPlan> done;
  std::optional<diagnosis::FracturePlan> next;
  std::string broke;  ///< why no plan could be made; empty: nothing is wrong
};

/// Whether the farm's responses to all of a plan are there.
bool take_responses(const DiagnosisTask& task, runtime::FarmRequests& farm, const diagnosis::FracturePlan& plan,
                    std::size_t stage) {
  bool complete = farm.ask(batch_of(plan, task.request, stage)).empty();
  for (const std::string& payload : task.simulated)
    complete = farm.take(expected(wire::read<wire::SimulateResult>(payload))) || complete;
  return complete;
}

Fractures fractures_of(const DiagnosisTask& task, const std::vector<measurement::SpecimenRecord>& specimens,
                       const diagnosis::DiagnosisSettings& settings) {
  Fractures fractures;
  try {
    while ((fractures.next = diagnosis::next_fractures(specimens, task.request.evaluated, task.simulations, settings,
                                                       fractures.done))) {
      runtime::FarmRequests farm;
      if (!take_responses(task, farm, *fractures.next, fractures.done.size())) break;
      fractures.done.push_back({*std::move(fractures.next), farm.predictions()});
    }
  } catch (const std::runtime_error& error) {
    // Measurements come from people: fracture tests that break a fit must not take the moduli with them.
    fractures = {.done = {}, .next = {}, .broke = error.what()};
  }
  return fractures;
}

/// What the budget of simulations does not pay, as a further sentence of the summary.
std::string unaffordable_in_words(const std::vector<std::string>& effects, int simulations) {
  if (effects.empty()) return {};
  return fmt::format(" Not weighed, since diagnosis.simulations of {} does not pay for it: {}.", simulations,
                     material::effect_in_words(fmt::format("{}", fmt::join(effects, ", "))));
}

bool is_fracture(const measurement::SpecimenRecord& specimen) { return specimen.test == tester::TestKind::toughness; }

/// A fracture test takes minutes to diagnose where the farm has not simulated it.
diagnosis::Diagnosis diagnosis_of(const DiagnosisTask& task) {
  diagnosis::DiagnosisSettings settings = settings_of(task);
  std::vector<measurement::SpecimenRecord> specimens = specimens_of(task);
  const bool has_fractures = std::ranges::any_of(specimens, is_fracture);
  const Fractures fractures = fractures_of(task, specimens, settings);
  std::string left_out;
  if (fractures.done.empty()) {
    std::erase_if(specimens, is_fracture);
    const std::string why = fractures.broke.empty()
                                ? fmt::format("diagnosis.simulations of {} does not pay for them", task.simulations)
                                : fractures.broke;
    if (has_fractures) left_out = fmt::format(" Fracture tests are left out: {}.", why);
  } else {
    settings.fractures = diagnosis::simulated_fractures(fractures.done);
    settings.fractures->refined = diagnosis::refined_layouts_of(specimens, settings);
    left_out = unaffordable_in_words(settings.fractures->unaffordable, task.simulations);
  }
  diagnosis::Diagnosis diagnosis = diagnosis::diagnose_or_say_why_not(specimens, settings);
  diagnosis.summary += left_out;
  return diagnosis;
}

wire::Diagnosis message_of(const diagnosis::Diagnosis& d, int round) {
  wire::Diagnosis message;
  message.round = round;
  message.verdict = std::string(to_string(d.verdict));
  message.summary = d.summary;
  for (const diagnosis::NamedEffect& e : d.effects) {
    message.effects.push_back({e.name, e.family, e.parameter, e.interval_low, e.interval_high, e.unit});
    // Further parameters of an effect follow its size under the same name.
    const auto& numbers = material::find_effect(e.name)->parameters;
    for (std::size_t p = 0; p < e.further.size(); ++p) {
      const diagnosis::FittedNumber& number = e.further[p];
      message.effects.push_back({e.name, e.family, number.value, number.interval_low, number.interval_high,
                                 std::string(numbers[p + 1].unit)});
    }
  }
  for (const diagnosis::CandidateEffect& c : d.candidates) {
    message.candidates.push_back(
        {c.name, std::string(to_string(c.status)), c.statistic, c.p_family_wise, c.absorption});
  }
  if (d.gain)
    message.gain = wire::DiagnosedGain{.held_out_error_before = d.gain->held_out_error_before,
                                       .held_out_error_after = d.gain->held_out_error_after,
                                       .relative_reduction = d.gain->relative_reduction,
                                       .reduction_low = d.gain->interval_low,
                                       .reduction_high = d.gain->interval_high};
  for (const diagnosis::NextExperiment& e : d.next_experiments) {
    message.next_experiments.push_back(
        {e.design, e.test, e.conditions, e.replicates, e.loading, e.reason + diagnosis::surroundings_in_words(e)});
  }
  return message;
}

}  // namespace

std::string diagnosis_spec(const DiagnosisTask& task) {
  std::vector<std::string> fields = {wire::write(task.request),     std::to_string(task.bootstraps),
                                     std::to_string(task.seed),     std::to_string(task.simulations),
                                     material::to_csv(task.ranges), task.floor_toml,
                                     runtime::pack(task.simulated)};
  fields.insert(fields.end(), task.measurements.begin(), task.measurements.end());
  return runtime::pack(fields);
}

std::string plan_work(const std::string& spec) {
  const DiagnosisTask task = task_from(spec);
  std::vector<std::string> requests;
  const Fractures fractures = fractures_of(task, specimens_of(task), settings_of(task));
  runtime::FarmRequests farm;
  if (fractures.next)
    for (const wire::SimulateRequest& request :
         farm.ask(batch_of(*fractures.next, task.request, fractures.done.size())))
      requests.push_back(wire::write(request));
  return runtime::pack(requests);
}

std::string diagnose_work(const std::string& spec) {
  const DiagnosisTask task = task_from(spec);
  try {
    return wire::write(message_of(diagnosis_of(task), task.request.round));
  } catch (const InputError& error) {
    return wire::write(message_of(diagnosis::insufficient(error.what()), task.request.round));
  } catch (const std::runtime_error& error) {
    // Measurements come from people: a fit that breaks on them must not end the game, which waits for the diagnosis.
    const std::string why = fmt::format("the diagnosis broke off: {}", error.what());
    return wire::write(message_of(diagnosis::insufficient(why), task.request.round));
  }
}

}  // namespace nacre::analyser
