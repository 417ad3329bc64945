#include "analyser/diagnosis_work.hpp"

#include "base/expected.hpp"
#include "diagnosis/diagnose.hpp"
#include "material/extensions.hpp"
#include "runtime/journal.hpp"

namespace nacre::analyser {
namespace {

constexpr std::size_t kFixedFields = 7;

DiagnosisTask task_from(const std::string& spec) {
  const std::vector<std::string> fields = expected(runtime::unpack(spec));
  DiagnosisTask task;
  task.request = expected(wire::read<wire::DiagnoseRequest>(fields.at(0)));
  task.bootstraps = std::stoi(fields.at(1));
  task.seed = std::stoull(fields.at(2));
  task.floor = {.log_modulus_sd = std::stod(fields.at(3)),
                .mesh_amplitude = std::stod(fields.at(4)),
                .mesh_remainder_sd = std::stod(fields.at(5))};
  task.ranges = material::parse_ranges(fields.at(6), "the ranges of a diagnosis");
  task.measurements.assign(fields.begin() + kFixedFields, fields.end());
  return task;
}

std::vector<measurement::SpecimenRecord> specimens_of(const DiagnosisTask& task) {
  std::vector<measurement::SpecimenRecord> specimens;
  for (const std::string& payload : task.measurements) {
    measurement::SpecimenRecord record = expected(wire::read<wire::Measurement>(payload)).record;
    record.valid = true;
    // Fracture tests take minutes to diagnose: a round does not wait for them.
    if (record.test != tester::TestKind::toughness) specimens.push_back(std::move(record));
  }
  return specimens;
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
    message.next_experiments.push_back({e.design, e.test, e.conditions, e.replicates, e.loading, e.reason});
  }
  return message;
}

}  // namespace

std::string diagnosis_spec(const DiagnosisTask& task) {
  std::vector<std::string> fields = {wire::write(task.request),
                                     std::to_string(task.bootstraps),
                                     std::to_string(task.seed),
                                     fmt::format("{}", task.floor.log_modulus_sd),
                                     fmt::format("{}", task.floor.mesh_amplitude),
                                     fmt::format("{}", task.floor.mesh_remainder_sd),
                                     material::to_csv(task.ranges)};
  fields.insert(fields.end(), task.measurements.begin(), task.measurements.end());
  return runtime::pack(fields);
}

std::string diagnose_work(const std::string& spec) {
  const DiagnosisTask task = task_from(spec);
  diagnosis::DiagnosisSettings settings;
  settings.start = task.request.parameters;
  settings.ranges = task.ranges;
  settings.fidelity = task.request.fidelity;
  settings.bootstraps = task.bootstraps;
  settings.seed = task.seed;
  settings.floor = task.floor;
  settings.check_discretisation = false;
  const std::vector<measurement::SpecimenRecord> specimens = specimens_of(task);
  try {
    return wire::write(message_of(diagnosis::diagnose(specimens, settings), task.request.round));
  } catch (const InputError& error) {
    return wire::write(message_of(diagnosis::insufficient(error.what()), task.request.round));
  } catch (const std::runtime_error& error) {
    // Measurements come from people: a fit that breaks on them must not end the game, which waits for the diagnosis.
    const std::string why = fmt::format("the diagnosis broke off: {}", error.what());
    return wire::write(message_of(diagnosis::insufficient(why), task.request.round));
  }
}

}  // namespace nacre::analyser
