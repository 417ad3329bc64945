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

/// Hash of what was measured: who ordered it, when, and who amended it is not.
std::string content_of(wire::Measurement measured) {
  measured.round = -1;
  measured.order_id.clear();
  measured.revision = 0;
  measured.by.clear();
  measured.why.clear();
  return wire::message_hash(kChannel, wire::write(measured));
}

/// What counts at the validation agent or, where it counts more, at the analyser; nullptr: neither knows the specimen.
const HeldReport* newest_report(const HeldMeasurements& held, const std::string& specimen) {
  const HeldReport* newest = nullptr;
  for (const HeldReports* reports : {&held.validation_agent, &held.analyser}) {
    const auto found = reports->find(specimen);
    if (found == reports->end()) continue;
    if (newest == nullptr || found->second.amendment.revision > newest->amendment.revision) newest = &found->second;
  }
  return newest;
}

std::string other_values(const std::string& specimen, const game::Amendment& known) {
  return fmt::format(
      "specimen {}: the run has another measurement of this name{}, which stays; expected a new name, `nacre inject` "
      "with --reason TEXT to amend it, or `nacre review` to judge it",
      specimen, known.revision == 0 ? "" : fmt::format(" (amended by {}: {})", known.by, known.why));
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

void enter(HeldReports& held, const std::string& payload, tester::Fidelity fidelity) {
  const auto measured = wire::read<wire::Measurement>(payload);
  if (!measured || measured->fidelity != fidelity) return;
  const HeldReport report{.round = measured->round,
                          .order_id = measured->order_id,
                          .amendment = {measured->revision, measured->by, measured->why},
                          .content = content_of(*measured)};
  const auto [position, is_new] = held.emplace(measured->record.specimen, report);
  if (!is_new && report.amendment.revision > position->second.amendment.revision) position->second = report;
}

HeldReports held_by_analyser(const RunAccess& run) {
  HeldReports held;
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
                                               const HeldReport& report) {
  const auto other = [&](const HeldReports& reports) -> const HeldReport* {
    const auto found = reports.find(specimen);
    if (found == reports.end()) return nullptr;
    const HeldReport& known = found->second;
    const int revision = report.amendment.revision;
    const bool differs = known.amendment.revision == revision && known.content != report.content;
    return known.amendment.revision > revision || differs ? &known : nullptr;
  };
  if (const HeldReport* known = other(held.validation_agent)) return other_values(specimen, known->amendment);
  if (other(held.analyser) == nullptr) return std::nullopt;
  return fmt::format(
      "specimen {}: another measurement of this name has reached the analyser alone, where it stays; expected a new "
      "name, or `nacre inject` with --reason TEXT to amend it: else both nodes would go by different values",
      specimen);
}

Result<HandIn> hand_in(const HeldMeasurements& held, const measurement::SpecimenRecord& specimen,
                       tester::Fidelity fidelity, const std::optional<game::Amendment>& amend) {
  wire::Measurement message;
  message.fidelity = fidelity;
  message.record = wire::fit_to_send(specimen);
  const std::string history = history_of(specimen);
  if (!history.empty()) message.record.note += (specimen.note.empty() ? "" : " ") + history;
  HandIn handed{.message = {}, .report = {.content = content_of(message)}};
  const HeldReport* known = newest_report(held, specimen.specimen);
  if (known != nullptr && known->content == handed.report.content) {
    handed.report = *known;
    const auto at_agent = held.validation_agent.find(specimen.specimen);
    handed.is_repeated = at_agent != held.validation_agent.end() &&
                         at_agent->second.amendment.revision == known->amendment.revision;
  } else if (known != nullptr && amend) {
    handed.report.round = known->round;
    handed.report.order_id = known->order_id;
    handed.report.amendment = {known->amendment.revision + 1, amend->by, amend->why};
  }
  if (const auto reason = against_measurement(held, specimen.specimen, handed.report)) return fail("{}", *reason);
  message.round = handed.report.round;
  message.order_id = handed.report.order_id;
  message.revision = handed.report.amendment.revision;
  message.by = handed.report.amendment.by;
  message.why = handed.report.amendment.why;
  handed.message = {kChannel, wire::write(message)};
  return handed;
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

runtime::Message withdrawal_message(const RunAccess& run, const std::string& order_id, const game::Withdrawal& said) {
  int highest = 0;
  for (const std::string& payload : run::received_by(run.folder, "validation_agent", "WITHDRAWAL")) {
    const auto before = wire::read<wire::Withdrawal>(payload);
    if (before && before->order_id == order_id) highest = std::max(highest, before->revision);
  }
  const wire::Withdrawal message{
      .order_id = order_id, .revision = highest + 1, .withdrawn = said.withdrawn, .by = said.by, .why = said.why};
  return {"WITHDRAWAL", wire::write(message)};
}

}  // namespace nacre::cli
