#include "specimen_messages.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "run/journal_messages.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre::cli {
namespace {

constexpr const char* kChannel = "MEASUREMENT";

/// What a message has no field for stands in its note: `[date: ...; operator: ...]`, in this order.
constexpr std::array kHistory = {"date", "operator", "machine", "path"};

std::string history_of(const measurement::SpecimenRecord& specimen) {
  std::string history;
  for (const char* name : kHistory) {
    const auto cell = specimen.other_columns.find(name);
    if (cell != specimen.other_columns.end())
      history += fmt::format("{}{}: {}", history.empty() ? "[" : "; ", name, cell->second);
  }
  return history.empty() ? "" : history + "]";
}

}  // namespace

measurement::SpecimenRecord with_history_of_note(measurement::SpecimenRecord specimen) {
  const std::string_view note = specimen.note;
  if (!note.ends_with(']')) return specimen;
  std::size_t end = note.size() - 1;
  // From the last one to the first: each ends where the next begins.
  for (auto name = kHistory.rbegin(); name != kHistory.rend(); ++name) {
    for (const char* opening : {"[", "; "}) {
      const std::string mark = fmt::format("{}{}: ", opening, *name);
      const std::size_t begin = note.substr(0, end).rfind(mark);
      if (begin == std::string_view::npos) continue;
      specimen.other_columns.try_emplace(*name, note.substr(begin + mark.size(), end - begin - mark.size()));
      end = begin;
      break;
    }
  }
  return specimen;
}

runtime::Message measurement_message(const measurement::SpecimenRecord& specimen, tester::Fidelity fidelity) {
  wire::Measurement measurement;
  measurement.fidelity = fidelity;
  measurement.record = wire::fit_to_send(specimen);
  const std::string history = history_of(specimen);
  if (!history.empty()) measurement.record.note += (specimen.note.empty() ? "" : " ") + history;
  return {kChannel, wire::write(measurement)};
}

void enter(std::map<std::string, std::string>& held, const std::string& payload, tester::Fidelity fidelity) {
  auto measurement = wire::read<wire::Measurement>(payload);
  if (!measurement || measurement->fidelity != fidelity) return;
  // Who ordered it and when is not what was measured.
  wire::Measurement plain;
  plain.fidelity = measurement->fidelity;
  plain.record = std::move(measurement->record);
  held.emplace(plain.record.specimen, wire::message_hash(kChannel, wire::write(plain)));
}

std::map<std::string, std::string> held_by_analyser(const RunAccess& run) {
  std::map<std::string, std::string> held;
  for (const std::string& payload : run::received_by(run.folder, "analyser", kChannel))
    enter(held, payload, run.scenario.fidelity);
  return held;
}

HeldMeasurements held_measurements(const RunAccess& run) {
  HeldMeasurements held{.validation_agent = {}, .analyser = held_by_analyser(run)};
  for (const std::string& payload : run::received_by(run.folder, "validation_agent", kChannel))
    enter(held.validation_agent, payload, run.scenario.fidelity);
  return held;
}

std::optional<std::string> against_measurement(const HeldMeasurements& held, const std::string& specimen,
                                               const std::string& hash) {
  const auto other = [&](const std::map<std::string, std::string>& hashes) {
    const auto found = hashes.find(specimen);
    return found != hashes.end() && found->second != hash;
  };
  if (other(held.validation_agent)) {
    return fmt::format(
        "specimen {}: the run has another measurement of this name, which stays; expected a new name, or "
        "`nacre review` to judge the old one",
        specimen);
  }
  if (!other(held.analyser)) return std::nullopt;
  return fmt::format(
      "specimen {}: another measurement of this name has reached the analyser alone, where it stays; expected a new "
      "name, or both nodes would go by different values",
      specimen);
}

std::map<std::string, std::string> hashes_by_specimen(const RunAccess& run) {
  HeldMeasurements held = held_measurements(run);
  held.validation_agent.merge(held.analyser);
  return held.validation_agent;
}

std::map<std::string, int> highest_revisions(const RunAccess& run) {
  std::map<std::string, int> highest;
  // Either journal may be lost: the node that keeps the other holds the higher revision, and to it a lower one is old.
  for (const char* node : {"validation_agent", "analyser"})
    for (const std::string& payload : run::received_by(run.folder, node, "REVIEW")) {
      const auto review = wire::read<wire::Review>(payload);
      if (review) highest[review->specimen] = std::max<int>(highest[review->specimen], review->revision);
    }
  return highest;
}

}  // namespace nacre::cli
